// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "engine/core/archive_values.h"

namespace toile {
namespace {

Pattern small_pattern() {
  Panel panel;
  panel.name = "front";
  panel.corners = {{0, 0}, {0.4, 0}, {0, 0.6}};
  panel.edges.resize(3);
  panel.edges[1].curve.kind = CurveKind::CubicBezier;
  panel.edges[1].curve.control = {Vec2(0.3, 0.2), Vec2(0.1, 0.5)};
  panel.edges[2].seam_allowance = 0.015;
  panel.notches = {{1, 0.25, NotchType::T}};
  panel.keep_outs = {{{{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}}, "pocket"}};
  panel.grainline = {{Vec2(0, 0), Vec2(0, 0.3)}};
  Pattern pattern;
  pattern.name = "triangle";
  pattern.panels = {panel, panel};
  pattern.seams = {{{PanelId(0), 1}, {PanelId(1), 1}, true}};
  pattern.fabric.name = "denim";
  return pattern;
}

TEST(Archive, ReadsBackWhatItWroteByteForByte) {
  const Bytes bytes = to_bytes(small_pattern());
  const auto read = from_bytes<Pattern>(bytes);
  EXPECT_EQ(read.panels[1].edges[1].curve.control[1].y(), 0.5);
  EXPECT_EQ(read.panels[0].keep_outs[0].why, "pocket");
  EXPECT_EQ(*read.panels[0].edges[2].seam_allowance, 0.015);
  EXPECT_FALSE(read.panels[0].edges[0].seam_allowance.has_value());
  EXPECT_EQ(to_bytes(read), bytes);
}

TEST(Archive, KeepsBodiesWithTheirSkeletonAndNamedPoints) {
  Body body;
  body.name = "form";
  body.surface.vertices = Points3::Random(7, 3);
  body.surface.triangles = Triangles::Constant(4, 3, 2);
  body.skeleton.emplace().arms[Right].centre_line = Points3::Random(5, 3);
  body.landmarks["crotch"] = Vec3(0, 0.8, 0.01);
  body.measurements["waist_girth"] = 0.84;
  const Bytes bytes = to_bytes(body);
  const Body read = from_bytes<Body>(bytes);
  EXPECT_EQ(read.surface.vertices, body.surface.vertices);
  EXPECT_EQ(read.skeleton->arms[Right].centre_line, body.skeleton->arms[Right].centre_line);
  EXPECT_EQ(read.landmarks.at("crotch"), body.landmarks.at("crotch"));
  EXPECT_EQ(to_bytes(read), bytes);
}

TEST(Archive, RefusesEveryTruncationAndAnythingLeftOver) {
  Bytes bytes = to_bytes(small_pattern());
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_THROW(from_bytes<Pattern>(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), Error)
        << size;
  bytes.push_back(0);
  EXPECT_THROW(from_bytes<Pattern>(bytes), Error);
}

TEST(Archive, RefusesACountLargerThanTheBytesLeft) {
  Bytes bytes(8, 0xff);
  EXPECT_THROW(from_bytes<std::vector<double>>(bytes), Error);
  bytes.resize(16, 0xff);
  EXPECT_THROW(from_bytes<Points3>(bytes), Error);
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/fit_pattern_edges.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/geometry/curve.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "tests/support/shared_data.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

constexpr double kDrawnTolerance = 0.5e-3;  // m, what a fitted edge may be off [issue "derive", item 5]

Pattern shared_pattern(const std::string& name) {
  return import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
}

template <class Motion>
Points2 moved(const PatternMesh& mesh, const Motion& motion) {
  Points2 target = mesh.rest;
  for (int v = 0; v < mesh.vertex_count(); ++v) target.row(v) = motion(Vec2(mesh.rest.row(v)));
  return target;
}

TEST(FitPatternEdges, AnUnmovedMeshGivesTheOriginalPattern) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern = shared_pattern(name);
    const PatternMesh mesh = mesh_panels(pattern);
    const FitPatternEdgesResult result = fit_pattern_edges(pattern, mesh, mesh.rest);
    EXPECT_LT(result.largest_deviation, 1e-5);
    EXPECT_LT(result.largest_seam_mismatch, 1e-6);
    EXPECT_EQ(result.bent_edges, 0);
    for (std::size_t p = 0; p < pattern.panels.size(); ++p)
      for (int e = 0; e < pattern.panels[p].edge_count(); ++e) {
        const Curve a = edge_curve(pattern.panels[p], e), b = edge_curve(result.pattern.panels[p], e);
        EXPECT_EQ(a.shape.kind, b.shape.kind);
        for (const double t : {0.0, 0.25, 0.5, 0.75}) EXPECT_LT((curve_point(a, t) - curve_point(b, t)).norm(), 1e-4);
      }
  }
}

TEST(FitPatternEdges, SmoothDeformationsComeBackAsTheOriginalKindsOfEdges) {
  TOILE_REQUIRE_SHARED_DATA();
  // Wider by 10 %, longer by 5 %, bent a little: what a derivation does to a panel, with the sewn sides off by some
  // tenths.
  const auto motion = [](const Vec2& p) {
    return Vec2(1.10 * p.x() + 0.05 * p.x() * p.y() + 0.002 * std::sin(6 * p.y()), 1.05 * p.y() + 0.04 * p.x() * p.x());
  };
  int edges = 0, bent = 0, polylines = 0;
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern = shared_pattern(name);
    const PatternMesh mesh = mesh_panels(pattern);
    FitPatternEdgesOptions options;
    options.cubic_tolerance = kDrawnTolerance;
    options.keep_straight = false;
    options.keep_seam_ratios = false;
    const FitPatternEdgesResult result = fit_pattern_edges(pattern, mesh, moved(mesh, motion), {}, options);
    bent += result.bent_edges;
    polylines += result.polyline_edges;
    for (const Panel& panel : result.pattern.panels) edges += panel.edge_count();
    EXPECT_LT(result.largest_deviation, kDrawnTolerance);
    validate_pattern(result.pattern);
  }
  EXPECT_GT(edges, 1000);
  EXPECT_LT(bent, edges / 3);
  EXPECT_LE(polylines, 4) << "only the quarter-circle hems of wide skirts";
}

TEST(FitPatternEdges, PanelsStayWhereTheyArePlaced) {
  constexpr double kLarger = 1.2;
  const Pattern pattern = test::tube_skirt_pattern(0.9, 0.5, 0.6, 0.25);
  const PatternMesh mesh = mesh_panels(pattern);
  const Pattern grown =
      fit_pattern_edges(pattern, mesh, moved(mesh, [=](const Vec2& p) { return Vec2(kLarger * p); })).pattern;
  const auto middle = [](const Panel& panel) {
    Vec3 sum = Vec3::Zero();
    for (const Vec2& corner : panel.corners) sum += panel.rotation.leftCols<2>() * corner + panel.translation;
    return Vec3(sum / static_cast<double>(panel.corners.size()));
  };
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    const Panel &before = pattern.panels[p], &after = grown.panels[p];
    EXPECT_NEAR(edge_length(after, 0), kLarger * edge_length(before, 0), 1e-6);
    EXPECT_GT((after.corners[2] - before.corners[2]).norm(), 0.05);
    const Vec3 way = middle(after) - middle(before);
    EXPECT_LT(Vec2(way.x(), way.z()).norm(), 1e-9);
    EXPECT_EQ(after.translation.y(), before.translation.y());
  }
}

TEST(FitPatternEdges, SewnSidesKeepTheirLengthRatio) {
  TOILE_REQUIRE_SHARED_DATA();
  // The left half grows more than the right: sides of seams would differ by millimetres.
  const auto motion = [](const Vec2& p) {
    return Vec2(p.x() * (1.02 + 0.004 * p.x()), p.y() * (1.01 + 0.006 * p.x()));
  };
  for (const char* name : {"tshirt_fitted", "pants_straight", "dress_sleeveless", "skirt_circle"}) {
    SCOPED_TRACE(name);
    const Pattern pattern = shared_pattern(name);
    const PatternMesh mesh = mesh_panels(pattern);
    FitPatternEdgesOptions loose;
    loose.keep_seam_ratios = false;
    const Points2 target = moved(mesh, motion);
    EXPECT_GT(fit_pattern_edges(pattern, mesh, target, {}, loose).largest_seam_mismatch, 2e-4)
        << "the case must be one";
    const FitPatternEdgesResult result = fit_pattern_edges(pattern, mesh, target);
    EXPECT_LT(result.largest_seam_mismatch, 1e-5);
    validate_pattern(result.pattern);
  }
}

TEST(FitPatternEdges, StraightEdgesStayStraightAsLabelledOrDetected) {
  Pattern pattern;
  Panel panel;
  panel.name = "a";
  panel.corners = {{0, 0}, {0.3, 0}, {0.25, 0.4}, {0, 0.4}};
  panel.edges.resize(4);
  pattern.panels = {panel, panel};
  pattern.panels[1].name = "b";
  pattern.seams.push_back({{PanelId(0), 1}, {PanelId(1), 1}, true});
  const PatternMesh mesh = mesh_panels(pattern, {2000, {}});
  const Points2 target = moved(mesh, [](const Vec2& p) {
    return Vec2(p.x() + 0.1 * p.y() * (0.4 - p.y()), p.y() + 0.1 * p.x() * (0.3 - p.x()));
  });
  const FitPatternEdgesResult result = fit_pattern_edges(pattern, mesh, target);
  const auto& edges = result.pattern.panels[0].edges;
  EXPECT_EQ(edges[0].curve.kind, CurveKind::Line) << "a free hem";
  EXPECT_EQ(edges[3].curve.kind, CurveKind::Line) << "along the grain";
  EXPECT_EQ(edges[1].curve.kind, CurveKind::CubicBezier) << "a side seam follows the cloth";
  pattern.panels[0].edges[0].straight = false;
  pattern.panels[0].edges[1].straight = true;
  const FitPatternEdgesResult labelled = fit_pattern_edges(pattern, mesh, target);
  EXPECT_EQ(labelled.pattern.panels[0].edges[0].curve.kind, CurveKind::CubicBezier);
  EXPECT_EQ(labelled.pattern.panels[0].edges[1].curve.kind, CurveKind::Line);
}

TEST(FitPatternEdges, MarksFollowTheCloth) {
  Pattern pattern;
  Panel panel;
  panel.name = "a";
  panel.corners = {{0, 0}, {0.3, 0}, {0.3, 0.4}, {0, 0.4}};
  panel.edges.resize(4);
  panel.notches.push_back({1, 0.5, NotchType::V});
  panel.grainline = {{Vec2(0.1, 0.1), Vec2(0.1, 0.3)}};
  panel.keep_outs.push_back({{{0.1, 0.1}, {0.15, 0.1}, {0.15, 0.15}, {0.1, 0.15}}, "pocket"});
  pattern.panels.push_back(panel);
  const PatternMesh mesh = mesh_panels(pattern, {2000, {}});
  const Points2 target =
      moved(mesh, [](const Vec2& p) { return Vec2(p.x() + 1.0, 2.0 * p.y() + (p.y() > 0.2 ? p.y() - 0.2 : 0.0)); });
  const FitPatternEdgesResult result = fit_pattern_edges(pattern, mesh, target);
  const Panel& after = result.pattern.panels[0];
  EXPECT_NEAR(after.notches[0].at, 0.4, 1e-3);  // 0.2 of 0.4 goes to 0.4 of 1.0
  const Vec2 grain = (*after.grainline)[1] - (*after.grainline)[0];
  EXPECT_NEAR((grain - Vec2(0, 0.2)).norm(), 0, 1e-12);
  EXPECT_NEAR(after.keep_outs[0].polygon[0].x(), 1.1, 1e-9);
  EXPECT_NEAR((after.keep_outs[0].polygon[2] - after.keep_outs[0].polygon[0]).norm(), std::sqrt(2.0) * 0.05, 1e-12);
}

TEST(FitPatternEdges, CollapsedEdgesComeBack) {
  Pattern pattern;
  Panel panel;
  panel.name = "a";
  panel.corners = {{0, 0}, {0.1, 0}, {0.1, 0.002}, {0.1, 0.1}, {0, 0.1}};
  panel.edges.resize(5);
  pattern.panels.push_back(panel);
  const PatternMesh mesh = mesh_panels(pattern, {500, 0.02});
  ASSERT_EQ(mesh.edge_vertices[0][1].size(), 1u);
  const Points2 target = moved(mesh, [](const Vec2& p) { return Vec2(p.x(), 1.5 * p.y()); });
  const FitPatternEdgesResult result = fit_pattern_edges(pattern, mesh, target);
  EXPECT_NEAR(edge_length(result.pattern.panels[0], 1), 0.003, 1e-9);
}

}  // namespace
}  // namespace toile

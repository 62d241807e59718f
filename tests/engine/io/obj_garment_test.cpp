// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/obj_garment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/geometry/curve.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

// A tube of two panels, front and back, each `columns` x `rows` squares of 2 cm, wrapped round the y axis. The back's
// texture is mirrored when `mirrored`. Units as given; borders share no vertices.
std::string tube(int columns, int rows, double position_unit, double uv_unit, bool mirrored = false) {
  std::string text;
  char line[200];
  const double cell = 0.02, radius = 2 * columns * cell / (2 * M_PI);
  for (int panel = 0; panel < 2; ++panel)
    for (int r = 0; r <= rows; ++r)
      for (int c = 0; c <= columns; ++c) {
        const double angle = (panel * columns + c) * cell / radius;
        std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", radius * std::cos(angle) / position_unit,
                      (r * cell + 0.5) / position_unit, -radius * std::sin(angle) / position_unit);
        text += line;
        const double u = (panel == 1 && mirrored ? -c : c) * cell + 2.0 * panel;
        std::snprintf(line, sizeof line, "vt %.9g %.9g\n", u / uv_unit, r * cell / uv_unit);
        text += line;
      }
  for (int panel = 0; panel < 2; ++panel) {
    text += panel == 0 ? "o front\n" : "o back\n";
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const int at = panel * (columns + 1) * (rows + 1) + r * (columns + 1) + c + 1;
        std::snprintf(line, sizeof line, "f %d/%d %d/%d %d/%d %d/%d\n", at, at, at + 1, at + 1, at + columns + 2,
                      at + columns + 2, at + columns + 1, at + columns + 1);
        text += line;
      }
  }
  return text;
}

TEST(ObjGarment, ATubeBecomesTwoPanelsWithTwoSeams) {
  const ObjGarment garment = read_obj_garment(test::bytes_of(tube(20, 10, 1.0, 0.01)), "tube.obj");
  const Pattern& pattern = garment.pattern;
  ASSERT_EQ(pattern.panels.size(), 2u);
  EXPECT_EQ(pattern.panels[0].name, "front");
  for (const Panel& panel : pattern.panels) {
    ASSERT_EQ(panel.edge_count(), 4);
    EXPECT_NEAR(outline_signed_area(panel), 0.4 * 0.2, 1e-6);
    for (const PanelEdge& edge : panel.edges) EXPECT_EQ(edge.curve.kind, CurveKind::Line);
  }
  EXPECT_EQ(pattern.seams.size(), 2u);
  for (const Seam& seam : pattern.seams) EXPECT_FALSE(seam.right_wrong);
  ASSERT_TRUE(garment.mesh && garment.drape);
  EXPECT_EQ(garment.mesh->vertex_count(), 2 * 21 * 11);
  EXPECT_EQ(garment.mesh->node_count, 40 * 11);
  EXPECT_EQ(garment.mesh->seam_vertices[0].size(), 11u);
  EXPECT_NEAR(garment.drape->nodes.col(1).maxCoeff(), 0.7, 1e-6);
}

TEST(ObjGarment, UnitsAreFoundFromTheAreasOrTaken) {
  for (const auto& [position, uv] :
       {std::pair(1.0, 0.01), std::pair(0.001, 0.001), std::pair(0.01, 1.0), std::pair(0.001, 0.01)}) {
    const ObjGarment garment = read_obj_garment(test::bytes_of(tube(20, 20, position, uv)), "tube.obj");
    EXPECT_NEAR(std::abs(outline_signed_area(garment.pattern.panels[0])), 0.16, 1e-6);
    EXPECT_NEAR(garment.drape->nodes.col(1).maxCoeff(), 0.9, 1e-4);
    ObjGarmentOptions told;
    told.metre_per_uv_unit = uv;
    EXPECT_NEAR(std::abs(outline_signed_area(
                    read_obj_garment(test::bytes_of(tube(20, 20, position, uv)), "t", told).pattern.panels[0])),
                0.16, 1e-6);
  }
  EXPECT_THROW(read_obj_garment(test::bytes_of(tube(20, 20, 1.0, 0.3)), "normalised.obj"), Error);
}

TEST(ObjGarment, AMirroredTextureIsAPanelListedClockwise) {
  const ObjGarment garment = read_obj_garment(test::bytes_of(tube(20, 10, 1.0, 0.01, true)), "tube.obj");
  EXPECT_LT(outline_signed_area(garment.pattern.panels[1]), 0);
  EXPECT_TRUE(garment.mesh->panel_reversed[1]);
  EXPECT_EQ(garment.pattern.seams.size(), 2u);
  const PatternMesh& mesh = *garment.mesh;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Vec2 a = mesh.rest.row(mesh.triangles(f, 0)), b = mesh.rest.row(mesh.triangles(f, 1)),
               c = mesh.rest.row(mesh.triangles(f, 2));
    EXPECT_GT((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x(), 0);
  }
}

TEST(ObjGarment, PanelsArePlacedOnTheirOutside) {
  const ObjGarment garment = read_obj_garment(test::bytes_of(tube(20, 10, 1.0, 0.01)), "tube.obj");
  for (std::size_t p = 0; p < 2; ++p) {
    const Panel& panel = garment.pattern.panels[p];
    const Vec3 outward = panel.rotation.col(2);
    const Vec3 centre = panel.rotation * Vec3(0.2 + 2.0 * static_cast<double>(p), 0.1, 0) + panel.translation;
    EXPECT_GT(centre.dot(outward), 0.8 / (2 * M_PI)) << "outside the tube";
    EXPECT_NEAR(centre.y(), 0.6, 1e-6);
    EXPECT_NEAR(panel.rotation(1, 1), 1.0, 1e-6) << "upright";
  }
}

TEST(ObjGarment, FlatPositionsTakeTheirSeamsFromASidecar) {
  std::string text =
      "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
      "o b\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\nvt 2 0\nvt 3 0\nvt 3 1\nvt 2 1\nf 5/5 6/6 7/7 8/8\n";
  const Bytes sidecar = test::bytes_of(R"({"schema": "toile/seams/1",
    "seams": [[{"from": 2, "to": 3}, {"from": 5, "to": 8}]],
    "panels": {"a": {"translation": [10, 20, 30], "label": "body"}}, "toile": {"fabric": "denim"}})");
  ObjGarmentOptions options;
  options.metre_per_uv_unit = 1.0;
  options.sidecar = sidecar;
  const ObjGarment garment = read_obj_garment(test::bytes_of(text), "flat.obj", options);
  EXPECT_FALSE(garment.drape);
  ASSERT_EQ(garment.pattern.seams.size(), 1u);
  const Seam& seam = garment.pattern.seams[0];
  EXPECT_EQ(garment.pattern.panel(seam.a.panel).edge_start(seam.a.edge), Vec2(1, 0));
  EXPECT_EQ(garment.pattern.panel(seam.b.panel).edge_start(seam.b.edge), Vec2(2, 1));
  EXPECT_NEAR(garment.pattern.panels[0].translation.z(), 0.3, 1e-12);
  EXPECT_EQ(garment.pattern.fabric.name, "denim");
  options.sidecar = {};
  EXPECT_TRUE(read_obj_garment(test::bytes_of(text), "flat.obj", options).pattern.seams.empty());
}

TEST(ObjGarment, RefusesWhatIsNoGarment) {
  const auto refusal = [](const std::string& text) {
    try {
      read_obj_garment(test::bytes_of(text), "bad.obj");
    } catch (const Error& error) {
      EXPECT_EQ(exit_code(error.code), 3) << error.what();
      EXPECT_FALSE(error.message.empty());
      return std::string(error_name(error.code));
    }
    return std::string("accepted");
  };
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 .1\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  EXPECT_EQ(refusal(""), "file_malformed");
  EXPECT_EQ(refusal(vertices), "file_malformed");
  EXPECT_EQ(refusal(vertices + "f 1 2 3\n"), "file_malformed") << "no texture";
  EXPECT_EQ(refusal(vertices + "f 1//1 2//1 3//1\n"), "file_malformed");
  EXPECT_EQ(refusal(vertices + "f 1/1 2/2 9/3\n"), "file_malformed");
  EXPECT_EQ(refusal(vertices + "f 1/1 2/2 3/9\n"), "file_malformed");
  EXPECT_EQ(refusal("v 0 0 nan\n"), "file_malformed");
  EXPECT_EQ(refusal(vertices + "f 1/1 2/2 3/3\nf 1/1 2/2 4/4\n"), "garment_invalid") << "two faces of one side";
  EXPECT_EQ(refusal(vertices + "f 1/1 2/2 2/2\n"), "garment_invalid") << "no area";
}

}  // namespace
}  // namespace toile

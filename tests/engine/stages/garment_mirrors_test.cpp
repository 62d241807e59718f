// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/garment_mirrors.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/stages/build_fitting_map.h"
#include "engine/stages/derive_pattern.h"
#include "engine/stages/fit_pattern_edges.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "tests/support/grid_garment.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// Panels as the file places them round the body, sewn points in the middle: worn well enough to tell left from right
// and front from back.
Drape placed(const Pattern& pattern, const PatternMesh& mesh) {
  Drape drape;
  drape.nodes = Points3::Zero(mesh.node_count, 3);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(mesh.node_count);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(mesh.panel_of_vertex[static_cast<std::size_t>(v)])];
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    const Vec3 world = panel.rotation * Vec3(mesh.rest(v, 0), mesh.rest(v, 1), 0.0) + panel.translation;
    drape.nodes.row(node) += world.transpose();
    count[node] += 1.0;
  }
  drape.nodes.array().colwise() /= count.array();
  return drape;
}

TEST(GarmentMirrors, LeftPanelsAreImagesOfRightOnesInEveryGarment) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"tshirt_fitted", "pants_straight", "leggings_tight"}) {
    SCOPED_TRACE(name);
    const Pattern pattern =
        import_pattern(test::read_file(test::shared_data(std::string("garments/") + name + "_specification.json")));
    const PatternMesh mesh = mesh_panels(pattern, {.triangles = 2000, .edge_length = {}});
    const GarmentMirrors mirrors = find_garment_mirrors(pattern, mesh, placed(pattern, mesh));
    ASSERT_FALSE(mirrors.empty());
    for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
      const PanelImage& image = mirrors.panels[p];
      ASSERT_GE(image.panel, 0) << pattern.panels[p].name;
      EXPECT_EQ(mirrors.panels[static_cast<std::size_t>(image.panel)].panel, static_cast<int>(p));
      std::string other = pattern.panels[p].name;
      if (const auto left = other.find("left_"); left != std::string::npos)
        other.replace(left, 5, "right_");
      else if (other.ends_with("_l"))
        other.back() = 'r';
      else
        continue;
      EXPECT_EQ(pattern.panels[static_cast<std::size_t>(image.panel)].name, other);
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) EXPECT_GE(mirrors.vertex[static_cast<std::size_t>(v)], 0);
  }
}

// Front and back of one shape round a tube whose left side is wider than its right.
struct Lopsided {
  Pattern pattern = test::grid_garment({{"front", 0.44, 0.6, 4, 4, 0.0}, {"back", 0.44, 0.6, 4, 4, 0.0}},
                                       {{0, 1, 1, 3}, {1, 1, 0, 3}})
                        .pattern;
  PatternMesh mesh = mesh_panels(pattern, {.triangles = 1500, .edge_length = {}});

  Drape worn(double bulge) const {
    Drape drape;
    drape.nodes.resize(mesh.node_count, 3);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const int panel = mesh.panel_of_vertex[static_cast<std::size_t>(v)];
      const double angle = (mesh.rest(v, 0) - 0.22) / 0.14 + panel * std::numbers::pi;
      const double r = 0.14 * (1.0 + bulge * std::max(0.0, std::sin(angle)));
      drape.nodes.row(mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
          Vec3(r * std::sin(angle), mesh.rest(v, 1), r * std::cos(angle)).transpose();
    }
    return drape;
  }
};

TEST(GarmentMirrors, AFrontIsItsOwnImageAndNotThatOfABackOfTheSameShape) {
  const Lopsided tube;
  const GarmentMirrors mirrors = find_garment_mirrors(tube.pattern, tube.mesh, tube.worn(0.0));
  ASSERT_EQ(mirrors.panels.size(), 2u);
  EXPECT_EQ(mirrors.panels[0].panel, 0);
  EXPECT_EQ(mirrors.panels[1].panel, 1);
}

double asymmetry(const PatternMesh& mesh, const GarmentMirrors& mirrors, const Points2& rest) {
  Points2 even = rest;
  symmetrise(mesh, mirrors, even);
  return (even - rest).rowwise().norm().maxCoeff();
}

TEST(GarmentMirrors, AnAsymmetricBodyGetsASymmetricPatternUnlessAskedOtherwise) {
  const Lopsided tube;
  const PatternMesh& mesh = tube.mesh;
  const FittingMap fit = build_fitting_map(mesh, tube.worn(0.0));
  const Drape target = tube.worn(0.25);
  const GarmentMirrors mirrors = find_garment_mirrors(tube.pattern, mesh, tube.worn(0.0));
  ASSERT_GE(mirrors.vertex.front(), 0) << "the mesh must be mirrored";
  const DerivePatternResult even = derive_pattern(tube.pattern, mesh, fit, target, mirrors);
  const DerivePatternResult free = derive_pattern(tube.pattern, mesh, fit, target);
  EXPECT_GT(asymmetry(mesh, mirrors, free.rest), 2e-3) << "the case must be one";
  EXPECT_LT(asymmetry(mesh, mirrors, even.rest), 1e-12);
  EXPECT_LT(free.fit_residual, even.fit_residual);
  for (std::size_t i = 1; i < even.sweeps.size(); ++i) {
    if (even.sweeps[i].edge_weight == even.sweeps[i - 1].edge_weight) {
      EXPECT_LE(even.sweeps[i].energy, even.sweeps[i - 1].energy * (1 + 1e-9)) << "sweep " << i;
    }
  }
  // The middle of the front's hem stays on its axis; the drawn corners are mirror images to the last bits.
  const Pattern drawn = fit_pattern_edges(tube.pattern, mesh, even.rest, mirrors).pattern;
  const Panel& front = drawn.panels[0];
  EXPECT_NEAR((front.corners[1] - front.corners[0]).y(), 0.0, 1e-12);
  EXPECT_NEAR((front.corners[1] - front.corners[2]).norm(), (front.corners[0] - front.corners[3]).norm(), 1e-12);
}

}  // namespace
}  // namespace toile

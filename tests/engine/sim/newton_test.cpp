// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/newton.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/sim/relax.h"
#include "tests/support/ledger/ledger.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

constexpr double kTubeRadius = 0.14;

// Of a cloth that does not fold: soft folds of a hem wander for hundreds of iterations.
Pattern stiff(Pattern pattern) {
  pattern.fabric.bending_stiffness *= 10;
  return pattern;
}

struct Skirt {
  Pattern pattern = stiff(test::tube_skirt_pattern(0.88, 0.4, 0.1, 0.2));
  PatternMesh mesh = test::structured_mesh(pattern, 14, 12);
  Cloth cloth = make_cloth(pattern, mesh);
  Body body = test::tube_body(
      "tube", [](double y) { return kTubeRadius + 0.03 * std::cos(7 * y); }, 0.8);
  SurfaceField field{body.surface.vertices, body.surface.triangles};
  Points3 start() const {
    return test::wrapped_tube(
               pattern, mesh, [](double) { return 0.18; }, 0.1)
        .nodes;
  }
  void hold(DrapeEnergy& energy) const {
    for (int v : mesh.edge_vertices[0][2])
      energy.holds.push_back({mesh.node_of_vertex[static_cast<std::size_t>(v)], 0.5, 1e4});
  }
};

void expect_falling(const std::vector<double>& energies) {
  ASSERT_GE(energies.size(), 3U);
  for (std::size_t i = 1; i < energies.size(); ++i)
    EXPECT_LE(energies[i], energies[i - 1] + 1e-12 * std::abs(energies[i - 1])) << i;
  EXPECT_LT(energies.back(), energies.front());
}

TEST(Newton, BringsAFrictionlessSkirtToRestWithFallingEnergy) {
  Skirt s;
  ContactOptions options;
  options.friction = 0;
  Contact contact(s.cloth, s.field, options);
  DrapeEnergy energy(s.cloth, &contact, kGravity);
  s.hold(energy);
  const NewtonResult result = newton(energy, s.start(), {}, nullptr);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.residual, 1e-6);
  expect_falling(result.energies);
  EXPECT_GT((result.nodes - s.start()).norm(), 0.1);
}

TEST(Newton, ContinuesFromTheDefaultsEndWithItsAnchors) {
  Skirt s;
  Contact contact(s.cloth, s.field, {});
  DrapeEnergy energy(s.cloth, &contact, kGravity);
  s.hold(energy);
  RelaxOptions relax_options;
  relax_options.stop_residual = 0.3;
  const RelaxResult rough = relax(energy, s.start(), relax_options, nullptr);
  ASSERT_TRUE(rough.converged);
  const NewtonResult result = newton(energy, rough.nodes, {}, nullptr);
  EXPECT_LT(result.residual, 1e-6);
  EXPECT_LT(result.energy, rough.energy);
  EXPECT_LT(std::sqrt((result.nodes - rough.nodes).rowwise().squaredNorm().mean()), 0.005);
}

TEST(Newton, IsAtRestWhereItEndedOnceMore) {
  Skirt s;
  ContactOptions options;
  options.friction = 0;
  Contact contact(s.cloth, s.field, options);
  DrapeEnergy energy(s.cloth, &contact, kGravity);
  s.hold(energy);
  const NewtonResult first = newton(energy, s.start(), {}, nullptr);
  const NewtonResult again = newton(energy, first.nodes, {}, nullptr);
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(again.nodes, first.nodes);
}

// Case 17 of design/method.md, which the default reaches as well.
TEST(Newton, HangingSheetStretchesUnderItsOwnWeight) {
  Pattern pattern = test::sheet_pattern(0.2, 0.6, 1.0);
  pattern.fabric = {"soft", 20, 20 - 0.01, 0.01, 0, 0.2};
  const PatternMesh mesh = test::structured_mesh(pattern, 6, 18);
  const Cloth cloth = make_cloth(pattern, mesh);
  DrapeEnergy energy(cloth, nullptr, kGravity);
  const Points3 start = test::placed_nodes(pattern, mesh);
  for (int v : mesh.edge_vertices[0][2]) {
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    energy.pins.push_back({node, start.row(node), 1e7});
  }
  const NewtonResult result = newton(energy, start, {}, nullptr);
  EXPECT_LT(result.residual, 1e-6);
  EXPECT_NEAR((0.4 - result.nodes.col(1).minCoeff()) / (0.2 * kGravity * 0.36 / 40), 1, 1e-3);
}

}  // namespace
}  // namespace toile

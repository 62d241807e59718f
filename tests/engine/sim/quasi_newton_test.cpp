// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/quasi_newton.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/sim/drape_energy.h"
#include "engine/sim/membrane.h"
#include "tests/engine/sim/finite_difference.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

// A crumpled sheet over a cylinder: contact comes and goes, and no step that is accepted may raise the energy.
TEST(QuasiNewton, EnergyNeverRisesOnAnAcceptedStep) {
  const test::GridGarment garment = test::grid_garment({{"sheet", 0.4, 0.4, 16, 16, 0.25}});
  const Cloth cloth = make_cloth(garment.pattern, garment.mesh);
  CylinderField body(0.1);
  Contact contact(cloth, body, {});
  DrapeEnergy energy(cloth, &contact, kGravity);
  Points3 nodes(cloth.node_count, 3);
  for (int v = 0; v < garment.mesh.vertex_count(); ++v)
    nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
        Vec3(garment.mesh.rest(v, 0) - 0.2, garment.mesh.rest(v, 1), 0.11);
  nodes += test::random_points(cloth.node_count, 0.02, 4);
  for (int n : {0, 16}) energy.pins.push_back({n, nodes.row(n), 100.0});

  SparseMatrix matrix = membrane_bound(cloth);
  for (int i = 0; i < cloth.node_count; ++i) matrix.coeffRef(i, i) += 1.0;
  RowSolver solver;
  ASSERT_TRUE(solver.factor(matrix));
  const QuasiNewton::Energy evaluate = [&](const Points3& x, Points3& g) { return energy.evaluate(x, g); };
  QuasiNewton minimiser(cloth.node_count, {});
  minimiser.start(nodes, evaluate);
  const double start = minimiser.energy();
  for (int k = 0; k < 200; ++k) {
    const double before = minimiser.energy();
    if (!minimiser.step(evaluate, solver)) break;
    Points3 gradient(nodes.rows(), 3);
    ASSERT_LE(minimiser.energy(), before) << k;
    ASSERT_EQ(minimiser.energy(), energy.evaluate(minimiser.nodes(), gradient)) << k;
  }
  EXPECT_LT(minimiser.energy(), 0.1 * start);
}

TEST(QuasiNewton, TakesTheSameStepsWithAndWithoutAHelper) {
  const test::GridGarment garment = test::grid_garment({{"sheet", 0.4, 0.4, 16, 16, 0.25}});
  const Cloth cloth = make_cloth(garment.pattern, garment.mesh);
  SparseMatrix matrix = membrane_bound(cloth);
  for (int i = 0; i < cloth.node_count; ++i) matrix.coeffRef(i, i) += 1.0;
  const auto minimised = [&](Helper* helper) {
    CylinderField body(0.1);
    Contact contact(cloth, body, {});
    DrapeEnergy energy(cloth, &contact, kGravity);
    energy.helper = helper;
    const Points3 nodes = test::random_points(cloth.node_count, 0.2, 4);
    RowSolver solver;
    EXPECT_TRUE(solver.factor(matrix));
    QuasiNewton minimiser(cloth.node_count, {});
    minimiser.set_helper(helper);
    const QuasiNewton::Energy evaluate = [&](const Points3& x, Points3& g) { return energy.evaluate(x, g); };
    minimiser.start(nodes, evaluate);
    for (int k = 0; k < 60; ++k) minimiser.step(evaluate, solver);
    return minimiser.nodes();
  };
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  Helper helper;
  helper.call();
  EXPECT_EQ(minimised(nullptr), minimised(&helper));
}

}  // namespace
}  // namespace toile

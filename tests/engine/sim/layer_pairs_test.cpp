// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/layer_pairs.h"

#include "tests/engine/sim/finite_difference.h"

namespace toile {
namespace {

constexpr double kThickness = 0.0015, kStiffness = 100;

LayerPairs pairs_of(LayerPair::Kind kind, const Points3& nodes) {
  LayerPair pair{kind, {0, 1, 2, 3}, Vec3::UnitZ()};
  pair.stiffness = kStiffness;
  pair.thickness = kThickness;
  LayerPairs pairs;
  pairs.add(pair, nodes);
  return pairs;
}

test::EnergyFunction energy_of(const LayerPairs& pairs) {
  return [&pairs](const Points3& x, Points3& g) {
    g.setZero();
    return pairs.energy_gradient(x, g);
  };
}

// A vertex above (x, y) of a triangle with its corners at the origin and 2 cm along x and y.
Points3 vertex_above(double x, double y, double height) {
  Points3 nodes(4, 3);
  nodes << x, y, height, 0, 0, 0, 0.02, 0, 0, 0, 0.02, 0;
  return nodes;
}

// An edge of 2 cm along x whose middle lies `height` above (x, 0), over one through the origin, turned by `angle`.
Points3 edge_above(double x, double height, double angle) {
  const Vec3 along = 0.01 * Vec3(std::cos(angle), std::sin(angle), 0);
  Points3 nodes(4, 3);
  nodes << x - 0.01, 0, height, x + 0.01, 0, height, -along.transpose(), along.transpose();
  return nodes;
}

TEST(LayerPairs, GradientIsTheDerivativeAboveFaceEdgeAndCorner) {
  for (const Vec2& at : {Vec2(0.005, 0.006), Vec2(0.007, -0.0004), Vec2(-0.0003, -0.0005)})
    for (double height : {0.0011, 0.0001}) {
      const Points3 nodes = vertex_above(at.x(), at.y(), height);
      const LayerPairs pairs = pairs_of(LayerPair::Kind::VertexTriangle, nodes);
      test::expect_gradient(energy_of(pairs), nodes, 1e-8, 1e-4);
    }
}

TEST(LayerPairs, GradientIsTheDerivativeForEdgesThatCrossAreAlmostParallelOrEnd) {
  for (double angle : {1.2, 0.15, 0.03})
    for (double x : {0.002, 0.0103}) {
      const Points3 nodes = edge_above(x, 0.0008, angle);
      const LayerPairs pairs = pairs_of(LayerPair::Kind::EdgeEdge, nodes);
      test::expect_gradient(energy_of(pairs), nodes, 1e-9, 1e-4);
    }
}

TEST(LayerPairs, ForceDoesNotJumpWhereAVertexSlidesOverARim) {
  const double step = 1e-7;
  const LayerPairs pairs = pairs_of(LayerPair::Kind::VertexTriangle, vertex_above(0.001, 0.001, 0.0005));
  Points3 before(4, 3), after(4, 3);
  double strongest = 0, jump = 0;
  for (int k = -20000; k < 20000; ++k) {  // over the corner at the origin and its two edges
    energy_of(pairs)(vertex_above(k * step, 0.3 * k * step, 0.0005), before);
    energy_of(pairs)(vertex_above((k + 1) * step, 0.3 * (k + 1) * step, 0.0005), after);
    strongest = std::max(strongest, after.norm());
    jump = std::max(jump, (after - before).norm());
  }
  ASSERT_GT(strongest, 0.1);
  EXPECT_LT(jump, 1e-3 * strongest);
}

TEST(LayerPairs, ForceDoesNotJumpWhereEdgesTurnThroughParallelOrSlideOffEachOther) {
  const LayerPairs pairs = pairs_of(LayerPair::Kind::EdgeEdge, edge_above(0.001, 0.0005, 0.5));
  Points3 before(4, 3), after(4, 3);
  double strongest = 0, jump = 0;
  for (int k = -5000; k < 5000; ++k) {
    energy_of(pairs)(edge_above(0.001, 0.0005, 1e-4 * k), before);
    energy_of(pairs)(edge_above(0.001, 0.0005, 1e-4 * (k + 1)), after);
    strongest = std::max(strongest, after.norm());
    jump = std::max(jump, (after - before).norm());
  }
  for (int k = 0; k < 20000; ++k) {
    energy_of(pairs)(edge_above(1e-6 * k, 0.0005, 0.7), before);
    energy_of(pairs)(edge_above(1e-6 * (k + 1), 0.0005, 0.7), after);
    jump = std::max(jump, (after - before).norm());
  }
  ASSERT_GT(strongest, 0.1);
  EXPECT_LT(jump, 5e-3 * strongest);
}

TEST(LayerPairs, HeldPairsKeepTheForceAndTheirHessianIsExact) {
  const Points3 nodes = vertex_above(0.007, -0.0004, 0.0006);
  LayerPairs pairs = pairs_of(LayerPair::Kind::VertexTriangle, nodes);
  Points3 moving(4, 3), held(4, 3);
  energy_of(pairs)(nodes, moving);
  pairs.hold(nodes);
  energy_of(pairs)(nodes, held);
  ASSERT_GT(moving.norm(), 0.01);
  EXPECT_LT((moving - held).norm(), 1e-9 * moving.norm());
  std::vector<Eigen::Triplet<double>> entries;
  pairs.add_stiffness(nodes, entries);
  double diagonal = 0;
  for (const auto& entry : entries)
    if (entry.row() == 0 && entry.col() == 0) diagonal += entry.value();
  const double gap = std::hypot(0.0004, 0.0006);
  const double expected = kStiffness * kThickness * kThickness / (gap * gap);
  EXPECT_NEAR(diagonal, expected, 1e-9 * expected);
}

// A vertex drawn onto a triangle by three times what the repulsion can grow to: every round the gap at which both
// balance, then swelling.
TEST(LayerPairs, LayersPressedHarderThanTheRepulsionSwellUntilTheyCarryItAndShrinkAgain) {
  Points3 swelling = Points3::Zero(4, 3);
  const auto balance = [&](double load, int rounds) {
    double gap = 0;
    for (int round = 0; round < rounds; ++round) {
      LayerPair pair{LayerPair::Kind::VertexTriangle, {0, 1, 2, 3}, Vec3::UnitZ()};
      pair.stiffness = kStiffness;
      pair.thickness = kThickness;
      pair.taken_up = swelling(0, 2) - swelling.bottomRows(3).col(2).mean();
      LayerPairs pairs;
      pairs.add(pair, vertex_above(0.006, 0.006, 0.001));
      double low = 0, high = 3 * kThickness;
      for (int i = 0; i < 50; ++i) {
        gap = 0.5 * (low + high);
        Points3 gradient(4, 3);
        energy_of(pairs)(vertex_above(0.006, 0.006, std::max(gap, 1e-7)), gradient);
        (-gradient(0, 2) > load ? low : high) = gap;
      }
      pairs.swell(vertex_above(0.006, 0.006, std::max(gap, 1e-7)), {}, swelling);
    }
    return gap;
  };
  const double hardest = 19 * kStiffness * kThickness;  // at no gap
  EXPECT_LT(balance(3 * hardest, 1), 1e-6);
  const double gap = balance(3 * hardest, 20);
  EXPECT_GT(gap, 0.09 * kThickness);
  EXPECT_LT(gap, 0.45 * kThickness);
  EXPECT_GT(swelling(0, 2), 0.1 * kThickness);
  balance(0.01 * hardest, 40);
  EXPECT_LT(swelling(0, 2), 0.01 * kThickness);
}

}  // namespace
}  // namespace toile

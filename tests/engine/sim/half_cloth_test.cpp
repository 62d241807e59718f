// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/half_cloth.h"

#include <random>

#include <gtest/gtest.h>

#include "engine/sim/relax.h"
#include "engine/stages/find_node_mirror.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

// A skirt pressed nearly flat across a cylinder that is too large for it: contact of nodes and of edges, friction,
// layers that touch.
struct PressedSkirt {
  explicit PressedSkirt(double girth = 0.9) : pattern(test::tube_skirt_pattern(girth, 0.3, 0.1, 0.2)) {}

  Pattern pattern;
  PatternMesh mesh = test::structured_mesh(pattern, 8, 6);
  Cloth cloth = make_cloth(pattern, mesh);
  NodeMirror mirror = *find_node_mirror(pattern, mesh, cloth, test::tube_body("tube", 0.14, 1.0).surface.vertices,
                                        test::placed_nodes(pattern, mesh));
  HalfCloth half = *half_of(cloth, mirror, test::placed_nodes(pattern, mesh));
  CylinderField field{0.14};
  ContactOptions contact_options;

  // Symmetric, else at random within a millimetre.
  Points3 nodes(unsigned seed) const {
    const auto radius = [](double) { return 0.145; };
    Points3 at = test::wrapped_tube(pattern, mesh, radius, 0.1).nodes;
    at.col(2) *= 0.004;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-0.001, 0.001);
    for (Eigen::Index i = 0; i < at.size(); ++i) at.data()[i] += off(random);
    symmetrise(mirror, at);
    return at;
  }
};

// Everything that acts, on all of the cloth or on its half.
struct Acting {
  Acting(PressedSkirt& s, bool halved)
      : half(halved ? &s.half : nullptr),
        contact(halved ? s.half.cloth : s.cloth, s.field, s.contact_options),
        edges(halved ? s.half.cloth : s.cloth, s.field, s.contact_options),
        layers(s.cloth, s.mesh, {.mirror = &s.mirror, .half = half}),
        energy(halved ? s.half.cloth : s.cloth, &contact, 9.81) {
    std::vector<Hold> holds = {{3, 0.3, 50.0}, {s.mirror.image[3], 0.3, 50.0}};
    for (int n = 0; n < s.cloth.node_count; ++n)
      if (s.mirror.image[static_cast<std::size_t>(n)] == n) holds.push_back({n, 0.5, 20.0});
    energy.holds = halved ? s.half.folded(holds) : holds;
    energy.half = half;
    energy.mirror = halved ? nullptr : &s.mirror;
    energy.edge_contact = &edges;
    energy.cloth_contact = &layers;
  }
  void look(const Points3& whole) {
    const Points3 nodes = moved(whole);
    contact.freeze_friction(nodes);
    edges.look(nodes);
    layers.refresh(nodes);
    layers.swell(nodes);
    layers.refresh(nodes);
  }
  Points3 moved(const Points3& whole) const { return half ? half->folded(whole) : whole; }

  const HalfCloth* half;
  Contact contact;
  EdgeContact edges;
  ClothContact layers;
  DrapeEnergy energy;
};

TEST(HalfCloth, HasHalfTheEnergyAndTheSameForces) {
  PressedSkirt s;
  Acting both(s, false), one(s, true);
  const Points3 first = s.nodes(1), then = s.nodes(2);
  both.look(first), one.look(first);
  ASSERT_GT(both.edges.count(), 10);
  ASSERT_EQ(one.energy.cloth().node_count, (s.cloth.node_count + static_cast<int>(s.half.cloth.middle.size())) / 2);
  Points3 layers_alone = Points3::Zero(s.cloth.node_count, 3);
  ASSERT_GT(both.layers.pairs().energy_gradient(then, layers_alone), 0);
  ASSERT_GT(layers_alone.rowwise().norm().maxCoeff(), 1e-3);

  Points3 gradient(s.cloth.node_count, 3), rows(s.half.cloth.node_count, 3);
  const double whole = both.energy.evaluate(then, gradient);
  EXPECT_NEAR(2 * one.energy.evaluate(one.moved(then), rows), whole, 1e-9 * whole);
  const double largest = gradient.rowwise().norm().maxCoeff();
  for (int i = 0; i < rows.rows(); ++i) {
    const bool middle = s.half.node[static_cast<std::size_t>(i)] == s.half.image[static_cast<std::size_t>(i)];
    const Vec3 expected = (middle ? 0.5 : 1.0) * gradient.row(s.half.node[static_cast<std::size_t>(i)]);
    EXPECT_LT((rows.row(i).transpose() - expected).norm(), 1e-9 * largest);
  }
  EXPECT_NEAR(one.energy.residual(rows), both.energy.residual(gradient), 1e-9 * both.energy.residual(gradient));
  Eigen::VectorXd ours = one.energy.squared_forces(rows), theirs = both.energy.squared_forces(gradient);
  std::sort(ours.begin(), ours.end());
  std::sort(theirs.begin(), theirs.end());
  ASSERT_EQ(ours.size(), theirs.size());
  EXPECT_LT((ours - theirs).norm(), 1e-9 * theirs.norm());
}

TEST(HalfCloth, IsStoppedByThePlanesOfTheWhole) {
  PressedSkirt s;
  Acting both(s, false), one(s, true);
  const Points3 from = s.nodes(1);
  both.look(from), one.look(from);
  Points3 to = from;
  to.col(2) *= -1;  // the layers would change places
  Points3 rows = one.moved(to);
  ASSERT_TRUE(one.layers.limit(one.moved(from), rows));
  const Points3 limited = s.half.unfolded(rows);
  ASSERT_GT((limited - to).rowwise().norm().maxCoeff(), 1e-4);
  Points3 allowed = limited;
  both.layers.limit(from, allowed);
  EXPECT_LT((allowed - limited).rowwise().norm().maxCoeff(), 1e-9);
}

TEST(HalfCloth, ComesToTheSameRestLookingAtOneSideAlone) {
  class OneSided : public CylinderField {
   public:
    using CylinderField::CylinderField;
    double evaluate(const Vec3& p, double reach, Vec3& gradient) override {
      left += p.x() > 1e-9, right += p.x() < -1e-9;
      return CylinderField::evaluate(p, reach, gradient);
    }
    int left = 0, right = 0;
  };
  PressedSkirt s(0.84);
  const auto radius = [](double) { return 0.146; };
  Points3 start = test::wrapped_tube(s.pattern, s.mesh, radius, 0.1).nodes;
  symmetrise(s.mirror, start);
  s.contact_options.friction = 0;  // which would allow many rests
  std::vector<Hold> holds;
  for (int n = 0; n < s.cloth.node_count; ++n)
    if (start(n, 1) > 0.399) holds.push_back({n, 0.4, 500.0});
  ASSERT_GT(holds.size(), 8u);
  const auto rest = [&](bool halved, OneSided& field) {
    Contact contact(halved ? s.half.cloth : s.cloth, field, s.contact_options);
    DrapeEnergy energy(halved ? s.half.cloth : s.cloth, &contact, 9.81);
    energy.half = halved ? &s.half : nullptr;
    energy.mirror = halved ? nullptr : &s.mirror;
    energy.holds = halved ? s.half.folded(holds) : holds;
    RelaxOptions options;
    options.stop_residual = 1e-4;
    return relax(energy, start, options, nullptr);
  };
  OneSided all(0.14), half(0.14);
  const RelaxResult one = rest(true, half), both = rest(false, all);
  ASSERT_TRUE(both.converged);
  EXPECT_TRUE(one.converged);
  EXPECT_EQ(half.right, 0);
  EXPECT_GT(half.left, 0);
  EXPECT_GT(all.right, 0);
  EXPECT_LT((one.nodes - both.nodes).rowwise().norm().maxCoeff(), 1e-6);
  EXPECT_NEAR(one.energy, both.energy, 1e-6 * std::abs(both.energy));
}

TEST(HalfCloth, FoldsAndUnfolds) {
  const PressedSkirt s;
  const Points3 nodes = s.nodes(3);
  EXPECT_EQ(s.half.unfolded(s.half.folded(nodes)), nodes);
  FrictionState friction{Eigen::VectorXd::LinSpaced(s.half.cloth.node_count, 1, 2), s.half.folded(nodes),
                         s.half.folded(nodes)};
  const FrictionState whole = s.half.unfolded(friction);
  EXPECT_NEAR(whole.load.sum(), 2 * friction.load.sum(), 1e-9);
  EXPECT_EQ(whole.anchor, nodes);
  const FrictionState again = s.half.folded(whole);
  EXPECT_EQ(again.load, friction.load);
  EXPECT_EQ(again.anchor, friction.anchor);
}

TEST(HalfCloth, NoneWhereTrianglesReachAcross) {
  const PressedSkirt s;
  const PatternMesh odd = test::structured_mesh(s.pattern, 7, 6);
  const Cloth cloth = make_cloth(s.pattern, odd);
  NodeMirror mirror;  // what lies opposite: no node is on the middle of a panel
  const Points3 at = test::placed_nodes(s.pattern, odd);
  for (int i = 0; i < odd.node_count; ++i) {
    Eigen::Index image = 0;
    (at.rowwise() - Eigen::RowVector3d(-at(i, 0), at(i, 1), at(i, 2))).rowwise().norm().minCoeff(&image);
    mirror.image.push_back(static_cast<int>(image));
  }
  EXPECT_FALSE(half_of(cloth, mirror, at));
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/edge_contact.h"

#include <utility>

#include "engine/sim/drape_energy.h"
#include "tests/engine/sim/finite_difference.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

// An upright finger of 8 mm between the nodes of a sheet of 5 cm squares, all of which lie outside it.
struct PiercedSheet {
  test::GridGarment garment = test::grid_garment({{"sheet", 0.2, 0.2, 4, 4}});
  Cloth cloth = make_cloth(garment.pattern, garment.mesh);
  CylinderField finger{0.008};
  EdgeContact contact{cloth, finger, {}};

  // Level, with the axis at (x, z) of the sheet.
  Points3 nodes(double x, double z) const {
    Points3 nodes(cloth.node_count, 3);
    for (int v = 0; v < garment.mesh.vertex_count(); ++v)
      nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
          Vec3(garment.mesh.rest(v, 0) - x, 0, garment.mesh.rest(v, 1) - z);
    return nodes;
  }
};

TEST(EdgeContact, TakesUpTheEdgeThatAFingerPiercesAndKeepsIt) {
  PiercedSheet s;
  EXPECT_FALSE(s.contact.look(s.nodes(0.3, 0.3)));  // beside the sheet
  EXPECT_TRUE(s.contact.look(s.nodes(0.076, 0.052)));
  EXPECT_EQ(s.contact.count(), 1);
  EXPECT_FALSE(s.contact.look(s.nodes(0.076, 0.052)));
  EXPECT_FALSE(s.contact.look(s.nodes(0.3, 0.3)));
  EXPECT_EQ(s.contact.count(), 1);
}

// Counts what it is asked.
struct CountingFinger : CylinderField {
  using CylinderField::CylinderField;
  int asked = 0;
  double evaluate(const Vec3& p, double reach, Vec3& gradient) override {
    ++asked;
    return CylinderField::evaluate(p, reach, gradient);
  }
};

TEST(EdgeContact, LooksAgainOnlyAtEdgesThatCanHaveComeInside) {
  const PiercedSheet s;
  CountingFinger finger(0.008);
  EdgeContact contact(s.cloth, finger, {});
  auto asked = [&, before = 0](const Points3& nodes) mutable {
    contact.look(nodes);
    return finger.asked - std::exchange(before, finger.asked);
  };
  const int all = asked(s.nodes(0.3, 0.3));  // 0.14 m aside
  ASSERT_GT(all, 30);
  EXPECT_EQ(asked(s.nodes(0.26, 0.3)), 0);
  const int some = asked(s.nodes(0.2, 0.2));
  EXPECT_GT(some, 0);
  EXPECT_LT(some, all);
  EXPECT_GT(asked(s.nodes(0.076, 0.052)), 0);
  EXPECT_EQ(contact.count(), 1);  // as if looked at there at once
}

TEST(EdgeContact, PushesTheEdgeOutOfTheFinger) {
  PiercedSheet s;
  Points3 nodes = s.nodes(0.076, 0.052), gradient = Points3::Zero(nodes.rows(), 3);
  ASSERT_TRUE(s.contact.look(nodes));
  const std::vector<Vec3> inside = s.contact.inside(nodes);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_NEAR(inside.front().norm(), std::hypot(0.001, 0.002), 1e-9);
  EXPECT_TRUE(s.contact.inside(s.nodes(0.3, 0.3)).empty());
  const double energy = s.contact.energy_gradient(nodes, gradient);
  EXPECT_GT(energy, 0);
  EXPECT_LT(s.contact.energy_gradient(nodes - 1e-3 / gradient.norm() * gradient, gradient), energy);
}

TEST(EdgeContact, GradientAndHessianAreTheDerivatives) {
  PiercedSheet s;
  const Points3 nodes = s.nodes(0.076, 0.052);
  ASSERT_TRUE(s.contact.look(nodes));
  test::expect_gradient(
      [&](const Points3& x, Points3& g) {
        g.setZero();
        return s.contact.energy_gradient(x, g);
      },
      nodes, 1e-7, 1e-5);
  BlockHessian hessian(s.cloth);
  s.contact.add_hessian(nodes, Curvature::Exact, hessian);
  const Points3 direction = test::random_points(s.cloth.node_count, 1, 3);
  Points3 ahead = Points3::Zero(nodes.rows(), 3), behind = ahead;
  s.contact.energy_gradient(nodes + 1e-6 * direction, ahead);
  s.contact.energy_gradient(nodes - 1e-6 * direction, behind);
  const Points3 expected = (ahead - behind) / 2e-6;
  ASSERT_GT(expected.norm(), 1);
  EXPECT_LT((hessian.times(direction) - expected).norm(), 1e-4 * expected.norm());
}

}  // namespace
}  // namespace toile

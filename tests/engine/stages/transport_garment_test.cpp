// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/transport_garment.h"

#include <gtest/gtest.h>

#include "engine/geometry/closest_point.h"
#include "engine/stages/make_form.h"
#include "engine/stages/register_bodies.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

struct Scene {
  Body reference = make_builtin_form("tube-14-100");
  Pattern pattern = test::tube_skirt_pattern(0.88, 0.6, 0.3, 0.2);
  PatternMesh mesh = test::structured_mesh(pattern, 16, 20);
  Drape drape = test::wrapped_tube(
      pattern, mesh, [](double) { return 0.1435; }, 0.3);

  Points3 carried_to(const Body& target) const {
    return transport_garment(mesh, drape, reference, target, register_bodies(reference, target).map).drape.nodes;
  }
};

TEST(TransportGarment, LeavesTheGarmentWhereItIsWhenBothBodiesAreTheSame) {
  const Scene scene;
  EXPECT_LT((scene.carried_to(scene.reference) - scene.drape.nodes).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TransportGarment, KeepsTheDistanceToTheBodyAndFollowsItsHeight) {
  const Scene scene;
  const Points3 carried = scene.carried_to(make_builtin_form("tube-18-125"));
  for (Eigen::Index i = 0; i < carried.rows(); ++i) {
    EXPECT_NEAR(carried(i, 1), 1.25 * scene.drape.nodes(i, 1), 1e-9);
    EXPECT_NEAR(std::hypot(carried(i, 0), carried(i, 2)), 0.18 + 0.0035,
                2e-4);  // facets of the 96-gon: r (1 - cos(pi/96))
  }
}

TEST(TransportGarment, EndsOutsideTheTarget) {
  Scene scene;
  scene.drape.nodes.row(7) *= 0.97;  // inside the reference body already
  const Body target = make_builtin_form("tube-11-100");
  const SurfaceTree tree(target.surface.vertices, target.surface.triangles);
  const Points3 carried = scene.carried_to(target);
  for (Eigen::Index i = 0; i < carried.rows(); ++i) EXPECT_GE(tree.signed_distance(carried.row(i)), 0.9e-3) << i;
}

TEST(RegisterBodies, RefusesOtherTopologyInsteadOfAssumingIt) {
  const Body tube = make_builtin_form("tube-14-100");
  Body other = tube;
  other.surface.triangles.row(5).swap(other.surface.triangles.row(6));
  EXPECT_TRUE(register_bodies(tube, tube).map.exact);
  EXPECT_THROW(register_bodies(tube, other), Error);
}

}  // namespace
}  // namespace toile

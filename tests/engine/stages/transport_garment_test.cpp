// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/transport_garment.h"

#include <gtest/gtest.h>

#include "engine/bodies/make_form.h"
#include "engine/bodies/register_bodies.h"
#include "engine/geometry/closest_point.h"
#include "tests/support/grid_garment.h"
#include "tests/support/solids.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

struct CarriedSkirt {
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
  const CarriedSkirt scene;
  EXPECT_LT((scene.carried_to(scene.reference) - scene.drape.nodes).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TransportGarment, KeepsTheDistanceToTheBodyAndFollowsItsHeight) {
  const CarriedSkirt scene;
  const Points3 carried = scene.carried_to(make_builtin_form("tube-18-125"));
  for (Eigen::Index i = 0; i < carried.rows(); ++i) {
    EXPECT_NEAR(carried(i, 1), 1.25 * scene.drape.nodes(i, 1), 1e-9);
    EXPECT_NEAR(std::hypot(carried(i, 0), carried(i, 2)), 0.18 + 0.0035,
                2e-4);  // facets of the 96-gon: r (1 - cos(pi/96))
  }
}

TEST(TransportGarment, EndsOutsideTheTarget) {
  CarriedSkirt scene;
  scene.drape.nodes.row(7) *= 0.97;  // inside the reference body already
  const Body target = make_builtin_form("tube-11-100");
  const SurfaceTree tree(target.surface.vertices, target.surface.triangles);
  const Points3 carried = scene.carried_to(target);
  for (Eigen::Index i = 0; i < carried.rows(); ++i) EXPECT_GE(tree.signed_distance(carried.row(i)), 0.9e-3) << i;
}

// Two boxes as legs, with a flat sheet in front of both; the map sets the legs 10 cm further apart.
TEST(TransportGarment, BridgesTheGapBetweenLimbsInsteadOfTearingIt) {
  const TriangleMesh left = test::make_box(Vec3(0.08, 0, -0.05), Vec3(0.20, 1, 0.05));
  const TriangleMesh right = test::make_box(Vec3(-0.20, 0, -0.05), Vec3(-0.08, 1, 0.05));
  Body legs;
  legs.kind = BodyKind::Form;
  legs.surface.vertices.resize(16, 3), legs.surface.vertices << left.vertices, right.vertices;
  legs.surface.triangles.resize(24, 3), legs.surface.triangles << left.triangles,
      (right.triangles.array() + 8).matrix();
  Body apart = legs;
  for (int v = 0; v < 16; ++v) apart.surface.vertices(v, 0) += v < 8 ? 0.05 : -0.05;

  const test::GridGarment sheet = test::grid_garment({{"sheet", 0.4, 0.4, 20, 20}});
  Drape drape;
  drape.nodes.resize(sheet.mesh.node_count, 3);
  for (int v = 0; v < sheet.mesh.vertex_count(); ++v)
    drape.nodes.row(sheet.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
        Vec3(sheet.mesh.rest(v, 0) - 0.2, sheet.mesh.rest(v, 1) + 0.3, 0.055);
  const Points3 carried =
      transport_garment(sheet.mesh, drape, legs, apart, register_bodies(legs, apart).map).drape.nodes;

  double longest = 0.0, shift = 0.0;
  for (int f = 0; f < sheet.mesh.triangle_count(); ++f) {
    const Eigen::Vector3i t = sheet.mesh.nodes_of_triangle(f);
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (carried.row(t[k]) - carried.row(t[(k + 1) % 3])).norm());
  }
  for (Eigen::Index i = 0; i < carried.rows(); ++i)
    shift = std::max(shift, std::abs(carried(i, 0) - drape.nodes(i, 0)));
  EXPECT_NEAR(shift, 0.05, 5e-3);  // the sheet does follow the legs; a plate swings a little beyond
  EXPECT_LT(longest, 0.07);        // carried one by one, neighbours at the middle part by 0.12
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

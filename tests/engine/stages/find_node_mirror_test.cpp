// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/find_node_mirror.h"

#include <gtest/gtest.h>

#include "tests/support/tubes.h"

namespace toile {
namespace {

struct SkirtOnATube {
  Body body = test::tube_body("tube", 0.14, 1.0);
  Pattern pattern = test::tube_skirt_pattern(0.9, 0.5, 0.3, 0.17);
  PatternMesh mesh = test::structured_mesh(pattern, 8, 6);
  Points3 start = test::placed_nodes(pattern, mesh);

  std::optional<NodeMirror> found() const {
    return find_node_mirror(pattern, mesh, make_cloth(pattern, mesh), body.surface.vertices, start);
  }
};

TEST(FindNodeMirror, EveryNodeOfASymmetricSkirtHasItsImage) {
  const SkirtOnATube s;
  const auto mirror = s.found();
  ASSERT_TRUE(mirror);
  for (int i = 0; i < s.mesh.node_count; ++i) {
    const int j = mirror->image[static_cast<std::size_t>(i)];
    EXPECT_EQ(mirror->image[static_cast<std::size_t>(j)], i);
    EXPECT_NEAR((s.start.row(i) - s.start.row(j) * Eigen::Vector3d(-1, 1, 1).asDiagonal()).norm(), 0, 1e-12);
  }
}

TEST(FindNodeMirror, NoneWhereTheBodyIsBentByATenthOfAMillimetre) {
  SkirtOnATube s;
  s.body.surface.vertices(1000, 2) += 1e-4;
  EXPECT_FALSE(s.found());
}

TEST(FindNodeMirror, NoneWhereTheGrainIsOblique) {
  SkirtOnATube s;
  s.pattern.fabric.warp_stiffness = 5 * s.pattern.fabric.weft_stiffness;
  EXPECT_TRUE(s.found());
  s.pattern.panels[0].grainline = {Vec2(0, 0), Vec2(1, 2)};
  EXPECT_FALSE(s.found());
}

TEST(FindNodeMirror, NoneWhereTheStartIsTwisted) {
  SkirtOnATube s;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, Vec3::UnitY()).toRotationMatrix();
  s.start = (s.start * turn).eval();
  EXPECT_FALSE(s.found());
}

TEST(FindNodeMirror, SidesArePartedAtTheMiddleUnlessOneCoversTheOther) {
  const NodeMirror mirror{{1, 0, 2}, {1, -1, 0}};
  const auto at = [](double x) {
    Points3 nodes = Points3::Zero(3, 3);
    nodes(0, 0) = x, nodes(1, 0) = -x;
    return nodes;
  };
  Points3 apart = at(0.01), touching = at(-0.003), covering = at(-0.04);
  EXPECT_TRUE(part_sides(mirror, apart));
  EXPECT_EQ(apart, at(0.01));
  EXPECT_TRUE(part_sides(mirror, touching));
  EXPECT_GT(touching(0, 0), 0);
  EXPECT_LT(touching(0, 0), 1e-3);
  EXPECT_EQ(touching(1, 0), -touching(0, 0));
  EXPECT_FALSE(part_sides(mirror, covering));
}

}  // namespace
}  // namespace toile

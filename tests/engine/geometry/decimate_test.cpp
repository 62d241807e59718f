// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/decimate.h"

#include <gtest/gtest.h>

#include "engine/geometry/half_edges.h"
#include "tests/support/solids.h"

namespace toile {
namespace {

TEST(Decimate, ASphereKeepsItsShapeClosedWithATenthOfTheVertices) {
  const TriangleMesh sphere = test::make_sphere(0.1, 50, 60);
  const TriangleMesh coarse = decimate(sphere, 300);
  EXPECT_GE(coarse.vertex_count(), 290);
  EXPECT_LE(coarse.vertex_count(), 310);
  EXPECT_TRUE(find_defects(coarse.vertex_count(), coarse.triangles).none());
  EXPECT_NEAR(test::volume_of(coarse), test::volume_of(sphere), 0.02 * test::volume_of(sphere));
}

TEST(Decimate, TheSameMeshGivesTheSameMesh) {
  const TriangleMesh sphere = test::make_sphere(0.1, 20, 30);
  EXPECT_EQ(decimate(sphere, 200).vertices, decimate(sphere, 200).vertices);
}

}  // namespace
}  // namespace toile

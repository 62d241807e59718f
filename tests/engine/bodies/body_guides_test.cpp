// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_guides.h"

#include <gtest/gtest.h>

#include "engine/bodies/make_builtin_body.h"

namespace toile {
namespace {

double depth(const SurfaceTree& surface, const Vec3& p) {
  const double distance = surface.closest_point(p).distance();
  return surface.winding_number(p) > 0 ? distance : -distance;
}

TEST(BodyGuides, TheMiddleOfALegLiesInTheLegWhereItsVerticesAreFew) {
  constexpr double kDeep = 0.015;  // m; the thinnest ankle is 4 cm across
  for (const char* name : {"man-50-178", "woman-38-168", "child-128"}) {
    const Body body = make_builtin_body(name);
    const SurfaceTree surface(body.surface.vertices, body.surface.triangles);
    const BodyGuides guides = find_body_guides(body, surface);
    for (const Side side : {Left, Right}) {
      ASSERT_GT(guides.leg[side].size(), 20u);
      // The highest may lie between the thighs, where they meet.
      for (std::size_t k = 1; k < guides.leg[side].size(); ++k)
        EXPECT_GT(depth(surface, guides.leg[side][k]), kDeep) << name << " at " << guides.leg[side][k].y() << " m";
    }
  }
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/leg_web.h"

#include <gtest/gtest.h>

#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// Middles of triangles on the mid-plane between two heights that do not face to the side.
int bridging_triangles(const TriangleMesh& mesh, double low, double high) {
  int count = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.triangles(f, 0)), b = mesh.vertices.row(mesh.triangles(f, 1)),
               c = mesh.vertices.row(mesh.triangles(f, 2)), middle = (a + b + c) / 3.0;
    const Vec3 normal = (b - a).cross(c - a).normalized();
    count += std::abs(middle.x()) < 0.01 && middle.y() > low && middle.y() < high && std::abs(normal.x()) < 0.5;
  }
  return count;
}

TEST(LegWeb, TakesOutTheWebBetweenThighsAndKeepsTheCrotchThatWasSeen) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::RegistrationCase known = test::scan_case("scan_a");
  const double crotch = known.landmarks.at("crotch").y();
  const TriangleMesh seen = without_leg_web(known.target.surface);
  const int joined = bridging_triangles(known.target.surface, crotch - 0.035, crotch - 0.008);
  EXPECT_GT(joined, 20);
  EXPECT_LT(bridging_triangles(seen, crotch - 0.035, crotch - 0.008), joined / 3.0);  // noise tips some of the walls
  const int seen_before = bridging_triangles(known.target.surface, crotch + 0.01, crotch + 0.06);
  EXPECT_GT(seen_before, 5);
  EXPECT_GT(bridging_triangles(seen, crotch + 0.01, crotch + 0.06), 0.95 * seen_before);
  EXPECT_LT(known.target.surface.triangle_count() - seen.triangle_count(), 200);
}

TEST(LegWeb, BelievesModelsWhoseThighsTouch) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = test::load_shared_body("ggg_large_male").surface;
  EXPECT_EQ(without_leg_web(body).triangles, body.triangles);
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/registered_skin.h"

#include <gtest/gtest.h>

#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// A map that was found, of as many points as the reference has; no more of it is looked at.
RegisterBodiesResult found_map(const TriangleMesh& reference, double scan_p95, double scan_tail) {
  RegisterBodiesResult result;
  result.map.mapped = reference.vertices;
  result.report.scan_p95 = scan_p95;
  result.report.scan_p99_without_hands = scan_tail;
  return result;
}

TEST(RegisteredSkin, IsTakenForAScanThatItLiesCloseTo) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh reference = test::load_shared_body("mh_female_average").surface;
  Body scan = test::scan_case("scan_a").target;
  EXPECT_EQ(take_registered_skin(scan, reference, found_map(reference, 2e-3, 4e-3), false), "registered_reference");
  EXPECT_EQ(scan.surface.triangles, reference.triangles);
}

TEST(RegisteredSkin, LeavesModelsHairAndWhatTheUserMarked) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh reference = test::load_shared_body("mh_female_average").surface;
  Body model = test::load_shared_body("mh_female_thin_tall"), scan = test::scan_case("scan_a").target;
  model.surface.vertices *= 1.001;
  const Triangles own = scan.surface.triangles;
  EXPECT_TRUE(take_registered_skin(model, reference, found_map(reference, 0.0, 0.0), false).starts_with("own"));
  EXPECT_TRUE(take_registered_skin(scan, reference, found_map(reference, 2e-3, 4e-3), true).starts_with("own"));
  EXPECT_TRUE(take_registered_skin(scan, reference, found_map(reference, 2e-3, 12e-3), false).starts_with("own"));
  EXPECT_TRUE(take_registered_skin(scan, reference, found_map(reference, 6e-3, 7e-3), false).starts_with("own"));
  EXPECT_EQ(scan.surface.triangles, own);
}

}  // namespace
}  // namespace toile

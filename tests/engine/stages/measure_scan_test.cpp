// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/measure_scan.h"

#include <gtest/gtest.h>

#include "engine/geometry/clean_mesh.h"
#include "engine/stages/normalise_body.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/sidecar.h"

namespace toile {
namespace {

constexpr double kLarge = 9e-3;    // m, ISO 20685-1 for large girths
constexpr double kBust = 10e-3;    // m: a flat chest has no bust to tell its height by
constexpr double kCrotch = 15e-3;  // m: cut away in these scans; it hangs on where the mannequin bridges it
constexpr double kHeight = 9e-3;   // m: crown and soles are cut away

class SlowMeasureScan : public testing::TestWithParam<const char*> {};

TEST_P(SlowMeasureScan, AgreesWithTheBodyTheScanWasMadeOf) {
  TOILE_REQUIRE_SHARED_DATA();
  const auto truth = test::load_body_sidecar(test::load_scan_sidecar(GetParam()).source_body).measurements;
  TriangleMesh raw = test::load_shared_scan(GetParam());
  clean_mesh(raw);
  Body scan;
  scan.surface = normalise_body(raw).surface;
  const MeasureScanResult result = measure_scan(scan);
  EXPECT_LT(result.registration.surface_mean, 2e-3);
  const auto expect = [&](const char* ours, const char* theirs, double tolerance) {
    EXPECT_NEAR(result.measured.measurements.at(ours), truth.at(theirs), tolerance) << ours;
  };
  expect("waist_girth", "waist", kLarge);
  expect("hip_girth", "hips", kLarge);
  expect("bust_girth", "bust_at_bust_points", kBust);
  expect("thigh_girth_left", "thigh_left", kCrotch);
  expect("height", "height", kHeight);
  expect("inside_leg_length", "inseam", kCrotch);
}

INSTANTIATE_TEST_SUITE_P(Scans, SlowMeasureScan, testing::Values("scan_a", "scan_b", "scan_c", "scan_d"));

}  // namespace
}  // namespace toile

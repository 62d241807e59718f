// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/measure_scan.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/normalise_body.h"
#include "engine/geometry/clean_mesh.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/sidecar.h"

namespace toile {
namespace {

// ISO 20685-1: what scanners are held to. Metres.
constexpr const char* kLargeGirths[] = {"bust_girth",  "underbust_girth", "chest_girth",
                                        "waist_girth", "belly_girth",     "hip_girth"};
double tolerance(const std::string& name) {
  return std::find(std::begin(kLargeGirths), std::end(kLargeGirths), name) != std::end(kLargeGirths)
             ? test::kLargeError
             : test::kSmallError;
}

class SlowMeasureScan : public testing::TestWithParam<const char*> {};

TEST_P(SlowMeasureScan, RepeatsEveryMeasureOfTheBodyTheScanWasMadeOf) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh source = test::load_shared_body(test::load_scan_sidecar(GetParam()).source_body).surface;
  const Measurements truth = measure_body(source, find_skeleton(source).skeleton).measurements;
  TriangleMesh raw = test::load_shared_scan(GetParam());
  clean_mesh(raw);
  Body scan;
  scan.surface = normalise_body(raw).surface;
  const MeasureScanResult result = measure_scan(scan);
  EXPECT_LT(result.registration.surface_mean, 2e-3);
  for (const auto& [name, value] : truth) {
    EXPECT_GT(value, 0.05) << name;
    EXPECT_NEAR(result.measured.measurements.at(name), value, tolerance(name)) << name;
  }
}

TEST(SlowMeasureScanOf, ScansTellWhichMeasuresAreEstimates) {
  TOILE_REQUIRE_SHARED_DATA();
  Body scan;
  scan.surface = normalise_body(test::load_shared_scan("scan_d")).surface;
  const std::vector<std::string> cut = measure_scan(scan).estimated;
  EXPECT_EQ(cut.front(), "height");
  EXPECT_NE(std::find(cut.begin(), cut.end(), "inside_leg_length"), cut.end());
  scan.surface = test::load_shared_body("ggg_mean_female").surface;
  EXPECT_TRUE(measure_scan(scan).estimated.empty());
}

INSTANTIATE_TEST_SUITE_P(Scans, SlowMeasureScan, testing::Values("scan_a", "scan_b", "scan_c", "scan_d"));

}  // namespace
}  // namespace toile

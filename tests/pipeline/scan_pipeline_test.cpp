// SPDX-License-Identifier: GPL-3.0-or-later
// A mannequin's skirt altered for a raw scan: what the user says of the scan reaches the body map, and what is asked
// for is drawn.
#include <gtest/gtest.h>

#include "engine/bodies/carry_landmarks.h"
#include "engine/core/error.h"
#include "engine/outputs.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

constexpr const char* kDocument = R"({"landmarks_m": {"waist_l": [0.172, 1.120, 0.030]}})";

AlterResult alter_skirt(const std::string& landmarks) {
  const GarmentInput skirt{"a_line_skirt.json",
                           test::read_file(std::string(TOILE_SOURCE_DIR) + "/schemas/examples/a_line_skirt.json")};
  BodyInput scan{.name = "scan_a.ply", .bytes = test::read_file(test::shared_data("scans/scan_a.ply"))};
  scan.landmarks.assign(landmarks.begin(), landmarks.end());
  AlterOptions options;
  options.triangles = 800;
  options.outputs = {"transport.png"};
  StageRunner runner(nullptr, nullptr, kAlterStages);
  return alter_garment(skirt, {.name = "builtin:woman-38-168", .bytes = {}}, scan, options, runner);
}

// How far the reference's landmark came to lie from where the user saw it in the file.
double waist_error(const AlterResult& result) {
  const Body& reference = result.reference.body;
  const Vec3 seen = (result.target_body.normalised_from_file * Vec3(0.172, 1.120, 0.030).homogeneous()).head<3>();
  const Landmarks carried = carry_landmarks(reference.landmarks, reference.surface, result.registration.map.mapped);
  return (carried.at("waist_l") - seen).norm();
}

TEST(SlowScanPipeline, LandmarksGivenWithTheTargetWinAndTheTransportIsDrawn) {
  TOILE_REQUIRE_SHARED_DATA();
  const AlterResult without = alter_skirt(""), with = alter_skirt(kDocument);
  EXPECT_GT(waist_error(without), 0.015);
  EXPECT_LT(waist_error(with), 0.005);
  EXPECT_EQ(std::get<std::int64_t>(*with.registration.diagnostics.find("landmarks_given")), 1);

  AlterOptions options;
  const auto names = [&](const AlterResult& result) {
    std::vector<std::string> found;
    for (const OutputFile& file : alter_outputs(result, options, {{}, {{}, {}}})) found.push_back(file.name);
    return found;
  };
  options.outputs = {"transport.png"};
  EXPECT_EQ(names(with), (std::vector<std::string>{"transport.png", "result.json"}));
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/body_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/io/json.h"
#include "engine/io/record_json.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

TEST(BodyJson, ABodyIsDescribedWithItsTransformInRows) {
  Body body;
  body.name = "someone";
  body.normalised_from_file(0, 3) = 2.5;
  body.measurements["waist_girth"] = 0.75;
  body.landmarks["crotch"] = Vec3(0, 0.8, 0.01);
  const Bytes json = write_json(describe_body(body));
  const std::string text(json.begin(), json.end());
  EXPECT_THAT(text, HasSubstr("\"kind\": \"human\""));
  EXPECT_THAT(text, HasSubstr("\"waist_girth\": 0.75"));
  EXPECT_THAT(text, HasSubstr("[\n   1.0,\n   0.0,\n   0.0,\n   2.5\n  ]"));
}

TEST(BodyJson, LandmarksInTheFilesFrameFollowTheBody) {
  const GivenLandmarks given = read_landmarks(test::bytes_of(R"({"landmarks": {"crotch": [0, 80, 1]}})"), "l.json");
  ASSERT_TRUE(given.in_file_frame);
  Mat4 transform = Mat4::Identity();
  transform.topLeftCorner<3, 3>() *= 0.01;
  transform(1, 3) = 0.005;
  EXPECT_TRUE(normalised_landmarks(given, transform).at("crotch").isApprox(Vec3(0, 0.805, 0.01)));
  const GivenLandmarks ours = read_landmarks(test::bytes_of(R"({"landmarks_m": {"crotch": [0, 0.8, 0]}})"), "l.json");
  EXPECT_EQ(normalised_landmarks(ours, transform).at("crotch"), Vec3(0, 0.8, 0));
}

TEST(BodyJson, MeasurementsComeInCentimetresOrMetres) {
  const Bytes text = test::bytes_of(" {\"figure\": \"woman\", \"measurements_cm\": {\"height\": 168}}");
  EXPECT_TRUE(looks_like_json(text));
  EXPECT_FALSE(looks_like_json(test::bytes_of("v 0 0 0\n")));
  EXPECT_DOUBLE_EQ(read_measurements(text, "m").measurements.at("height"), 1.68);
  EXPECT_EQ(read_measurements(text, "m").figure, "woman");
  const MeasurementsDocument metres = read_measurements(test::bytes_of(R"({"measurements_m": {"height": 1.7}})"), "m");
  EXPECT_DOUBLE_EQ(metres.measurements.at("height"), 1.7);
  EXPECT_EQ(metres.figure, "");
}

TEST(BodyJson, BadDocumentsAreRefusedWithFileAndPointer) {
  const std::pair<const char*, const char*> bad[] = {
      {R"({"landmarks": {"crotch": [0, 80]}})", "/landmarks/crotch"},
      {R"({"landmarks": {"crotch": [0, 80, "x"]}})", "/landmarks/crotch/2"},
      {R"({"landmarks": {"crotch": [0, 80, 1e9]}})", "/landmarks/crotch/2"},
      {R"({"points": {}})", "landmarks"},
      {R"({"landmarks": )", ""}};
  for (const auto& [text, place] : bad) {
    try {
      read_landmarks(test::bytes_of(text), "l.json");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ErrorCode::FileMalformed) << text;
      EXPECT_EQ(error.subject, "l.json");
      EXPECT_THAT(error.message, HasSubstr(place)) << text;
    }
  }
  EXPECT_THROW(read_measurements(test::bytes_of(R"({"measurements_cm": {"height": -1}})"), "m"), Error);
  EXPECT_THROW(read_measurements(test::bytes_of(R"({"measurements_m": {"height": 168}})"), "m"), Error);
}

}  // namespace
}  // namespace toile

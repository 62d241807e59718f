// SPDX-License-Identifier: GPL-3.0-or-later
// `toile body` as a process: what it prints, and how it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/io/mesh_file.h"
#include "engine/io/schema_check.h"
#include "tests/server/app/toile_program.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/solids.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

using test::toile_says;
using ::testing::HasSubstr;
using Json = nlohmann::json;

// Of the issue: a bad input costs no more than this, whatever it claims.
constexpr double kMostSeconds = 1.0, kMostMegabytes = 256.0;

test::ProcessResult body(std::vector<std::string> words) {
  words.insert(words.begin(), {"--quiet", "body"});
  return toile_says(std::move(words));
}

TEST(BodyCommand, PrintsOneDocumentAndWritesTheNormalisedBody) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::TemporaryFolder folder;
  const std::string out = folder.path() + "/B.obj";
  const auto result = body({test::shared_data("scans/scan_b.obj").string(), "--out", out});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json document = Json::parse(result.out);
  const SchemaCheck check = check_schema(Bytes(result.out.begin(), result.out.end()));
  EXPECT_EQ(check.schema, "body");
  for (const SchemaProblem& problem : check.problems) ADD_FAILURE() << problem.pointer << ": " << problem.message;
  EXPECT_EQ(document["normalisation"]["unit"], "mm");
  EXPECT_EQ(document["normalisation"]["up"], "+z");
  EXPECT_GE(document["repairs"]["closed_holes"], 7);
  EXPECT_NEAR(document["measurements_m"]["height"].get<double>(), 1.88, 0.02);
  EXPECT_EQ(document["landmarks_m"]["crotch"].size(), 3u);
  const TriangleMesh mesh = read_mesh(test::read_file(out), "B.obj");
  EXPECT_EQ(mesh.triangle_count(), document["counts"]["triangles"]);
  // The matrix takes the file's points to the body's: the first vertices are the file's.
  Mat4 matrix;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      matrix(r, c) = document["normalised_from_file"][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  const TriangleMesh file = test::load_shared_scan("scan_b");
  const Vec3 moved = (matrix * file.vertices.row(0).transpose().homogeneous()).head<3>();
  EXPECT_LT((moved - mesh.vertices.row(0).transpose()).norm(), 1e-5);
}

TEST(BodyCommand, TheSameFileGivesTheSameBytesWithOneThreadAndTwo) {
  TOILE_REQUIRE_SHARED_DATA();
  const std::string scan = test::shared_data("scans/scan_d.stl").string();
  const auto one = body({scan, "--threads", "1"}), two = body({scan, "--threads", "2"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
}

TEST(BodyCommand, AFormIsTakenAsItStands) {
  const test::TemporaryFolder folder;
  const std::string box =
      folder.write("box.obj", test::text_of(write_obj(test::make_box(Vec3(0, 0, 0), Vec3(30, 100, 30)))));
  const auto result = body({box, "--kind", "form", "--unit", "cm"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["kind"], "form");
}

TEST(BodyCommand, MakesMannequinsOfMeasurementsAndByName) {
  const test::TemporaryFolder folder;
  const std::string tape = folder.write(
      "tape.json", R"({"figure": "woman", "measurements_cm": {"height": 168, "waist_girth": 72, "hip_girth": 97}})");
  const auto made = body({"--measurements", tape});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Json measured = Json::parse(made.out)["measurements_m"];
  EXPECT_NEAR(measured["waist_girth"].get<double>(), 0.72, 0.005);
  EXPECT_NEAR(measured["hip_girth"].get<double>(), 0.97, 0.005);
  EXPECT_EQ(body({tape}).out, made.out);
  const auto child = body({"builtin:child-128"});
  ASSERT_EQ(child.exit_code, 0) << child.err;
  EXPECT_NEAR(Json::parse(child.out)["measurements_m"]["height"].get<double>(), 1.28, 0.005);
}

struct Bad {
  const char* name;
  std::string content;
  const char* said;
};

std::vector<Bad> bad_bodies() {
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string rest =
      "\nproperty float x\nproperty float y\nproperty float z\nelement face 10\n"
      "property list uint int vertex_indices\nend_header\n";
  std::string stl(84, ' ');
  stl[80] = stl[81] = stl[82] = '\xff', stl[83] = 3;  // 67 million triangles: 3.3 GB
  TriangleMesh small = test::make_sphere(0.03, 20, 30, Vec3(0, 0.03, 0));
  return {{"cut.obj", "v 0 0 0\nv 1 0", "line 2"},
          {"nan.obj", "v 0 nan 0\n", "line 1"},
          {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4"},
          {"none.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no triangles"},
          {"giant.ply", header + "1000000000" + rest, "line 3"},
          {"claim.ply", header + "250000" + rest, "cut short"},
          {"claim.stl", stl, "byte 80"},
          {"cube.obj", test::text_of(write_obj(test::make_box(Vec3::Zero(), Vec3::Ones()))), "person"},
          {"small.obj", test::text_of(write_obj(small)), "person"},
          {"giant.json", R"({"measurements_cm": {"height": 400}})", "measurements/height"},
          {"figure.json", R"({"figure": "cat", "measurements_cm": {"height": 170}})", "/figure"},
          {"empty.ply", "", "empty"}};
}

TEST(BodyCommand, BadBodiesAreRefusedQuicklyInLittleMemoryWithFilePlaceAndMend) {
  const test::TemporaryFolder folder;
  for (const Bad& bad : bad_bodies()) {
    const auto result = body({folder.write(bad.name, bad.content)});
    EXPECT_EQ(result.exit_code, 3) << bad.name << result.err;
    EXPECT_EQ(result.out, "") << bad.name;
    EXPECT_THAT(result.err, HasSubstr(bad.name));
    EXPECT_THAT(result.err, HasSubstr(bad.said)) << bad.name;
    EXPECT_LT(result.cpu_s, kMostSeconds) << bad.name;
    EXPECT_LT(result.peak_mb, kMostMegabytes) << bad.name;
  }
}

TEST(BodyCommand, APersonOfSixCentimetresIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  TriangleMesh tiny = test::load_shared_body("ggg_mean_all").surface;
  tiny.vertices *= 0.06 / 1.72;
  const test::TemporaryFolder folder;
  const auto result = body({folder.write("tiny.ply", test::text_of(write_ply(tiny)))});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("tall"));
  EXPECT_LT(result.cpu_s, kMostSeconds);
}

TEST(BodyCommand, LargestFilesStayWithinMemory) {
  const test::TemporaryFolder folder;
  const std::string limit = folder.write("limit.obj", "v 0 0 0\n" + std::string(std::size_t{65} << 20, '#'));
  const auto result = body({limit});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("64 MiB"));
  EXPECT_LT(result.peak_mb, kMostMegabytes);
}

TEST(BodyCommand, BadUsageIsExitCodeTwo) {
  EXPECT_EQ(body({}).exit_code, 2);
  EXPECT_EQ(body({"x.obj", "--unit", "furlong"}).exit_code, 2);
}

}  // namespace
}  // namespace toile

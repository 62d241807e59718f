// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/normalise_body.h"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

using test::load_shared_body;
using test::load_shared_scan;

constexpr double kSameBody = 1e-3;  // m, two variants of one file
// m: a person who is not quite symmetric has no exact yaw of its own; the file's differs by 0.14 degrees at most.
constexpr double kAgainstFile = 1.6e-3;

TriangleMesh box(const Vec3& size, const Vec3& low = Vec3::Zero()) {
  TriangleMesh m;
  m.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i) m.vertices.row(i) = low + Vec3(i & 1, i >> 1 & 1, i >> 2 & 1).cwiseProduct(size);
  m.triangles.resize(12, 3);
  m.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
      7, 5;
  return m;
}

TriangleMesh moved(const TriangleMesh& mesh, const Mat3& turn, double scale, const Vec3& shift) {
  TriangleMesh out = mesh;
  out.vertices = (mesh.vertices * turn.transpose() * scale).rowwise() + shift.transpose();
  return out;
}

Mat3 about_y(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
}

double largest_move(const TriangleMesh& a, const TriangleMesh& b) {
  return (a.vertices - b.vertices).rowwise().norm().maxCoeff();
}

ErrorCode refused_with(const TriangleMesh& mesh, std::string* message = nullptr) {
  try {
    normalise_body(mesh);
  } catch (const Error& error) {
    if (message) *message = error.message;
    return error.code;
  }
  return ErrorCode::Internal;  // nothing was refused
}

TEST(NormaliseBody, KeepsTheCoordinatesOfEverySharedBody) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const TriangleMesh body = load_shared_body(name).surface;
    const NormaliseBodyResult result = normalise_body(body);
    EXPECT_TRUE(result.kept_coordinates) << name;
    EXPECT_TRUE(result.surface.vertices == body.vertices) << name;
    EXPECT_EQ(result.normalised_from_file, Mat4::Identity()) << name;
    EXPECT_GT(result.up_score, 1.8) << name;
  }
}

TEST(NormaliseBody, FindsAnyUnitAxisAndYaw) {
  TOILE_REQUIRE_SHARED_DATA();
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  for (const std::string& name : test::shared_body_names()) {
    const TriangleMesh body = load_shared_body(name).surface;
    const Mat3 yaw = about_y(uniform(1.0, 5.0));
    const NormaliseBodyResult first = normalise_body(moved(body, yaw, 1.0, Vec3::Zero()));
    EXPECT_LT(largest_move(first.surface, body), kAgainstFile) << name;
    const auto up = static_cast<UpAxis>(random() % 6);
    const auto unit = static_cast<LengthUnit>(random() % 4);
    const NormaliseBodyResult second = normalise_body(
        moved(body, turn_upright(up).transpose() * about_y(uniform(-3.0, 3.0)), 1.0 / metres_per(unit), Vec3::Zero()));
    EXPECT_EQ(second.up, up) << name;
    EXPECT_EQ(second.unit, unit) << name;
    EXPECT_LT(largest_move(second.surface, first.surface), kSameBody) << name;
  }
}

TEST(NormaliseBody, BringsAShiftedBodyToTheOrigin) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = load_shared_body("mh_male_average").surface;
  const NormaliseBodyResult result = normalise_body(moved(body, about_y(0.6), 100.0, Vec3(300, -80, 55)));
  const TriangleMesh again = normalise_body(moved(body, about_y(-1.9), 1.0, Vec3(-2, 4, 1))).surface;
  EXPECT_LT(largest_move(result.surface, again), kSameBody);
  EXPECT_LT(std::abs(result.surface.vertices.col(1).minCoeff()), 2e-3);
  const Vec3 shift = (result.surface.vertices - body.vertices).colwise().mean();
  EXPECT_LT(std::abs(shift.x()), 1e-3);
  EXPECT_LT(((result.surface.vertices - body.vertices).rowwise() - shift.transpose()).rowwise().norm().maxCoeff(),
            1e-3);
}

TEST(NormaliseBody, StraightensABodyThatLeansToASide) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"mh_female_average", "ggg_mean_male"}) {
    const TriangleMesh body = load_shared_body(name).surface;
    const Mat3 lean = Eigen::AngleAxisd(-5.0 * kRadianPerDegree, Vec3::UnitZ()).toRotationMatrix();
    const NormaliseBodyResult result = normalise_body(moved(body, about_y(0.8) * lean, 1.0, Vec3(0.2, 0, 0.1)));
    EXPECT_LT(result.mirror_residual, 4e-3) << name;
    EXPECT_FALSE(result.warnings.empty()) << name;
    const Vec3 shift = (result.surface.vertices - body.vertices).colwise().mean();
    EXPECT_LT(std::abs(shift.x()), 3e-3) << name;
    EXPECT_LT(((result.surface.vertices - body.vertices).rowwise() - shift.transpose()).rowwise().norm().maxCoeff(),
              10e-3)
        << name;
  }
}

TEST(NormaliseBody, PutsScansUpright) {
  TOILE_REQUIRE_SHARED_DATA();
  const auto normalised = [](const char* name) { return normalise_body(load_shared_scan(name)); };
  const auto a = normalised("scan_a"), b = normalised("scan_b"), c = normalised("scan_c"), d = normalised("scan_d");
  EXPECT_EQ(b.up, UpAxis::PlusZ);
  EXPECT_EQ(b.unit, LengthUnit::Millimetre);
  EXPECT_EQ(d.unit, LengthUnit::Centimetre);
  EXPECT_NEAR(c.yaw * kDegreePerRadian, -30.0, 0.1);
  for (const auto* r : {&a, &b, &c, &d}) {
    EXPECT_NEAR(r->up_score, 2.0, 0.15);
    EXPECT_LT(r->mirror_residual, 3e-3);
  }
}

TEST(NormaliseBody, TakesUnitAndAxisFromTheUser) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = load_shared_body("mh_child_8y").surface;
  NormaliseBodyOptions given;
  given.unit = LengthUnit::Millimetre;
  given.up = UpAxis::MinusX;
  const NormaliseBodyResult result =
      normalise_body(moved(body, turn_upright(UpAxis::MinusX).transpose(), 1000.0, Vec3::Zero()), given);
  EXPECT_LT(largest_move(result.surface, body), kSameBody);
  NormaliseBodyOptions wrong_unit, wrong_up;
  wrong_unit.unit = LengthUnit::Centimetre;
  wrong_up.up = UpAxis::MinusY;
  EXPECT_THROW(normalise_body(body, wrong_unit), Error);
  EXPECT_THROW(normalise_body(body, wrong_up), Error);
}

TEST(NormaliseBody, ReadsAnAdultInInches) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = load_shared_body("mh_female_average").surface;
  const NormaliseBodyResult result = normalise_body(moved(body, Mat3::Identity(), 1.0 / kMetrePerInch, Vec3::Zero()));
  EXPECT_EQ(result.unit, LengthUnit::Inch);  // 62.6 could be centimetres as well, which would be a toddler
  EXPECT_FALSE(result.warnings.empty());
}

TEST(NormaliseBody, RefusesWhatIsNoPerson) {
  std::string message;
  EXPECT_EQ(refused_with(box(Vec3(1.7, 1.7, 1.7)), &message), ErrorCode::BodyNotRecognised);
  EXPECT_NE(message.find("score"), std::string::npos);
  EXPECT_EQ(refused_with(TriangleMesh{Points3(0, 3), Triangles(0, 3)}), ErrorCode::BodyUnusable);
}

TEST(NormaliseBody, RefusesASixCentimetreBody) {
  TOILE_REQUIRE_SHARED_DATA();
  std::string message;
  const TriangleMesh body = load_shared_body("mh_female_average").surface;
  EXPECT_EQ(refused_with(moved(body, Mat3::Identity(), 0.04, Vec3::Zero()), &message), ErrorCode::BodyUnusable);
  EXPECT_NE(message.find("unit"), std::string::npos);
}

TEST(NormaliseBody, TakesHeightsFromHalfAMetreToTwoAndAHalf) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = load_shared_body("mh_female_average").surface;
  const double height = body.vertices.col(1).maxCoeff() - body.vertices.col(1).minCoeff();
  NormaliseBodyOptions metres;
  metres.unit = LengthUnit::Metre;
  for (const double wanted : {0.51, 2.49})
    EXPECT_NO_THROW(normalise_body(moved(body, Mat3::Identity(), wanted / height, Vec3::Zero()), metres)) << wanted;
  for (const double wanted : {0.49, 2.51})
    EXPECT_THROW(normalise_body(moved(body, Mat3::Identity(), wanted / height, Vec3::Zero()), metres), Error) << wanted;
}

TEST(NormaliseBody, RefusesTwoPeople) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh a = load_shared_body("mh_female_average").surface;
  const TriangleMesh b = moved(load_shared_body("mh_male_average").surface, Mat3::Identity(), 1.0, Vec3(1.2, 0, 0));
  TriangleMesh two;
  two.vertices.resize(a.vertex_count() + b.vertex_count(), 3);
  two.vertices << a.vertices, b.vertices;
  two.triangles.resize(a.triangle_count() + b.triangle_count(), 3);
  two.triangles << a.triangles, (b.triangles.array() + a.vertex_count()).matrix();
  std::string message;
  EXPECT_EQ(refused_with(two, &message), ErrorCode::BodyNotRecognised);
  EXPECT_NE(message.find("one person"), std::string::npos);
}

TEST(NormaliseBody, TakesAFormAsItStands) {
  NormaliseBodyOptions form;
  form.kind = BodyKind::Form;
  const NormaliseBodyResult result = normalise_body(box(Vec3(0.4, 0.8, 0.3), Vec3(1, 2, 3)), form);
  EXPECT_EQ(result.surface.vertices.col(1).minCoeff(), 0.0);
  EXPECT_EQ(result.surface.vertices.col(0).minCoeff(), 1.0);
  EXPECT_EQ(result.up, UpAxis::PlusY);
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/normalise_body.h"

#include <algorithm>

#include "engine/bodies/body_symmetry.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/geometry/components.h"
#include "engine/geometry/mesh_slicer.h"

namespace toile {
namespace {

// Fractions of the height unless a unit is named. Limits: shared design page "registration", section 4.
constexpr double kStrayArea = 0.02;                               // of the largest component: smaller ones are specks
constexpr double kSecondBodyArea = 0.2;                           // of all area: as large as that is another body
constexpr double kUprightRefused = 1.6;                           // persons 1.89-2, leaning 1.67, headless 1.5, cube 1
constexpr double kFrontRefused = 0.03, kFrontWarned = 0.06;       // persons .075-.098
constexpr double kMirrorRefused = 0.015;                          // m; persons 0-2 mm, two people 45 mm
constexpr double kFloorQuantile = 0.0005;                         // of the vertices: a few may stick out below
constexpr double kHeightMin = 0.5, kHeightMax = 2.5;              // m, accepted
constexpr double kHeightLikelyMin = 1.0, kHeightLikelyMax = 2.2;  // m, preferred where several units fit
constexpr double kFormHeightMin = 0.1;                            // m: a form may be a torso
// A frame that is within these of the found one was meant: it is kept.
constexpr double kYawKept = 1.0 * kRadianPerDegree;
constexpr double kFloorKept = 0.010, kMiddleKept = 0.010, kDepthKept = 0.150;  // m
// A moved body stands on this lattice, m: turning it in its file leaves rounding of 1e-15 m, which the drape's folds
// would amplify to millimetres. With the lattice the same body gives the same bytes however it stood.
constexpr double kLattice = 1.0 / (1 << 20);

[[noreturn]] void refuse(std::string message) {
  throw Error(ErrorCode::BodyNotRecognised, "body", std::move(message));
}

Mat4 affine(const Mat3& linear, const Vec3& shift = Vec3::Zero()) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = linear;
  m.topRightCorner<3, 1>() = shift;
  return m;
}

Points3 snapped(const Points3& points) {
  return (points / kLattice).array().round() * kLattice;
}

Points3 moved(const Points3& points, const Mat4& m) {
  return (points * m.topLeftCorner<3, 3>().transpose()).rowwise() + m.topRightCorner<3, 1>().transpose();
}

// The body without specks, for measuring only.
TriangleMesh main_part(const TriangleMesh& mesh) {
  const MeshComponents components = find_components(mesh);
  std::vector<bool> keep(components.of_triangle.size());
  for (std::size_t f = 0; f < keep.size(); ++f)
    keep[f] = components.area[static_cast<std::size_t>(components.of_triangle[f])] >= kStrayArea * components.area[0];
  return extract_triangles(mesh, keep);
}

void refuse_several_bodies(const TriangleMesh& mesh) {
  const MeshComponents components = find_components(mesh);
  double total = 0.0;
  for (const double a : components.area) total += a;
  const auto large = std::count_if(components.area.begin(), components.area.end(),
                                   [&](double a) { return a > kSecondBodyArea * total; });
  if (large > 1)
    refuse(
        print_text("the file holds %d separate large surfaces where one body is expected: leave one person in it, or "
                   "join the parts of one body into one surface",
                   static_cast<int>(large)));
}

bool fits(double height, double low, double high) {
  return height >= low && height <= high;
}

LengthUnit find_unit(double file_height, double least, std::vector<std::string>& warnings) {
  constexpr LengthUnit units[] = {LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre, LengthUnit::Inch};
  std::vector<LengthUnit> likely, possible;
  for (const LengthUnit unit : units) {
    const double height = file_height * metres_per(unit);
    if (fits(height, kHeightLikelyMin, kHeightLikelyMax)) likely.push_back(unit);
    if (fits(height, least, kHeightMax)) possible.push_back(unit);
  }
  if (possible.empty())
    throw Error(ErrorCode::BodyUnusable, "body",
                print_text("the body is %.4g units tall, which is no person's height in m, cm, mm or inches "
                           "(%.1f-%.1f m): scale the file, or name its unit",
                           file_height, least, kHeightMax));
  const LengthUnit chosen = likely.empty() ? possible.front() : likely.front();
  if (possible.size() > 1)
    warnings.push_back(
        print_text("%.4g units tall: taken as %s, though another unit fits as well; name the unit if that is wrong",
                   file_height, unit_name(chosen).data()));
  return chosen;
}

void check_given_unit(double height, double least) {
  if (!fits(height, least, kHeightMax))
    throw Error(ErrorCode::BodyUnusable, "body",
                print_text("the body is %.3f m tall with the unit given (%.1f-%.1f m are accepted): name another "
                           "unit, or leave it to be found",
                           height, least, kHeightMax));
}

// (toe - heel) / height along +Z, and whether there are feet to tell by.
double front_of(const Points3& v, double floor, double height) {
  double toe = -1e300, back = 1e300, ankle = 0.0;
  int ankle_count = 0;
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    const double y = (v(i, 1) - floor) / height;
    if (y < 0.05) toe = std::max(toe, v(i, 2)), back = std::min(back, v(i, 2));
    if (y > 0.06 && y < 0.10) ankle += v(i, 2), ++ankle_count;
  }
  if (ankle_count == 0 || toe < back) return 0.0;
  ankle /= ankle_count;
  return ((toe - ankle) - (ankle - back)) / height;
}

double low_quantile(const Points3& v) {
  std::vector<double> y(static_cast<std::size_t>(v.rows()));
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = v(static_cast<Eigen::Index>(i), 1);
  const auto nth = y.begin() + static_cast<std::ptrdiff_t>(kFloorQuantile * static_cast<double>(y.size()));
  std::nth_element(y.begin(), nth, y.end());
  return *nth;
}

// z of the middle of the trunk between half and six tenths of the height.
double trunk_depth(const TriangleMesh& body, double floor, double height) {
  const MeshSlicer slicer(body);
  double sum = 0.0;
  int count = 0;
  for (const double level : {0.50, 0.525, 0.55, 0.575, 0.60})
    for (const SliceComponent& c : slicer.slice(floor + level * height, 0.004 * height)) {
      if (c.low.x() > 0.004 * height || c.high.x() < -0.004 * height) continue;
      sum += c.centre().y(), ++count;
      break;  // components come largest first
    }
  return count ? sum / count : 0.0;
}

class Normaliser {
 public:
  Normaliser(const TriangleMesh& in_file, const NormaliseBodyOptions& options) : in_file_(in_file), options_(options) {}

  NormaliseBodyResult run() {
    body_ = main_part(in_file_);
    if (options_.kind == BodyKind::Human) refuse_several_bodies(in_file_);
    stand_up();
    scale();
    if (options_.kind == BodyKind::Human) {
      face_front();
      settle();
    } else {
      apply(affine(Mat3::Identity(), Vec3(0, -body_.vertices.col(1).minCoeff(), 0)));
    }
    result_.surface = in_file_;
    if (!result_.kept_coordinates)
      result_.surface.vertices = snapped(moved(in_file_.vertices, result_.normalised_from_file));
    return std::move(result_);
  }

 private:
  void apply(const Mat4& m) {
    body_.vertices = moved(body_.vertices, m);
    result_.normalised_from_file = m * result_.normalised_from_file;
  }

  void stand_up() {
    if (options_.kind == BodyKind::Form) {
      result_.up = options_.up.value_or(UpAxis::PlusY);
    } else {
      const Upright found =
          options_.up ? Upright{*options_.up, upright_score(body_, *options_.up)} : find_upright(body_);
      result_.up = found.up, result_.up_score = found.score;
      if (found.score < kUprightRefused)
        refuse(
            print_text("this does not stand like a person: slices show two legs below and one head above with a score "
                       "of %.2f along %s (persons reach 1.9). One upright person in A- or T-pose with legs apart is "
                       "needed; name the up axis if it was mistaken",
                       found.score, up_name(found.up).data()));
    }
    apply(affine(turn_upright(result_.up)));
  }

  void scale() {
    const double height = body_.vertices.col(1).maxCoeff() - body_.vertices.col(1).minCoeff();
    const double least = options_.kind == BodyKind::Form ? kFormHeightMin : kHeightMin;
    if (options_.unit) check_given_unit(height * metres_per(*options_.unit), least);
    result_.unit = options_.unit ? *options_.unit : find_unit(height, least, result_.warnings);
    apply(affine(Mat3::Identity() * metres_per(result_.unit)));
  }

  void face_front() {
    const BodySymmetry symmetry = find_symmetry(body_);
    result_.yaw = symmetry.yaw, result_.mirror_residual = symmetry.residual;
    if (symmetry.residual > kMirrorRefused)
      refuse(
          print_text("the left half differs from the right by %.0f mm (up to %.0f mm are accepted): one person in a "
                     "symmetric A- or T-pose is needed",
                     symmetry.residual * kMmPerMetre, kMirrorRefused * kMmPerMetre));
    offset_ = symmetry.offset;
    if (symmetry.lean != 0.0) straighten(symmetry);
    floor_ = low_quantile(body_.vertices);
    height_ = body_.vertices.col(1).maxCoeff() - floor_;
    const auto turn = [&] { return Eigen::AngleAxisd(result_.yaw, Vec3::UnitY()).toRotationMatrix(); };
    result_.front = front_of(body_.vertices * turn().transpose(), floor_, height_);
    if (result_.front < 0) {
      result_.yaw += std::numbers::pi, offset_ = -offset_;
      result_.front = front_of(body_.vertices * turn().transpose(), floor_, height_);
    }
    result_.yaw = std::remainder(result_.yaw, 2 * std::numbers::pi);
    if (result_.front < kFrontRefused)
      refuse(
          print_text("front and back cannot be told apart: toes reach %.3f of the height further from the ankles than "
                     "heels (persons .08): whole feet are needed",
                     result_.front));
    if (result_.front < kFrontWarned)
      result_.warnings.push_back(
          print_text("the feet are unusual (toes minus heels %.3f of the height, persons .08): "
                     "check that the front is right",
                     result_.front));
  }

  // Turns the mid-plane upright, about the axis that lies in it and in the ground.
  void straighten(const BodySymmetry& symmetry) {
    const Vec3 axis = Eigen::AngleAxisd(-symmetry.yaw, Vec3::UnitY()) * Vec3::UnitZ();
    apply(affine(Eigen::AngleAxisd(-symmetry.lean, axis).toRotationMatrix()));
    result_.warnings.push_back(print_text("the body leant to a side by %.1f degrees and was straightened",
                                          std::abs(symmetry.lean) / kRadianPerDegree));
  }

  // Turn and shift, leaving alone what is already right.
  void settle() {
    const bool turned = std::abs(result_.yaw) >= kYawKept;
    if (turned) apply(affine(Eigen::AngleAxisd(result_.yaw, Vec3::UnitY()).toRotationMatrix()));
    Vec3 shift(-offset_, -floor_, 0.0);
    if (std::abs(shift.x()) < kMiddleKept) shift.x() = 0.0;
    if (std::abs(shift.y()) < kFloorKept) shift.y() = 0.0;
    apply(affine(Mat3::Identity(), shift));
    const double depth = trunk_depth(body_, floor_ + shift.y(), height_);
    const bool deep = std::abs(depth) >= kDepthKept;
    if (deep) apply(affine(Mat3::Identity(), Vec3(0, 0, -depth)));
    result_.kept_coordinates = result_.normalised_from_file == Mat4::Identity();
  }

  const TriangleMesh& in_file_;
  const NormaliseBodyOptions& options_;
  NormaliseBodyResult result_;
  TriangleMesh body_;  // without specks, in the frame reached so far
  double offset_ = 0.0, floor_ = 0.0, height_ = 0.0;
};

}  // namespace

double metres_per(LengthUnit unit) {
  constexpr double metres[] = {1.0, kMetrePerCm, kMetrePerMm, kMetrePerInch};
  return metres[static_cast<int>(unit)];
}

std::string_view unit_name(LengthUnit unit) {
  constexpr std::string_view names[] = {"m", "cm", "mm", "in"};
  return names[static_cast<int>(unit)];
}

NormaliseBodyResult normalise_body(const TriangleMesh& in_file, const NormaliseBodyOptions& options) {
  if (in_file.triangle_count() == 0)
    throw Error(ErrorCode::BodyUnusable, "body", "the file holds no triangles: a surface of triangles is needed");
  return Normaliser(in_file, options).run();
}

}  // namespace toile

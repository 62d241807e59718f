// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/find_skeleton.h"

#include <algorithm>

#include "engine/bodies/body_slices.h"
#include "engine/bodies/find_arm.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

// Fractions of the height. Shared design page "registration", sections 1.2 (levels) and 4 (limits).
constexpr double kStep = 0.005, kFineStep = 0.0005;
constexpr double kClosedNear = 0.0055;  // further from the thin level it is noise, a patch, or thighs that touch
constexpr double kCrotchTop = 0.56, kCrotchLow = 0.36, kCrotchAssumed = 0.46, kPelvisLow = 0.52;
constexpr double kThicknessShare = 0.42;  // of the thickest level of the pelvis: thinner is the gap between the thighs
constexpr double kArmpitLow = 0.50, kArmpitHigh = 0.88, kArmpitAssumed = 0.745;
constexpr double kUnderArmpit = 0.015;  // the chest is taken where no arm has grown onto the trunk yet
constexpr double kNeckHigh = 0.93;
constexpr double kToeHigh = 0.035;

struct Range {
  double low, high;
  bool holds(double v) const { return v >= low && v <= high; }
};
constexpr Range kCrotchUsual{0.40, 0.52}, kArmpitUsual{0.68, 0.80}, kNeckUsual{0.80, 0.895},
    kNeckGirthUsual{0.15, 0.35};
constexpr Range kArmUsual{0.33, 0.50};
constexpr double kArmsDiffer = 0.06;
constexpr int kTaubinSteps = 4;

[[noreturn]] void refuse(std::string message) {
  throw Error(ErrorCode::BodyNotRecognised, "body", std::move(message));
}

Vec3 box_centre(const std::vector<Vec2>& points, double y) {
  Vec2 low = points.front(), high = points.front();
  for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec2 c = 0.5 * (low + high);
  return {c.x(), y, c.y()};
}

class SkeletonFinder {
 public:
  explicit SkeletonFinder(const TriangleMesh& body) : body_(body), slices_(body), h_(slices_.height()) {}

  FindSkeletonResult run() {
    s_.height = h_;
    find_crotch();
    find_armpit();
    find_neck();
    s_.waist_y = 0.5 * (s_.crotch_y + s_.armpit_y);
    check_trunk();
    s_.pelvis = trunk_centre(s_.crotch_y + 0.06 * h_);
    s_.waist = trunk_centre(s_.waist_y);
    s_.chest = trunk_centre(s_.armpit_y - kUnderArmpit * h_);
    s_.neck = trunk_centre(s_.neck_y);
    for (const Side side : {Left, Right}) s_.legs[side] = find_leg(side);
    s_.arms = find_arms(without_noise(), h_, s_.armpit_y);
    check_arms();
    return std::move(result_);
  }

 private:
  void warn(std::string text) { result_.warnings.push_back(std::move(text)); }

  // Downward from the pelvis while the mid-plane is thick; one bad level (a fold, a hole) is jumped over.
  void find_crotch() {
    std::vector<double> y, t;
    for (int i = 0; kCrotchLow + i * kStep < kCrotchTop + 1e-9; ++i) {
      y.push_back((kCrotchLow + i * kStep) * h_);
      t.push_back(slices_.middle_thickness(y.back()));
    }
    double most = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (y[i] >= kPelvisLow * h_) most = std::max(most, t[i]);
    const double enough = kThicknessShare * most;
    std::size_t i = y.size() - 1;
    for (; i >= 3; --i) {
      if (t[i - 1] > enough) continue;
      if (t[i - 2] > enough && t[i - 3] > enough) continue;
      break;
    }
    const bool found = i >= 3 && most > 0.0 && t[i] > enough;
    if (found) {
      const double thin = y[i - 1] + (y[i] - y[i - 1]) * (enough - t[i - 1]) / (t[i] - t[i - 1]);
      s_.crotch_y = lowest_closed_level(thin).value_or(thin);
    } else {
      s_.crotch_y = kCrotchAssumed * h_;
      warn(print_text("the crotch was not found; assumed at %.2f of the height", kCrotchAssumed));
    }
  }

  // Lowest level near the thin one at which trunk, or thighs that press on each other right under it, close the
  // mid-plane; none where a hole or a fold leaves it open. Thighs that touch further down are not the trunk.
  std::optional<double> lowest_closed_level(double thin) const {
    const double low = thin - kClosedNear * h_, high = thin + kClosedNear * h_;
    if (slices_.middle_closed(low)) return std::nullopt;
    for (double y = low; y < high; y += kFineStep * h_)
      if (slices_.middle_closed(y)) return y;
    return std::nullopt;
  }

  void find_armpit() {
    double sum = 0.0;
    for (const Side side : {Left, Right}) {
      double y = kArmpitHigh;
      while (y > kArmpitLow && !slices_.arm_apart(y * h_, side)) y -= kStep;
      double fine = y + kStep;
      while (fine > y && !slices_.arm_apart(fine * h_, side)) fine -= kFineStep;
      sum += fine;
    }
    s_.armpit_y = 0.5 * sum * h_;
    if (s_.armpit_y < 0.66 * h_ || s_.armpit_y > 0.84 * h_) {
      warn(print_text("the armpits were not found (%.2f of the height); assumed at %.3f", s_.armpit_y / h_,
                      kArmpitAssumed));
      s_.armpit_y = kArmpitAssumed * h_;
    }
  }

  void find_neck() {
    result_.neck_girth = 1e300;
    for (double y = s_.armpit_y + 0.04 * h_; y <= kNeckHigh * h_; y += kStep * h_) {
      const double girth = slices_.middle_girth(y);
      if (girth > 0.0 && girth < result_.neck_girth) result_.neck_girth = girth, s_.neck_y = y;
    }
  }

  void check_trunk() {
    const auto demand = [&](Range usual, double value, const char* what, const char* mend) {
      if (!usual.holds(value / h_))
        refuse(print_text("%s is at %.3f of the height, a person's at %.2f-%.3f: %s", what, value / h_, usual.low,
                          usual.high, mend));
    };
    demand(kCrotchUsual, s_.crotch_y, "the crotch",
           "the whole person from soles to crown is needed, standing, legs apart");
    demand(kArmpitUsual, s_.armpit_y, "the armpit", "the whole person is needed, arms away from the trunk");
    demand(kNeckUsual, s_.neck_y, "the neck", "the head must be in the scan");
    if (!kNeckGirthUsual.holds(result_.neck_girth / h_))
      refuse(print_text(
          "the neck measures %.3f of the height round, a person's %.2f-%.2f: the head must be in the scan, and hair up",
          result_.neck_girth / h_, kNeckGirthUsual.low, kNeckGirthUsual.high));
  }

  void check_arms() {
    for (const Side side : {Left, Right}) {
      const double l = s_.arms[side].length / h_;
      if (!kArmUsual.holds(l))
        refuse(
            print_text("the %s arm is %.2f of the height long from finger tip to armpit, a person's %.2f-%.2f: both "
                       "whole arms are "
                       "needed, free of the trunk",
                       side == Left ? "left" : "right", l, kArmUsual.low, kArmUsual.high));
    }
    const double apart = std::abs(s_.arms[Left].length - s_.arms[Right].length) / h_;
    if (apart > kArmsDiffer)
      refuse(print_text(
          "one arm is %.2f of the height longer than the other: both whole arms are needed, free of the trunk", apart));
  }

  // Noise lengthens ways along edges, and most of all in a hand's fine triangles: joints at shares of such a way would
  // come to lie too near to the finger tips.
  TriangleMesh without_noise() const {
    if (surface_roughness(body_) <= kRoughScan) return body_;
    return {taubin_smooth(body_, kTaubinSteps), body_.triangles};
  }

  Vec3 trunk_centre(double y) const {
    const auto piece = slices_.middle(y);
    if (!piece) refuse(print_text("there is no trunk at %.2f of the height: the body must be whole", y / h_));
    const Vec2 c = piece->centre();
    return {c.x(), y, c.y()};
  }

  Vec3 leg_centre(double y, Side side) const {
    const auto points = slices_.leg(y, side);
    if (points.empty())
      refuse(print_text("there is no %s leg at %.2f of the height: both whole legs are needed",
                        side == Left ? "left" : "right", y / h_));
    return box_centre(points, y);
  }

  Skeleton::Leg find_leg(Side side) const {
    const double c = s_.crotch_y;
    Skeleton::Leg leg;
    leg.ankle = leg_centre(0.10 * c, side);
    leg.knee = leg_centre(0.56 * c, side);
    const Vec3 thigh = leg_centre(0.90 * c, side);
    leg.hip = thigh + (thigh - leg.knee) * ((c + 0.05 * h_ - thigh.y()) / (thigh.y() - leg.knee.y()));
    leg.hip.x() = thigh.x() + 0.3 * (leg.hip.x() - thigh.x());  // the thigh leans less above than below
    leg.toe = leg.ankle;
    double front = -1e300;
    for (Eigen::Index v = 0; v < body_.vertices.rows(); ++v) {
      const auto p = body_.vertices.row(v);
      if (p.y() > kToeHigh * h_ || (p.x() > 0) != (side == Left) || p.z() <= front) continue;
      front = p.z(), leg.toe = p;
    }
    return leg;
  }

  const TriangleMesh& body_;
  BodySlices slices_;
  double h_;
  FindSkeletonResult result_;
  Skeleton& s_ = result_.skeleton;
};

}  // namespace

FindSkeletonResult find_skeleton(const TriangleMesh& body) {
  return SkeletonFinder(body).run();
}

}  // namespace toile

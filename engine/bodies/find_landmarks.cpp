// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/find_landmarks.h"

#include <algorithm>
#include <cmath>

#include "engine/bodies/find_shoulder.h"
#include "engine/bodies/measure_arm.h"

namespace toile {
namespace {

// Where the points lie, read off the 15 bodies of shared/data (medians).
// Fractions of the height:
constexpr double kBustDeep = 0.085, kBustHigh = 0.012;  // bust points are sought this far under the armpit
constexpr double kBustNear = 0.025, kBustFar = 0.09;    // distance from the mid-plane
constexpr double kBustSide = 0.05;                      // and where there is no foremost point
constexpr double kBustCrest = 0.0015;                   // the profile must fall back by this under a crest
constexpr double kBustCap = 0.0001;                     // what lies within this of the crest counts as crest,
constexpr double kSureCap = 0.0010;                     // and this besides where it surely is one
constexpr double kBustStep = 0.001;                     // m
// Where a chest has no foremost point, two estimates of its bust level share: under the armpit by a part of the way to
// the neck, and under the place where arm and trunk would meet if the gap between them went on closing as it does
// between two widths. Armpits are missing in scans, and gaps differ with build: neither alone is good enough.
constexpr double kFlatUnderArmpit = -0.225;
constexpr double kFlatUnderArms = 0.0228, kGapNarrow = 0.03, kGapWide = 0.06;
// Fractions of the way from crotch to armpit:
constexpr double kWaist = 0.60, kHip = 0.10;
// Fractions of the way from armpit to the least neck:
constexpr double kNeckBack = 0.88, kNeckFront = 0.52;
// Fractions of the crotch height:
constexpr double kKnee = 0.61, kAnkle = 0.095;

Vec3 at_level(const Vec2& p, double y) {
  return {p.x(), y, p.y()};
}

// The point of `points` furthest along `direction` (x, z).
Vec2 furthest(const std::vector<Vec2>& points, const Vec2& direction) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vec2& a, const Vec2& b) { return a.dot(direction) < b.dot(direction); });
}

class Finder {
 public:
  Finder(const TriangleMesh& body, const Skeleton& skeleton, const BodySlices& slices, const MeasuringLevels& levels)
      : body_(body), s_(skeleton), slices_(slices), levels_(levels), h_(slices.height()) {}

  Landmarks run() {
    add_bust_points();
    for (const Side side : {Left, Right}) add_limb_points(side);
    const double trunk = levels_.armpit - levels_.crotch, neck = s_.neck_y - s_.armpit_y;
    add_ring("waist", levels_.crotch + kWaist * trunk);
    add_middle("neck_back", s_.armpit_y + kNeckBack * neck, -1.0);
    add_middle("neck_front", s_.armpit_y + kNeckFront * neck, 1.0);
    const double crotch_z =
        0.5 * (middle_point(levels_.crotch + 0.002, 1.0).z() + middle_point(levels_.crotch + 0.002, -1.0).z());
    found_["crotch"] = Vec3(0.0, levels_.crotch, crotch_z);
    Eigen::Index top = 0;
    body_.vertices.col(1).maxCoeff(&top);
    found_["head_top"] = body_.vertices.row(top);
    return std::move(found_);
  }

 private:
  void add(const char* name, Side side, const Vec3& p) { found_[std::string(name) + (side == Left ? "_l" : "_r")] = p; }

  void add_limb_points(Side side) {
    const Vec2 out(side == Left ? 1.0 : -1.0, 0.0), front(0.0, 1.0);
    const Skeleton::Arm& arm = s_.arms[side];
    add("shoulder", side, find_shoulder_point(body_, s_, side));
    const Vec3 along = (arm.shoulder - arm.elbow).normalized();
    add("elbow", side, skin(arm.elbow, across(Vec3(0.3 * out.x(), -0.2, -1.0), along)));
    const Vec3 wrist = find_wrist(body_, arm, h_);
    add("wrist", side, skin(wrist, across(Vec3(0.5 * out.x(), 0.5, 1.0), (arm.elbow - arm.wrist).normalized())));
    const double trunk = levels_.armpit - levels_.crotch;
    add("hip", side, trunk_side(levels_.crotch + kHip * trunk, out));
    add("knee", side, leg_point(kKnee * levels_.crotch, side, front));
    add("ankle", side, leg_point(kAnkle * levels_.crotch, side, out));
  }

  static Vec3 across(const Vec3& direction, const Vec3& axis) {
    return (direction - axis * axis.dot(direction)).normalized();
  }

  struct Crest {
    double y = 0.0, share = 0.0;  // share: how surely it is one, 0..1
  };

  // Where the front profile of both breasts together has its first crest under the armpit: noise makes crests on one
  // side alone. A chest that only runs on into the belly has none; one that hardly falls back has half of one, lest a
  // chest and its scan be measured at two places.
  Crest bust_crest() const {
    const double sure = 1.5 * kBustCrest * h_;
    std::vector<Vec2> profile;  // y, z
    double foremost = -1e300, fall = 0.0;
    for (double y = levels_.armpit - kBustHigh * h_; y > levels_.armpit - kBustDeep * h_ && fall < sure;
         y -= kBustStep) {
      const std::optional<Vec3> left = chest_front(y, 1.0), right = chest_front(y, -1.0);
      if (!left || !right) continue;
      const double z = 0.5 * (left->z() + right->z());
      if (z > foremost && fall > kBustCrest * h_) break;
      profile.emplace_back(y, z);
      if (z > foremost) foremost = z, fall = 0.0;
      fall = std::max(fall, foremost - z);
    }
    if (profile.empty()) return {};
    const double share = std::clamp(fall / (kBustCrest * h_) - 0.5, 0.0, 1.0);
    return {middle_of_crest(profile, foremost - (kBustCap + kSureCap * std::pow(share, 3)) * h_), share};
  }

  // A blunt crest is uncertain by more than its cap is high: the middle of the cap is surer than its foremost point. A
  // breast's cap is taken so high that a nipple, which models have and maps and scans round off, does not decide; a
  // chest that hardly falls back has no such cap.
  static double middle_of_crest(const std::vector<Vec2>& profile, double over) {
    double sum = 0.0, weight = 0.0;
    for (const Vec2& p : profile) {
      const double w = std::max(0.0, p.y() - over);
      sum += w * p.x(), weight += w;
    }
    return sum / weight;
  }

  void add_bust_points() {
    const Crest crest = bust_crest();
    const double y = crest.share * crest.y + (1.0 - crest.share) * flat_bust_level();
    for (const Side side : {Left, Right}) {
      const double sign = side == Left ? 1.0 : -1.0;
      const std::optional<Vec3> front = crest.share > 0.5 ? chest_front(y, sign) : std::nullopt;
      add("bust", side, front ? *front : flat_bust(y, sign));
    }
  }

  // The armpit's where arms hang or stand off so that the gap tells nothing.
  double arms_meet() const {
    return toile::arms_meet(slices_, levels_.armpit, kGapNarrow, kGapWide).value_or(levels_.armpit);
  }

  double flat_bust_level() const {
    const double by_armpit = levels_.armpit + kFlatUnderArmpit * (s_.neck_y - levels_.armpit);
    return 0.5 * (by_armpit + arms_meet() - kFlatUnderArms * h_);
  }

  Vec3 flat_bust(double y, double sign) const {
    const double x = sign * kBustSide * h_;
    const auto trunk = slices_.middle(y);
    const auto points = trunk ? trunk->points(x - 0.01 * h_, x + 0.01 * h_) : std::vector<Vec2>{};
    return points.empty() ? Vec3(x, y, 0) : at_level(furthest(points, Vec2(0, 1)), y);
  }

  // The foremost point of one side of the chest at a level.
  std::optional<Vec3> chest_front(double y, double sign) const {
    const auto trunk = slices_.middle(y);
    if (!trunk) return std::nullopt;
    const double a = sign * kBustNear * h_, b = sign * kBustFar * h_;
    const auto points = trunk->points(std::min(a, b), std::max(a, b));
    if (points.empty()) return std::nullopt;
    return at_level(furthest(points, Vec2(0, 1)), y);
  }

  Vec3 middle_point(double y, double sign) const {
    const auto trunk = slices_.middle(y);
    const auto points = trunk ? trunk->points(-0.008 * h_, 0.008 * h_) : std::vector<Vec2>{};
    return points.empty() ? Vec3(0, y, 0) : at_level({0.0, furthest(points, Vec2(0, sign)).y()}, y);
  }
  void add_middle(const char* name, double y, double sign) { found_[name] = middle_point(y, sign); }

  Vec3 trunk_side(double y, const Vec2& direction) const {
    const auto trunk = slices_.middle(y);
    return trunk ? at_level(furthest(trunk->points(), direction), y) : Vec3(0, y, 0);
  }

  void add_ring(const std::string& name, double y) {
    found_[name + "_l"] = trunk_side(y, Vec2(1, 0));
    found_[name + "_r"] = trunk_side(y, Vec2(-1, 0));
    add_middle((name + "_front").c_str(), y, 1.0);
    add_middle((name + "_back").c_str(), y, -1.0);
  }

  Vec3 leg_point(double y, Side side, const Vec2& direction) const {
    const auto points = slices_.leg(y, side);
    return points.empty() ? Vec3(0, y, 0) : at_level(furthest(points, direction), y);
  }

  // Where the ray from inside the body first leaves it (the joint itself if it never does).
  Vec3 skin(const Vec3& from, const Vec3& direction) const {
    double nearest = 0.2 * h_;
    bool hit = false;
    for (int f = 0; f < body_.triangle_count(); ++f) {
      const Vec3 a = body_.vertices.row(body_.triangles(f, 0));
      const Vec3 e1 = body_.vertices.row(body_.triangles(f, 1)).transpose() - a;
      const Vec3 e2 = body_.vertices.row(body_.triangles(f, 2)).transpose() - a;
      const Vec3 p = direction.cross(e2);
      const double det = e1.dot(p);
      if (std::abs(det) < 1e-14) continue;
      const Vec3 s = from - a, q = s.cross(e1);
      const double u = s.dot(p) / det, v = direction.dot(q) / det, t = e2.dot(q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) nearest = t, hit = true;
    }
    return hit ? Vec3(from + nearest * direction) : from;
  }

  const TriangleMesh& body_;
  const Skeleton& s_;
  const BodySlices& slices_;
  const MeasuringLevels& levels_;
  double h_;
  Landmarks found_;
};

}  // namespace

Landmarks find_landmarks(const TriangleMesh& body, const Skeleton& skeleton, const BodySlices& slices,
                         const MeasuringLevels& levels) {
  return Finder(body, skeleton, slices, levels).run();
}

}  // namespace toile

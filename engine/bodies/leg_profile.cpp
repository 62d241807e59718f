// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/leg_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

constexpr int kSectors = 12;
constexpr int kLevels = 116;  // one per hundredth of the crotch height
constexpr double kStep = (kLegHigh - kLegLow) / (kLevels - 1);
constexpr double kLevelReach = 0.006, kLevelCut = 0.018;  // of the height: what counts to a level
constexpr double kSectorReach = 0.35, kSectorCut = 1.05;  // rad
constexpr double kLegReach = 0.11;                        // of the height: further from the leg is a hand
constexpr double kLegTop = 1.23;                          // of the crotch height
constexpr double kEmpty = 1e-6;                           // of the height, squared: less skin is a hole

// The match: how much lean and radius count, and how dear it is to stretch one leg against the other.
constexpr double kLeanWeight = 2.0, kRadiusWeight = 1.0, kStretchWeight = 3.0;
constexpr int kKnot = 13;                          // levels between the places where the stretch may change
constexpr int kFiner = 8;                          // levels of the target to one of the reference
constexpr double kMostOff = 0.14, kEndOff = 0.05;  // of the crotch height
constexpr double kLeastStretch = 0.5, kMostStretch = 1.8;
constexpr int kSmoothings = 6;
constexpr double kKept = 1.35;  // of the crotch height: the waist, which is not slid
// Levels that are matched: up to the hips, the target being looked at further up. A scan's crotch is a hole or a web:
// what is told there is left alone.
constexpr int kMatched = 105, kMatchedOfScan = 94;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

double bell(double off, double reach) {
  return std::exp(-(off / reach) * (off / reach));
}

struct Skin {
  Vec3 middle, normal;  // of a triangle, mirrored to the left
  double area;
};

Vec3 to_left(Vec3 p, Side side) {
  if (side == Right) p.x() = -p.x();
  return p;
}

// Skin of one leg, seen as a left one, and the axis it goes up by.
struct Limb {
  std::vector<Skin> skin;
  Vec3 ankle, axis;

  Limb(const TriangleMesh& body, const Skeleton& skeleton, Side side) {
    const Skeleton::Leg& leg = skeleton.legs[side];
    ankle = to_left(leg.ankle, side);
    axis = (to_left(leg.hip, side) - ankle).normalized();
    for (Eigen::Index f = 0; f < body.triangles.rows(); ++f) {
      const auto t = body.triangles.row(f);
      const Vec3 a = body.vertices.row(t[0]), b = body.vertices.row(t[1]), c = body.vertices.row(t[2]);
      const Vec3 middle = to_left((a + b + c) / 3.0, side);
      if (middle.x() <= 0.0 || middle.y() > kLegTop * skeleton.crotch_y) continue;
      const Vec3 off = middle - ankle;
      if ((off - off.dot(axis) * axis).norm() > kLegReach * skeleton.height) continue;
      const Vec3 cross = to_left((b - a).cross(c - a), side);
      skin.push_back({middle, cross.normalized(), 0.5 * cross.norm()});
    }
  }
};

struct Sums {
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(kLevels, kSectors), lean = weight, radius = weight;
};

class LegSampler {
 public:
  explicit LegSampler(const Skeleton& skeleton) : crotch_(skeleton.crotch_y), height_(skeleton.height) {}

  void add(const Limb& limb, Sums& sums) const {
    const std::vector<Vec2> middles = find_middles(limb);
    for (const Skin& s : limb.skin)
      for_levels(s, [&](int level, double weight) {
        const Vec2 off = Vec2(s.middle.x(), s.middle.z()) - middles[at(level)];
        add_to_sectors(level, off, weight, s.normal.dot(limb.axis), sums);
      });
  }

 private:
  // Every level the piece of skin counts to, with its weight there.
  template <class Visit>
  void for_levels(const Skin& s, const Visit& visit) const {
    const double reach = kLevelCut * height_ / crotch_ / kStep, own = (s.middle.y() / crotch_ - kLegLow) / kStep;
    const int first = std::max(0, static_cast<int>(std::ceil(own - reach))),
              last = std::min(kLevels - 1, static_cast<int>(std::floor(own + reach)));
    for (int i = first; i <= last; ++i) visit(i, s.area * bell((own - i) * kStep * crotch_, kLevelReach * height_));
  }

  std::vector<Vec2> find_middles(const Limb& limb) const {
    std::vector<Vec2> middles(kLevels, Vec2::Zero());
    std::vector<double> weights(kLevels, 0.0);
    for (const Skin& s : limb.skin)
      for_levels(s, [&](int level, double weight) {
        middles[at(level)] += weight * Vec2(s.middle.x(), s.middle.z());
        weights[at(level)] += weight;
      });
    for (int i = 0; i < kLevels; ++i)
      if (weights[at(i)] > 0.0) middles[at(i)] /= weights[at(i)];
    return middles;
  }

  static void add_to_sectors(int level, const Vec2& off, double weight, double lean, Sums& sums) {
    constexpr double kTurn = 2.0 * std::numbers::pi, kWidth = kTurn / kSectors;
    const double angle = std::atan2(off.y(), off.x()), radius = off.norm();
    const int first = static_cast<int>(std::ceil((angle - kSectorCut) / kWidth)),
              last = static_cast<int>(std::floor((angle + kSectorCut) / kWidth));
    for (int k = first; k <= last; ++k) {
      const double w = weight * bell(angle - k * kWidth, kSectorReach);
      const int sector = (k + kSectors) % kSectors;
      sums.weight(level, sector) += w;
      sums.lean(level, sector) += w * lean;
      sums.radius(level, sector) += w * radius;
    }
  }

  double crotch_, height_;
};

double mean_of_known(const Eigen::MatrixXd& values) {
  double sum = 0.0;
  int count = 0;
  for (const double v : values.reshaped())
    if (!std::isnan(v)) sum += v, ++count;
  return count > 0 ? sum / count : 0.0;
}

double variance(const Eigen::MatrixXd& values) {
  const double mean = mean_of_known(values);
  return std::max(1e-12, mean_of_known((values.array() - mean).square()));
}

void smooth(std::vector<double>& levels) {
  for (int k = 0; k < kSmoothings; ++k) {
    const std::vector<double> old = levels;
    for (std::size_t i = 1; i + 1 < levels.size(); ++i)
      levels[i] = 0.25 * old[i - 1] + 0.5 * old[i] + 0.25 * old[i + 1];
  }
}

constexpr int kFineLevels = (kLevels - 1) * kFiner + 1;
constexpr double kNever = 1e9;

// By how much every level of the reference (rows) differs from every finer level of the target.
Eigen::MatrixXd level_costs(const LegProfile& reference, const LegProfile& target) {
  const double lean_weight = kLeanWeight / variance(reference.lean),
               radius_weight = kRadiusWeight / variance(reference.radius);
  Eigen::MatrixXd costs = Eigen::MatrixXd::Zero(kLevels, kFineLevels);
  for (int j = 0; j < kFineLevels; ++j) {
    const int below = std::min(j / kFiner, kLevels - 2);
    const double t = static_cast<double>(j) / kFiner - below;
    const Eigen::RowVectorXd lean = (1.0 - t) * target.lean.row(below) + t * target.lean.row(below + 1),
                             radius = (1.0 - t) * target.radius.row(below) + t * target.radius.row(below + 1);
    for (int i = 0; i < kLevels; ++i) {
      double sum = 0.0;
      int count = 0;
      for (int s = 0; s < kSectors; ++s) {
        const double by_lean = reference.lean(i, s) - lean[s], by_radius = reference.radius(i, s) - radius[s];
        if (std::isnan(by_lean)) continue;
        sum += lean_weight * by_lean * by_lean + radius_weight * by_radius * by_radius, ++count;
      }
      costs(i, j) = count > 0 ? sum / count : 0.0;
    }
  }
  return costs;
}

bool shows_crotch(const LegProfile& target) {
  return !target.lean.row(kLevels - 1).array().isNaN().all();
}

// Dynamic programming over where the knots of a piecewise even stretch lie on the target.
class KnotMatch {
 public:
  KnotMatch(const LegProfile& reference, const LegProfile& target)
      : costs_(level_costs(reference, target)), matched_(shows_crotch(target) ? kMatched : kMatchedOfScan) {
    for (int level = 0; level + kKnot / 2 < matched_; level += kKnot) knots_.push_back(level);
    knots_.push_back(matched_ - 1);
  }

  // Target level of every matched level of the reference, in levels of the reference.
  std::vector<double> run() {
    std::vector<double> best(kFineLevels, kNever);
    best.front() = 0.0;
    std::vector<std::vector<int>> from;
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k) from.push_back(advance(knots_[k], knots_[k + 1], best));
    int end = static_cast<int>(std::min_element(best.begin(), best.end()) - best.begin());
    std::vector<double> match(at(matched_));
    match.back() = static_cast<double>(end) / kFiner;
    for (std::size_t k = from.size(); k-- > 0;) {
      const int begin = from[k][at(end)], levels = knots_[k + 1] - knots_[k];
      for (int i = 0; i < levels; ++i)
        match[at(knots_[k] + i)] = (begin + static_cast<double>((end - begin) * i) / levels) / kFiner;
      end = begin;
    }
    return match;
  }

 private:
  static int fine(double share) { return static_cast<int>(share / kStep * kFiner); }

  // From the cheapest ways to one knot those to the next; returns where each came from.
  std::vector<int> advance(int a, int b, std::vector<double>& best) const {
    const int levels = b - a, off = fine(kMostOff),
              end_off = b < knots_.back()      ? off
                        : matched_ == kMatched ? fine(kEndOff)
                                               : 0;
    std::vector<double> next(kFineLevels, kNever);
    std::vector<int> from(kFineLevels, 0);
    for (int end = std::max(0, b * kFiner - end_off); end <= std::min(kFineLevels - 1, b * kFiner + end_off); ++end) {
      const int low = end - static_cast<int>(kMostStretch * levels * kFiner),
                high = end - static_cast<int>(kLeastStretch * levels * kFiner);
      for (int begin = std::max({0, a * kFiner - off, low}); begin <= std::min(a * kFiner + off, high); ++begin) {
        if (best[at(begin)] >= next[at(end)]) continue;
        const double sum = best[at(begin)] + segment_cost(a, b, begin, end);
        if (sum < next[at(end)]) next[at(end)] = sum, from[at(end)] = begin;
      }
    }
    best = std::move(next);
    return from;
  }

  double segment_cost(int a, int b, int begin, int end) const {
    const int levels = b - a;
    const double stretch = static_cast<double>(end - begin) / (levels * kFiner) - 1.0;
    double sum = kStretchWeight * levels * stretch * stretch;
    for (int i = 1; i <= levels; ++i) sum += costs_(a + i, begin + (2 * (end - begin) * i + levels) / (2 * levels));
    return sum;
  }

  Eigen::MatrixXd costs_;
  int matched_;
  std::vector<int> knots_;
};

}  // namespace

LegProfile find_leg_profile(const TriangleMesh& body, const Skeleton& skeleton) {
  Sums sums;
  const LegSampler sampler(skeleton);
  for (const Side side : {Left, Right}) sampler.add(Limb(body, skeleton, side), sums);
  const double least = kEmpty * skeleton.height * skeleton.height;
  LegProfile profile{sums.lean.cwiseQuotient(sums.weight), sums.radius.cwiseQuotient(sums.weight)};
  for (Eigen::Index i = 0; i < sums.weight.size(); ++i)
    if (sums.weight(i) < least) profile.lean(i) = profile.radius(i) = std::numeric_limits<double>::quiet_NaN();
  if (surface_roughness(body) > kRoughScan)
    for (Eigen::MatrixXd* values : {&profile.lean, &profile.radius})
      values->bottomRows(kLevels - kMatchedOfScan).setConstant(std::numeric_limits<double>::quiet_NaN());
  if (const double mean = mean_of_known(profile.radius.topRows(kMatchedOfScan)); mean > 0.0) profile.radius /= mean;
  return profile;
}

LegLevels::LegLevels(const LegProfile& reference, const LegProfile& target)
    : target_(KnotMatch(reference, target).run()) {
  for (double& level : target_) level = kLegLow + level * kStep;
  smooth(target_);
}

double LegLevels::operator()(double level) const {
  if (level <= kLegLow) return level;
  const double s = (level - kLegLow) / kStep, top = kLegLow + static_cast<double>(target_.size() - 1) * kStep;
  if (level >= top) return level + std::clamp((kKept - level) / (kKept - top), 0.0, 1.0) * (target_.back() - top);
  const std::size_t i = std::min(target_.size() - 2, static_cast<std::size_t>(s));
  const double t = s - static_cast<double>(i);
  return (1.0 - t) * target_[i] + t * target_[i + 1];
}

}  // namespace toile

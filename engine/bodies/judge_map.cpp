// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/judge_map.h"

#include <algorithm>
#include <numeric>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/visible_skin.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/core/weighted_quantile.h"
#include "engine/geometry/edge_graph.h"
#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

// Right maps of the bodies and scans of shared/data, women's to men's and mannequins' to models among them, reach 2.3
// mm, 12-43 % and .977; bodies turned round 15-24 mm, headless and one-armed ones 59-124 % and .89-.976. The limits
// stand between.
constexpr double kScanWarned = 0.008, kScanRefused = 0.012;  // m, p95 by area
constexpr double kScanTailWarned = 0.015;                    // m, p99 without hands
constexpr double kStretchWarned = 0.35, kStretchRefused = 0.5;
constexpr double kFacingRefused = 0.95;
constexpr double kFacing = 0.5;     // cosine
constexpr double kMasked = 0.3;     // a vertex with more of hand, head or foot is not judged
constexpr int kScanSamples = 6000;  // target vertices looked at
constexpr double kSoleQuantile = 0.002;
constexpr double kFloating = 0.001;      // m
constexpr double kTurnedUnder = 0.0035;  // of the height: how much of the soles scanners do not see

double quantile(std::vector<double>& values, double fraction) {
  if (values.empty()) return 0.0;
  const auto nth = std::min(values.size() - 1, static_cast<std::size_t>(fraction * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(nth), values.end());
  return values[nth];
}

double mean(const WeightedValues& values) {
  double sum = 0.0, all = 0.0;
  for (const auto& [value, weight] : values) sum += weight * value, all += weight;
  return all > 0 ? sum / all : 0.0;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double both(const Eigen::MatrixXd& weights, Eigen::Index v, Bone bone) {
  return weights(v, bone_of(bone, Left)) + weights(v, bone_of(bone, Right));
}

class Judge {
 public:
  Judge(const RegistrationReference& reference, const Points3& mapped, const FitTarget& target)
      : reference_(reference), mapped_(mapped), target_(target) {}

  RegistrationReport run() {
    measure_skin();
    measure_scan();
    measure_stretch();
    find_floor();
    decide();
    return std::move(report_);
  }

 private:
  void measure_skin() {
    const Points3 normals = vertex_normals(mapped_, reference_.surface.triangles);
    const Eigen::VectorXd areas = vertex_areas(mapped_, reference_.surface.triangles);
    std::vector<double> distances;
    double facing = 0.0, all = 0.0;
    int near = -1;
    for (Eigen::Index v = 0; v < mapped_.rows(); ++v) {
      if (reference_.weights(v, Head) + both(reference_.weights, v, Hand) + both(reference_.weights, v, Foot) >
              kMasked ||
          reference_.visible[v] == 0)
        continue;
      const SurfacePoint c =
          target_.tree().closest_point(mapped_.row(v), std::numeric_limits<double>::infinity(), near);
      near = c.triangle;
      if (target_.on_open_edge(c)) continue;
      distances.push_back(c.distance());
      all += areas[v];
      if (target_.normal(c).normalized().dot(normals.row(v)) > kFacing) facing += areas[v];
    }
    report_.surface_mean = mean(distances);
    report_.surface_p95 = quantile(distances, 0.95);
    report_.facing_share = all > 0 ? facing / all : 0.0;
  }

  // Skin that cannot be seen from outside (a modelled mouth) is nothing to lie on: left out where it would decide.
  void measure_scan() {
    measure_scan(Eigen::VectorXd::Ones(target_.surface().vertex_count()));
    if (report_.scan_p95 > kScanWarned || report_.scan_p99_without_hands > kScanTailWarned)
      measure_scan(visible_skin(target_.surface()));
  }

  // By area: modelled bodies have half of their vertices in face and fingers.
  void measure_scan(const Eigen::VectorXd& visible) {
    const SurfaceTree tree(mapped_, reference_.surface.triangles);
    const Points3& points = target_.surface().vertices;
    const Eigen::VectorXd areas = vertex_areas(points, target_.surface().triangles);
    const auto step = std::max<Eigen::Index>(1, points.rows() / kScanSamples);
    WeightedValues all, without_hands;
    for (Eigen::Index v = 0; v < points.rows(); v += step) {
      if (visible[v] == 0) continue;
      const SurfacePoint c = tree.closest_point(points.row(v));
      all.push_back({c.distance(), areas[v]});
      if (both(reference_.weights, reference_.surface.triangles(c.triangle, 0), Hand) < kMasked)
        without_hands.push_back(all.back());
    }
    report_.scan_mean = mean(all);
    report_.scan_p95 = weighted_quantile(all, 0.95);
    report_.scan_p99_without_hands = weighted_quantile(without_hands, 0.99);
  }

  void measure_stretch() {
    std::vector<double> logs;
    const EdgeGraph graph(reference_.surface);
    for (const auto& [a, b] : graph.edges()) {
      const double before = (reference_.surface.vertices.row(a) - reference_.surface.vertices.row(b)).norm();
      const double after = (mapped_.row(a) - mapped_.row(b)).norm();
      if (before > 1e-9) logs.push_back(std::log(std::max(after, 1e-9) / before));
    }
    const double middle = quantile(logs, 0.5);
    for (double& l : logs) l = std::abs(l - middle);
    report_.stretch_p95 = quantile(logs, 0.95);
  }

  double target_height() const { return target_.surface().vertices.col(1).maxCoeff(); }

  void find_floor() {
    std::vector<double> heights;
    for (Eigen::Index v = 0; v < mapped_.rows(); ++v)
      if (both(reference_.weights, v, Foot) > 0.9) heights.push_back(mapped_(v, 1));
    const double lowest = target_.surface().vertices.col(1).minCoeff();
    // A scan that floats stands on the floor of its file. Elsewhere no more is missing than skin that turns under.
    report_.floor =
        lowest > kFloating ? 0.0 : std::max(quantile(heights, kSoleQuantile), lowest - kTurnedUnder * target_height());
  }

  void warn(std::string text) { report_.warnings.push_back(std::move(text)); }
  [[noreturn]] static void refuse(const std::string& what) {
    throw Error(
        ErrorCode::RegistrationFailed, "target_body",
        what +
            ". One whole person is needed, upright in A- or T-pose, arms and legs apart, in close-fitting clothes; "
            "give landmarks (shoulders, elbows, wrists, crotch, knees) if the body is unusual");
  }

  void decide() {
    const RegistrationReport& r = report_;
    if (r.scan_p95 > kScanRefused)
      refuse(
          print_text("parts of the target lie %.0f mm away from the registered reference (95 %%; %.0f mm are accepted)",
                     r.scan_p95 * kMmPerMetre, kScanRefused * kMmPerMetre));
    if (r.stretch_p95 > kStretchRefused)
      refuse(print_text("the reference had to be stretched by %.2f (95 %% of |ln|; %.2f is accepted)", r.stretch_p95,
                        kStretchRefused));
    if (r.facing_share < kFacingRefused)
      refuse(print_text("only %.1f %% of the registered skin faces the way the target's does (%.0f %% are needed)",
                        100 * r.facing_share, 100 * kFacingRefused));
    if (r.scan_p95 > kScanWarned)
      warn(print_text(
          "parts of the target lie %.0f mm away from the registered reference: hair, clothes or another pose?",
          r.scan_p95 * kMmPerMetre));
    else if (r.scan_p99_without_hands > kScanTailWarned)
      warn(print_text("small parts of the target lie %.0f mm away from the registered reference: hair or clothes?",
                      r.scan_p99_without_hands * kMmPerMetre));
    if (r.stretch_p95 > kStretchWarned)
      warn(print_text("the reference was stretched by %.2f to reach the target: the bodies are very unlike",
                      r.stretch_p95));
  }

  const RegistrationReference& reference_;
  const Points3& mapped_;
  const FitTarget& target_;
  RegistrationReport report_;
};

}  // namespace

RegistrationReport judge_map(const RegistrationReference& reference, const Points3& mapped, const FitTarget& target) {
  return Judge(reference, mapped, target).run();
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/register_bodies.h"

#include <algorithm>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/judge_map.h"
#include "engine/bodies/leg_web.h"
#include "engine/bodies/raise_body.h"
#include "engine/bodies/refine_map.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/geometry/closest_point.h"

namespace toile {
namespace {

constexpr double kSolesErr = 0.002, kSolesMissing = 0.030;     // m: less is the map's error, more is no matter of soles
constexpr double kLeastShare = 1e-3;                           // of a landmark, to be pinned for it
constexpr double kBoneRatioLeast = 0.5, kBoneRatioMost = 2.0;  // of a bone's length against the height ratio

bool share_topology(const Body& a, const Body& b) {
  return a.surface.triangles.rows() == b.surface.triangles.rows() &&
         a.surface.vertices.rows() == b.surface.vertices.rows() && a.surface.triangles == b.surface.triangles;
}

RegisterBodiesResult exact_map(const Body& target) {
  RegisterBodiesResult result;
  result.map.mapped = target.surface.vertices;
  result.map.exact = true;
  result.report.floor = target.surface.vertices.col(1).minCoeff();
  result.diagnostics.add("method", "shared_topology").add("vertices", target.surface.vertex_count());
  return result;
}

void check_bones(const Skeleton& reference, const Skeleton& target) {
  const double height = target.height / reference.height;
  const auto check = [&](const char* name, const Vec3& ra, const Vec3& rb, const Vec3& ta, const Vec3& tb) {
    const double ratio = (tb - ta).norm() / (rb - ra).norm() / height;
    if (ratio < kBoneRatioLeast || ratio > kBoneRatioMost)
      throw Error(
          ErrorCode::RegistrationFailed, "target_body",
          print_text("the target's %s is %.2f times as long as the reference's, measured by their heights: give "
                     "landmarks, or a reference body that is more alike",
                     name, ratio));
  };
  check("trunk", reference.pelvis, reference.neck, target.pelvis, target.neck);
  for (const Side side : {Left, Right}) {
    const auto &ra = reference.arms[side], &ta = target.arms[side];
    check("upper arm", ra.shoulder, ra.elbow, ta.shoulder, ta.elbow);
    check("forearm", ra.elbow, ra.wrist, ta.elbow, ta.wrist);
    const auto &rl = reference.legs[side], &tl = target.legs[side];
    check("thigh", rl.hip, rl.knee, tl.hip, tl.knee);
    check("shin", rl.knee, rl.ankle, tl.knee, tl.ankle);
  }
}

// A landmark lies within a triangle: its corners are pinned at their distance from it, by their share in it.
std::vector<Pin> find_pins(const RegistrationReference& reference, const Landmarks& given_places) {
  if (given_places.empty()) return {};
  const TriangleMesh& surface = reference.surface;
  const SurfaceTree tree(surface.vertices, surface.triangles);
  std::vector<Pin> pins;
  for (const auto& [name, place] : given_places) {
    const auto landmark = reference.landmarks.find(name);
    if (landmark == reference.landmarks.end()) continue;
    const SurfacePoint c = tree.closest_point(landmark->second);
    for (int k = 0; k < 3; ++k) {
      const int vertex = surface.triangles(c.triangle, k);
      const Vec3 off = surface.vertices.row(vertex).transpose() - c.point;
      if (c.barycentric[k] > kLeastShare) pins.push_back({vertex, place + off, c.barycentric[k]});
    }
  }
  return pins;
}

int count_known(const Landmarks& known, const Landmarks& given) {
  return static_cast<int>(
      std::count_if(given.begin(), given.end(), [&](const auto& landmark) { return known.contains(landmark.first); }));
}

Record describe(const RegistrationReport& r, int landmarks_given) {
  Record record;
  record.add("method", "registered")
      .add("landmarks_given", landmarks_given)
      .add("surface_mean_mm", r.surface_mean * kMmPerMetre)
      .add("surface_p95_mm", r.surface_p95 * kMmPerMetre)
      .add("scan_mean_mm", r.scan_mean * kMmPerMetre)
      .add("scan_p95_mm", r.scan_p95 * kMmPerMetre)
      .add("scan_p99_without_hands_mm", r.scan_p99_without_hands * kMmPerMetre)
      .add("edge_stretch_p95", r.stretch_p95)
      .add("facing_share", r.facing_share)
      .add("floor_mm", r.floor * kMmPerMetre)
      .add("warnings", r.warnings);
  return record;
}

}  // namespace

RegisterBodiesResult register_bodies(const RegistrationReference& reference, const Body& target,
                                     const RegisterBodiesOptions& options, const Progress* progress) {
  report(progress, "register", 0.1);
  const TriangleMesh seen = without_leg_web(target.surface);
  const FindSkeletonResult found = find_skeleton(seen);
  check_bones(reference.proportions.skeleton, found.skeleton);
  const Points3 coarse = coarse_fit(reference.surface.vertices, reference.weights, reference.proportions,
                                    find_proportions(seen, found.skeleton));
  const FitTarget fit_target(seen);
  const std::vector<Pin> pins = find_pins(reference, options.target_landmarks);

  RegisterBodiesResult result;
  result.map.mapped = refine_map(reference, coarse, fit_target, found.skeleton.height, pins, progress);
  report(progress, "register", 0.95);
  result.report = judge_map(reference, result.map.mapped, fit_target);
  for (const auto* warnings : {&reference.warnings, &found.warnings})
    result.report.warnings.insert(result.report.warnings.end(), warnings->begin(), warnings->end());
  result.diagnostics = describe(result.report, count_known(reference.landmarks, options.target_landmarks));
  report(progress, "register", 1.0);
  return result;
}

RegisterBodiesResult register_bodies(const Body& reference, const Body& target, const RegisterBodiesOptions& options,
                                     const Progress* progress) {
  report(progress, "register", 0.0);
  if (options.use_shared_topology && share_topology(reference, target)) {
    report(progress, "register", 1.0);
    return exact_map(target);
  }
  if (reference.kind == BodyKind::Form || target.kind == BodyKind::Form)
    throw Error(ErrorCode::RegistrationFailed, "target_body",
                "forms are put in correspondence only by a shared topology: give a target form with the vertices and "
                "triangles of the reference form in the same order");
  return register_bodies(prepare_reference(reference), target, options, progress);
}

double stand_on_soles(Body& target, RegisterBodiesResult& registered) {
  const double by = -registered.report.floor;
  if (registered.map.exact || std::abs(by) < kSolesErr || std::abs(by) > kSolesMissing) return 0.0;
  raise_body(target, by);
  registered.map.mapped.col(1).array() += by;
  registered.report.floor = 0.0;
  registered.diagnostics.add("raised_mm", by * kMmPerMetre);
  return by;
}

}  // namespace toile

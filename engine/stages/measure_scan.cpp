// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/measure_scan.h"

#include <algorithm>

#include "engine/geometry/closest_point.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/surface_operators.h"
#include "engine/stages/crotch_profile.h"
#include "engine/stages/find_skeleton.h"
#include "engine/stages/leg_web.h"
#include "engine/stages/make_mannequin.h"

namespace toile {

namespace {

// Below this height a child's proportions start nearer to the scan; the registration copes with either.
constexpr double kChildHeight = 1.45;                           // m
constexpr double kLeastMannequin = 0.80, kMostMannequin = 2.2;  // m, well inside what make_mannequin accepts

// Fractions of the height. A map bridges a crotch that is cut away too high: the median of imitated scans of all 15
// bodies of shared/data, the four scans left out.
constexpr double kBridgedHigher = 0.0028;
constexpr double kLevelsSoon = 0.008,
                 kLevelsLate = 0.016;  // the least and the longest way in which a crotch levels out
constexpr double kCrotchReach = 0.005, kCrotchFront = 0.04, kCrotchBand = 0.004, kCrotchNear = 0.02;
constexpr int kTaubinSteps = 4;
constexpr int kCrotchSamples = 11;
constexpr double kCutAway = 0.03;
constexpr double kFacingDown = 0.6;  // cosine

Body mannequin_like(const Body& scan) {
  const double height = scan.surface.vertices.col(1).maxCoeff();
  const Measurements asked = {{"height", std::clamp(height, kLeastMannequin, kMostMannequin)}};
  return make_mannequin(asked, {.figure = height < kChildHeight ? Figure::Child : Figure::Person}).body;
}

void move_up(MeasureBodyResult& measured, double by) {
  for (auto& [name, point] : measured.landmarks) point.y() += by;
  MeasuringLevels& l = measured.levels;
  for (double* level :
       {&l.crotch, &l.armpit, &l.chest, &l.bust, &l.underbust, &l.waist, &l.hip, &l.neck, &l.thigh, &l.knee, &l.calf})
    *level += by;
}

// Whether less than half of the way along the mid-plane under the crotch is skin of the scan.
bool crotch_is_bridged(const Vec3& crotch, double height, const TriangleMesh& scan) {
  const SurfaceTree tree(scan.vertices, scan.triangles);
  int seen = 0;
  for (int i = 0; i < kCrotchSamples; ++i) {
    const double along = kCrotchFront * i / (kCrotchSamples - 1);
    const Vec3 under = crotch + Vec3(0.0, 0.0, along * height);
    seen += tree.closest_point_facing(under, -Vec3::UnitY(), kFacingDown, kCrotchReach * height).found() ? 1 : 0;
  }
  return 2 * seen < kCrotchSamples;
}

// The lowest point of the skin's mid-plane near a level.
Vec3 lowest_middle(const TriangleMesh& skin, double level, double height) {
  Vec3 lowest(0.0, 1e300, 0.0);
  for (Eigen::Index v = 0; v < skin.vertices.rows(); ++v) {
    const Vec3 p = skin.vertices.row(v);
    if (std::abs(p.x()) < kCrotchBand * height && std::abs(p.y() - level) < kCrotchNear * height && p.y() < lowest.y())
      lowest = p;
  }
  return {0.0, level, lowest.z()};
}

// Three estimates of a crotch that the scan lacks: by the mannequin that bridges it, and by the skin that leads to it
// if that levels out soon or late. Each fails on other bodies; the middle one is taken.
double bridged_crotch(const Vec3& bridged, double height, TriangleMesh seen) {
  const double by_mannequin = bridged.y() - kBridgedHigher * height;
  seen.vertices = taubin_smooth(seen, kTaubinSteps);
  const auto soon = crotch_by_profile(seen, bridged, height, kLevelsSoon * height);
  const auto late = crotch_by_profile(seen, bridged, height, kLevelsLate * height);
  if (!soon || !late) return by_mannequin;
  return std::clamp(by_mannequin, std::min(*soon, *late), std::max(*soon, *late));
}

// Where the scan lacks the crotch the mannequin's bridges it: it is put where it must be.
void mend_bridged_crotch(Landmarks& known, const TriangleMesh& skin, const Skeleton& skeleton, const Body& scan) {
  if (known.contains("crotch")) return;
  const TriangleMesh seen = without_leg_web(scan.surface);
  Vec3 found(0.0, find_crotch_level(skin, skeleton), skeleton.pelvis.z());
  if (!crotch_is_bridged(found, skeleton.height, seen)) return;
  found.y() = bridged_crotch(lowest_middle(skin, found.y(), skeleton.height), skeleton.height, seen);
  known["crotch"] = found;
}

// Heights are measured over the soles, wherever the scan's own frame has its floor; points stay in that frame.
MeasureBodyResult measure_standing(TriangleMesh skin, const Body& scan, double floor, Landmarks known) {
  const Skeleton seen = find_skeleton(skin).skeleton;
  mend_bridged_crotch(known, skin, seen, scan);
  skin.vertices.col(1).array() -= floor;
  for (auto& [name, point] : known) point.y() -= floor;
  MeasureBodyResult measured = measure_body(skin, find_skeleton(skin).skeleton, known);
  move_up(measured, floor);
  return measured;
}

bool near_open_edge(const TriangleMesh& scan, const HalfEdges& edges, const Vec3& point, double reach) {
  for (std::size_t h = 0; h < edges.opposite.size(); ++h)
    if (edges.opposite[h] < 0 &&
        (scan.vertices.row(half_edge_start(scan.triangles, static_cast<int>(h))).transpose() - point).norm() < reach)
      return true;
  return false;
}

std::vector<std::string> estimated_measures(const Landmarks& found, const TriangleMesh& scan, double height) {
  const HalfEdges edges = find_half_edges(scan.triangles);
  std::vector<std::string> names;
  if (near_open_edge(scan, edges, found.at("head_top"), kCutAway * height)) names.push_back("height");
  if (near_open_edge(scan, edges, found.at("crotch"), kCutAway * height))
    names.insert(names.end(), {"inside_leg_length", "thigh_girth", "thigh_girth_left", "thigh_girth_right"});
  return names;
}

}  // namespace

MeasureScanResult measure_scan(const Body& scan, const Landmarks& given, Progress* progress) {
  const Body mannequin = mannequin_like(scan);
  check_cancelled(progress);
  RegisterBodiesOptions options;
  options.target_landmarks = given;
  const RegisterBodiesResult registered = register_bodies(mannequin, scan, options, progress);
  MeasureScanResult result;
  result.registration = registered.report;
  result.skin = {registered.map.mapped, mannequin.surface.triangles};
  result.measured = measure_standing(result.skin, scan, registered.report.floor, given);
  result.estimated =
      estimated_measures(result.measured.landmarks, scan.surface, registered.map.mapped.col(1).maxCoeff());
  return result;
}

}  // namespace toile

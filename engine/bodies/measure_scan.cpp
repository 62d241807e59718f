// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/measure_scan.h"

#include <algorithm>

#include "engine/bodies/body_slices.h"
#include "engine/bodies/crotch_profile.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/leg_web.h"
#include "engine/bodies/make_mannequin.h"
#include "engine/core/error.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/surface_operators.h"

namespace toile {

namespace {

// Below this height a child's proportions start nearer to the scan; the registration copes with either.
constexpr double kChildHeight = 1.45;                           // m
constexpr double kLeastMannequin = 0.80, kMostMannequin = 2.2;  // m, well inside what make_mannequin accepts

// What the second mannequin is made to. No mannequin has all of a person's measures at once: near enough will do.
constexpr const char* kOwnMeasures[] = {"height",      "neck_girth",      "chest_girth",      "bust_girth",
                                        "waist_girth", "hip_girth",       "thigh_girth",      "knee_girth",
                                        "calf_girth",  "upper_arm_girth", "inside_leg_length"};
constexpr double kOwnClose = 0.004, kOwnTolerance = 0.2;  // m

// Fractions of the height. The mannequin's crotch is a pointed arch, people's are level: what it bridges lies too high
// by the arch's tip, the median of imitated scans of the bodies of shared/data (the four scans left out).
constexpr double kArchTip = 0.0030;
constexpr double kLevelsSoon = 0.008,
                 kLevelsLate = 0.016;  // the least and the longest way in which a crotch levels out
constexpr double kCrotchReach = 0.005, kCrotchFront = 0.04, kCrotchNear = 0.025;
constexpr int kTaubinSteps = 4;
constexpr int kCrotchSamples = 11;
constexpr double kCutAway = 0.03;
constexpr double kMidline = 1e-9;                                          // m
constexpr double kAtTop = 0.001, kUnderArmpit = 0.002, kWidening = 0.015;  // m
constexpr double kGapNarrow = 0.015, kGapWide = 0.030;  // of the height: widths that tell how a gap closes
constexpr double kFacingDown = 0.6;                     // cosine

Figure figure_of(const Body& scan) {
  return scan.surface.vertices.col(1).maxCoeff() < kChildHeight ? Figure::Child : Figure::Person;
}

Body mannequin_like(const Body& scan) {
  const double height = scan.surface.vertices.col(1).maxCoeff();
  const Measurements asked = {{"height", std::clamp(height, kLeastMannequin, kMostMannequin)}};
  return make_mannequin(asked, {.figure = figure_of(scan)}).body;
}

// With the girths that were found by a first one: bridged by a body of another build, thighs and crotch come to lie
// off.
Body mannequin_of(const Measurements& found, Figure figure) {
  Measurements asked;
  for (const char* name : kOwnMeasures) asked[name] = found.at(name);
  return make_mannequin(asked, {.figure = figure, .close_enough = kOwnClose, .tolerance = kOwnTolerance}).body;
}

void move_up(MeasureBodyResult& measured, double by) {
  for (auto& [name, point] : measured.landmarks) point.y() += by;
  MeasuringLevels& l = measured.levels;
  for (double* level :
       {&l.crotch, &l.armpit, &l.chest, &l.bust, &l.underbust, &l.waist, &l.hip, &l.neck, &l.thigh, &l.knee, &l.calf})
    *level += by;
}

// Whether the scan has no skin at the crest, or at less than half of the way along the mid-plane under the crotch.
bool crotch_is_bridged(const Vec3& crotch, const Vec3& crest, double height, const TriangleMesh& scan) {
  const SurfaceTree tree(scan.vertices, scan.triangles);
  const auto is_seen = [&](const Vec3& p) {
    return tree.closest_point_facing(p, -Vec3::UnitY(), kFacingDown, kCrotchReach * height).found();
  };
  if (!is_seen(crest)) return true;
  int seen = 0;
  for (int i = 0; i < kCrotchSamples; ++i)
    seen += is_seen(crotch + Vec3(0.0, 0.0, kCrotchFront * height * i / (kCrotchSamples - 1))) ? 1 : 0;
  return 2 * seen < kCrotchSamples;
}

// The lowest point of the mannequin's midline near a level: thighs that cross beside it are not looked at.
Vec3 lowest_crest(const TriangleMesh& skin, const Body& mannequin, double level, double height) {
  Vec3 lowest(0.0, 1e300, 0.0);
  for (Eigen::Index v = 0; v < skin.vertices.rows(); ++v) {
    const Vec3 p = skin.vertices.row(v);
    if (std::abs(mannequin.surface.vertices(v, 0)) < kMidline && std::abs(p.y() - level) < kCrotchNear * height &&
        p.y() < lowest.y())
      lowest = p;
  }
  return lowest.y() < 1e300 ? lowest : Vec3(0.0, level, 0.0);
}

// A crotch that the scan lacks. One half is told by the mannequin that bridges it; the other by the skin that leads to
// it, which levels out soon or late: the mannequin's where that lies between both, else the nearer of them.
double bridged_crotch(const Vec3& bridged, double height, TriangleMesh seen) {
  const double by_mannequin = bridged.y() - kArchTip * height;
  seen.vertices = taubin_smooth(seen, kTaubinSteps);
  const auto soon = crotch_by_profile(seen, bridged, height, kLevelsSoon * height);
  const auto late = crotch_by_profile(seen, bridged, height, kLevelsLate * height);
  if (!soon || !late) return by_mannequin;
  return 0.5 * (by_mannequin + std::clamp(by_mannequin, std::min(*soon, *late), std::max(*soon, *late)));
}

// A mannequin in the shape of the scan.
struct Fitted {
  Body mannequin;
  TriangleMesh skin;
  RegistrationReport report;
};

Fitted fit(Body mannequin, const Body& scan, const Landmarks& given, Progress* progress) {
  RegisterBodiesOptions options;
  options.target_landmarks = given;
  const RegisterBodiesResult registered = register_bodies(mannequin, scan, options, progress);
  Fitted fitted;
  fitted.skin = {registered.map.mapped, mannequin.surface.triangles};
  fitted.report = registered.report;
  fitted.mannequin = std::move(mannequin);
  return fitted;
}

// Where the scan lacks the crotch the mannequin's bridges it: it is put where it must be.
void mend_bridged_crotch(Landmarks& known, const Fitted& fitted, const Skeleton& skeleton, const Body& scan) {
  if (known.contains("crotch")) return;
  const TriangleMesh seen = without_leg_web(scan.surface);
  Vec3 found(0.0, find_crotch_level(fitted.skin, skeleton), skeleton.pelvis.z());
  const Vec3 crest = lowest_crest(fitted.skin, fitted.mannequin, found.y(), skeleton.height);
  if (!crotch_is_bridged(found, crest, skeleton.height, seen)) return;
  found.y() = bridged_crotch(crest, skeleton.height, seen);
  known["crotch"] = found;
}

bool near_open_edge(const TriangleMesh& scan, const HalfEdges& edges, const Vec3& point, double reach) {
  for (std::size_t h = 0; h < edges.opposite.size(); ++h)
    if (edges.opposite[h] < 0 &&
        (scan.vertices.row(half_edge_start(scan.triangles, static_cast<int>(h))).transpose() - point).norm() < reach)
      return true;
  return false;
}

// Whether the skin beside an armpit is missing in the scan; the slices are `floor` lower than it.
bool armpit_is_cut_away(const BodySlices& slices, double armpit, Side side, const TriangleMesh& scan, double floor) {
  const auto trunk = slices.middle(armpit - kUnderArmpit);
  if (!trunk) return false;
  const double out = side == Left ? 1.0 : -1.0;
  Vec2 beside = trunk->centre();
  for (const Vec2& p : trunk->points())
    if (out * p.x() > out * beside.x()) beside = p;
  const Vec3 place(beside.x(), armpit + floor, beside.y());
  return near_open_edge(scan, find_half_edges(scan.triangles), place, kCutAway * slices.height());
}

// A chest that is widest right under the armpits goes on widening up into them. Where they are cut away the mannequin's
// lie too low in the holes or too high; the place where arms and trunk would meet if the gap between them went on
// closing is as far off the other way: the middle of both is taken.
void mend_chest(MeasureBodyResult& measured, const TriangleMesh& skin, const TriangleMesh& scan, double floor) {
  const double armpit = measured.levels.armpit;
  if (measured.levels.chest < armpit - kAtTop) return;
  const BodySlices slices(skin, false);
  if (!armpit_is_cut_away(slices, armpit, Left, scan, floor) || !armpit_is_cut_away(slices, armpit, Right, scan, floor))
    return;
  const double closing = arms_meet(slices, armpit, kGapNarrow, kGapWide).value_or(armpit);
  const double widening = (slices.middle_girth(armpit) - slices.middle_girth(armpit - kWidening)) / kWidening;
  measured.measurements["chest_girth"] += std::max(0.0, widening) * 0.5 * (closing - armpit);
}

// Heights are measured over the soles, wherever the scan's own frame has its floor; points stay in that frame.
MeasureBodyResult measure_standing(const Fitted& fitted, const Body& scan, Landmarks known) {
  const double floor = fitted.report.floor;
  mend_bridged_crotch(known, fitted, find_skeleton(fitted.skin).skeleton, scan);
  TriangleMesh skin = fitted.skin;
  skin.vertices.col(1).array() -= floor;
  for (auto& [name, point] : known) point.y() -= floor;
  MeasureBodyResult measured = measure_body(skin, find_skeleton(skin).skeleton, known);
  mend_chest(measured, skin, scan.surface, floor);
  move_up(measured, floor);
  return measured;
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
  check_cancelled(progress);
  Fitted fitted = fit(mannequin_like(scan), scan, given, progress);
  MeasureScanResult result;
  result.measured = measure_standing(fitted, scan, given);
  try {
    fitted = fit(mannequin_of(result.measured.measurements, figure_of(scan)), scan, given, progress);
    result.measured = measure_standing(fitted, scan, given);
  } catch (const Error& error) {
    if (error.code != ErrorCode::OptionInvalid && error.code != ErrorCode::RegistrationFailed) throw;
  }
  result.registration = fitted.report;
  result.estimated =
      estimated_measures(result.measured.landmarks, scan.surface, fitted.skin.vertices.col(1).maxCoeff());
  result.skin = std::move(fitted.skin);
  return result;
}

}  // namespace toile

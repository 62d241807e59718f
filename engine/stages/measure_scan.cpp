// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/measure_scan.h"

#include <algorithm>

#include "engine/stages/find_skeleton.h"
#include "engine/stages/make_mannequin.h"

namespace toile {

namespace {

// Below this height a child's proportions start nearer to the scan; the registration copes with either.
constexpr double kChildHeight = 1.45;                           // m
constexpr double kLeastMannequin = 0.80, kMostMannequin = 2.2;  // m, well inside what make_mannequin accepts

Body mannequin_like(const Body& scan) {
  const double height = scan.surface.vertices.col(1).maxCoeff();
  const Measurements asked = {{"height", std::clamp(height, kLeastMannequin, kMostMannequin)}};
  return make_mannequin(asked, {.figure = height < kChildHeight ? Figure::Child : Figure::Person}).body;
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
  result.measured = measure_body(result.skin, find_skeleton(result.skin).skeleton, given);
  return result;
}

}  // namespace toile

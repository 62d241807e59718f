// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/registered_skin.h"

#include <algorithm>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

// The scans of shared/data come within 2.2 and 4 mm; hair and loose clothes stand off by more.
constexpr double kClose = 0.004, kCloseTail = 0.008;  // m, scan to registered reference: p95, p99 without hands

}  // namespace

std::string take_registered_skin(Body& target, const TriangleMesh& reference, const RegisterBodiesResult& registered,
                                 bool landmarks_given) {
  if (registered.map.exact || surface_roughness(target.surface) <= kRoughScan) return "own: a model";
  if (landmarks_given) return "own: landmarks were given";
  const RegistrationReport& report = registered.report;
  if (report.scan_p95 > kClose || report.scan_p99_without_hands > kCloseTail)
    return print_text("own: parts of the scan lie %.0f mm away from the registered reference",
                      std::max(report.scan_p95, report.scan_p99_without_hands) * kMmPerMetre);
  target.surface = {registered.map.mapped, reference.triangles};
  return "registered_reference";
}

}  // namespace toile

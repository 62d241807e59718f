// SPDX-License-Identifier: GPL-3.0-or-later
// Register: put a reference body in correspondence with a target body. The result is a body map.
//
// Bodies that share one topology (equal triangles, vertex by vertex) correspond exactly; the report says so. Otherwise
//   skeletons -> coarse fit of pose and proportions -> thin-plate refinement on the target's skin -> guards
// without landmarks. A target may have holes, and is better off with them than with patches over them. Landmarks given
// by the user for the target win: that point of the reference comes to lie there. Hands, head and feet follow, but are
// only as good as they are alike. Source: [Eggler2024, Sec. 4.1] asks for the map; shared design page "registration" is
// the method. Metres.
#pragma once

#include "engine/bodies/registration_reference.h"
#include "engine/core/archive_values.h"
#include "engine/core/progress.h"
#include "engine/core/record.h"

namespace toile {

struct RegisterBodiesOptions {
  bool use_shared_topology = true;  // take equal triangle lists as exact correspondence
  Landmarks target_landmarks = {};  // given by the user for the target, normalised frame; names as in the reference's
};

// How good a found map is. Metres; 0 where the correspondence is exact.
struct RegistrationReport {
  double surface_mean = 0.0, surface_p95 = 0.0;  // mapped body to target, hands, head and feet left out
  double scan_mean = 0.0, scan_p95 = 0.0;        // target to mapped body: tells a turned or missing part
  double scan_p99_without_hands = 0.0;
  double stretch_p95 = 0.0;   // of |ln(mapped / reference edge length) - median|
  double facing_share = 1.0;  // of the area whose normal agrees with the target's
  double floor = 0.0;         // y of the mapped soles; the target's own floor may be missing
  std::vector<std::string> warnings;
};

struct RegisterBodiesResult {
  BodyMap map;
  RegistrationReport report;
  Record diagnostics;  // the report for documents, the method, and every fallback taken
};

template <class A>
void archive(A& a, RegistrationReport& v) {
  a(v.surface_mean, v.surface_p95, v.scan_mean, v.scan_p95, v.scan_p99_without_hands, v.stretch_p95, v.facing_share,
    v.floor, v.warnings);
}
template <class A>
void archive(A& a, RegisterBodiesResult& v) {
  a(v.map, v.report, v.diagnostics);
}

// Throws BodyNotRecognised (no upright person), RegistrationFailed (the map is no body map; says which number and why).
RegisterBodiesResult register_bodies(const Body& reference, const Body& target,
                                     const RegisterBodiesOptions& options = {}, const Progress* progress = nullptr);

// The same with a prepared reference, for many targets. Shared topology is not looked for.
RegisterBodiesResult register_bodies(const RegistrationReference& reference, const Body& target,
                                     const RegisterBodiesOptions& options = {}, const Progress* progress = nullptr);

// Sets a scan on the soles of the reference that was registered to it, where its own were cut off by more than a map
// errs; the map goes with it. Returns how far they were raised, m.
double stand_on_soles(Body& target, RegisterBodiesResult& registered);

}  // namespace toile

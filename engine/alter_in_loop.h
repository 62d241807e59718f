// SPDX-License-Identifier: GPL-3.0-or-later
// Alteration with physics in the loop: plan the alteration, drape the altered garment, and plan again with a smaller
// share of the allowed stretch where it does not rest in its place.
//
// Strain below mu may still hang a trouser leg askew, which no flat measure foretells; nor does less strain always
// bring cloth nearer to its place, so that every plan is tried on. Place: where the body map carries the reference
// drape to; a garment lies in it that rests little farther off than the target pattern itself. Loose cloth rests
// elsewhere on other triangles, and the altered garment has others: where it is farther off than the target pattern on
// the mesh it was derived on, that is tried on, too, on three meshes as fine as the altered one's; what lies no farther
// off there lies in its place, but whether as few operations bring it nearer is looked at all the same. Where the
// target pattern itself comes to no rest, one plan is all. Of the plans the one with the fewest faults is kept, of
// those the one with the fewest operations, of those the nearest. Source: [Eggler2024, Sec. 8]; the order of the plans
// was measured.  SI units.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/derive_in_loop.h"
#include "engine/drape_altered.h"

namespace toile {

struct AlterInLoopOptions {
  int max_plans = 3;  // alterations, each with its drape, 1..5
  // A garment lies in its place where its rms distance from it is at most this many times that of the target pattern
  // and so many metres, where mu is 3 %; where it is more, so are they: who lets cloth keep more lets it rest farther
  // off.
  double share_of_ideal = 1.25;
  double farther_off = 2e-3;
  // Of the mesh a plan is tried on with where the original's has over half as many more: that many tell its place as
  // well as any number, 2,500 do not.
  int check_triangles = 4000;
};

// One plan, as it was tried on.
struct TriedPlan {
  double share = 1.0;  // of the allowed stretch, planned with
  int operations = 0;
  int faults = 0;         // see faults_of
  std::string problem;    // why it could not be draped, or empty
  int triangles = 0;      // of the mesh it was draped with
  double position = 0.0;  // m, rms distance from its place
};

struct PlacedPlans {
  double ideal = 0.0;                 // m, rms distance of the target pattern's drape from its place
  std::optional<double> meshed_anew;  // the same on meshes as the plans', in the mean; none: not looked at
  double allowed = 0.0;               // m, of an altered garment
  std::vector<TriedPlan> plans;       // in order
  int kept = 0;                       // which of them

  const TriedPlan& kept_plan() const { return plans[static_cast<std::size_t>(kept)]; }
  bool in_place(const TriedPlan& plan) const { return plan.problem.empty() && plan.position <= allowed; }
};

struct AlterInLoopResult {
  AlterPatternResult altered;  // by the plan that is kept
  TriedOn worn;                // how it was tried on with a mesh as fine as the original's; or empty
  PlacedPlans place;
};

// Where the target pattern rests off its place, which is the start of `scene`, if its mesh is not the one it was
// derived on: m rms, the mean over three meshes of about `edge_length` (m), for on one it is chance where loose cloth
// rests. None if it cannot be draped.
std::optional<double> position_meshed_anew(const AlterationScene& scene, const Pattern& target, double edge_length,
                                           DrapeSeries& on_target, const DrapeOptions& options,
                                           Progress* progress = nullptr);

// `scene`: its start is the place. `target`: the pattern of the scene's target mesh, draped. `on_target`: on the target
// body. Throws what alter_pattern and drape_from do. `at_once`: see alter_pattern.
AlterInLoopResult alter_in_loop(const Pattern& pattern, const AlterationScene& scene, const DerivedPattern& target,
                                DrapeSeries& on_target, const AlterPatternOptions& alter_options,
                                const DrapeOptions& drape_options, const AlterInLoopOptions& options = {},
                                Progress* progress = nullptr, bool at_once = false);

}  // namespace toile

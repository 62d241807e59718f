// SPDX-License-Identifier: GPL-3.0-or-later
// Turn an existing pattern into a target pattern by the fewest practical operations: where cloth is let in, where it is
// taken away, and how the tailor does it.
//
// Two passes of the same code: the original cloth stretched onto the target tears where cloth must be inserted; the
// target's cloth stretched onto the original tears where cloth must be removed.
// Steps of a pass: stretch, weigh trial tears, choose by a 0/1 program, propagate, relax, repeat; undo redundant tears;
// recut by exact polygon booleans; read the regions as operations.
// Source: [Eggler2024, Sec. 6]; method.md section 5.  Lengths in metres.
#pragma once

#include <memory>

#include "engine/alter/recut.h"
#include "engine/alter/sewn_pattern.h"
#include "engine/alter/tear_pattern.h"
#include "engine/core/ticket.h"

namespace toile {

enum class TearChoice {
  Release,   // by the energy a trial tear releases: fewest tears
  Boundary,  // by the tangential stress of the border, as the paper does
  Greedy,    // by the energy, but each panel for itself, without the program: for comparison
};

struct AlterPatternOptions {
  int max_tears_per_side = 1;    // Theta, cuts into one side over the whole run, 0-5
  double seam_preference = 1.5;  // gamma, favours existing seams over new cuts, >= 1
  double stretch_limit = 0.03;   // mu, stretch the altered cloth may keep, dimensionless, > 0
  double planned_share = 1.0;    // of mu that tears are planned with; what is left is judged by all of it, > 0 to 1
  bool l_shapes = false;         // leave L- and T-shaped insertions in one piece; else they become strips
  bool symmetric = true;  // what is done on the wearer's left is done on the right, where panels are mirror images
  TearChoice choice = TearChoice::Release;
  bool mesh_edge_cuts = false;          // cut along mesh edges as the paper does, for comparison
  double cut_smoothness = 0.5;          // alpha, of cuts along mesh edges, 0-1
  double least_strip = 0.015;           // m: a cut that opens less is not made
  double least_change = 0.004;          // m: smaller operations are marked as below the accuracy of measuring
  double least_allowance_left = 0.005;  // m: of the seam allowance that must remain when a seam is let out
};

// One piece of cloth to insert, or to take away.
struct AlteredRegion {
  std::string name;        // "front_insertion_1"
  PolygonWithHoles shape;  // true to scale: an insertion in the target panel's frame, a removal in the original's
  double area = 0.0;       // m^2
  int operation = -1;      // of the ticket
};

struct PanelAlteration {
  std::string panel;
  std::vector<Vec2> original, target;             // outlines, counter-clockwise
  std::vector<PolygonWithHoles> kept;             // of the original cloth, after cutting and taking away
  std::vector<std::vector<Vec2>> cut_lines;       // in the original cloth: where insertions are let in
  std::vector<std::vector<Vec2>> kept_in_target;  // where the stretched cloth lies in the target panel
  std::vector<AlteredRegion> insertions, removals;
  double cut_back = 0.0;                      // m^2, of cloth cut away to make room for insertions of the least width
  PanelTearing insertion_pass, removal_pass;  // stress before and after, tears with their weights
};

struct AlterPatternResult {
  std::vector<PanelAlteration> panels;  // one per panel of the pattern
  Ticket ticket;                        // names of garment and bodies are the caller's to fill in
  double original_area = 0.0, target_area = 0.0, inserted_area = 0.0, removed_area = 0.0;  // m^2
  double area_imbalance = 0.0;  // |original + inserted - removed - target| / target
  double planned_share = 1.0;   // of the allowed stretch, that the tears were planned with
  double strain_left = 0.0;     // over what is allowed, of the panel with the most (share_of_limit); not those cut anew
  int insertion_rounds = 0, removal_rounds = 0, trials = 0, reverted = 0, dropped_regions = 0;
  SewnPattern sewn;                // the altered garment, ready to be cut
  std::vector<std::string> flags;  // panels where the stretch limit was not reached, with the reason
};

// What plans for one garment, target and kind of alteration have found out. Those with another share of the allowed
// stretch look it up: they come out the same.
class PlanMemory {
 public:
  PlanMemory();
  ~PlanMemory();
  PlanMemory(const PlanMemory&) = delete;
  PlanMemory& operator=(const PlanMemory&) = delete;

  struct Known;
  Known& known() { return *known_; }

 private:
  std::unique_ptr<Known> known_;
};

// `target_rest`: #V x 2, the target pattern's flat positions of the mesh's vertices. Throws AlterationFailed,
// Cancelled. `at_once`: insertions and removals are looked for by a thread each; `progress` hears from both. `memory`:
// of plans that differ from this one in `planned_share` alone.
AlterPatternResult alter_pattern(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternOptions& options, Progress* progress, bool at_once,
                                 PlanMemory& memory);
// Without any memory of other plans.
AlterPatternResult alter_pattern(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternOptions& options = {}, Progress* progress = nullptr,
                                 bool at_once = false);

// Flags, one more where strain adds up to too much area, and one where two sides of a seam are not alike.
std::size_t faults_of(const AlterPatternResult& result);

}  // namespace toile

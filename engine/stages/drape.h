// SPDX-License-Identifier: GPL-3.0-or-later
// Drape a garment on a body: the node positions at which its cloth is in equilibrium.
//
// Unknown: the position of every garment node. Energy: membrane + bending + gravity + contact + lagged friction.
// From flat: arrange the panels so that every limb lies inside its tube, weld, sew without gravity, then relax; a fine
// mesh does so from where a coarse one came to rest.
// From a given start (a transported or stored drape): relax only.
// Where body, pattern and start are the same on the left and the right, so is the drape, and one half is moved.
// Source: design/sewing.md; [Eggler2024, Sec. 7].  SI units.
#pragma once

#include "engine/core/options.h"
#include "engine/core/progress.h"
#include "engine/stages/drape_guards.h"

namespace toile {

struct DrapeOptions {
  double friction = 0.3;     // Coulomb coefficient of cloth on body, 0..2; 0: none
  double gravity = 9.81;     // m/s^2, 0..100
  double thickness = 0.003;  // distance of the cloth's nodes from the body, m, 0..0.05, to which the chord sag is added
  double sag_radius = 0.06;  // m, > 0: h^2 / (8 R) is added to the thickness, R the smallest limb radius
  double contact_stiffness = 2e6;  // N/m^3, > 0
  int iterations = 3000;           // of the relaxation, at most, 0..100000; 300 settle the placement
  double stop_residual = 0.3;      // residual at which it stops, in mean node weights, > 0
  // The same where nothing moves any more, of all nodes but the worst fiftieth (see Rest::Settled); 0: only
  // stop_residual counts. The error is in proportion to the residual, and that of 1.5 is below 1 mm and 0.1 % of
  // stretch.
  double stop_settled = 1.5;
  double lift = 0.015;  // m the torso is arranged above the height at which it clears the shoulders, 0..0.1
  std::optional<BodyGuides> drafted_for;  // of the body the pattern's placement belongs to; empty: this body
  // From a given start: holds every opening (cuffs, hems, waist, neckline) where the start has it, so that a garment
  // stretches instead of sliding. The pattern's own pins hold either way.                       [Eggler2024, Sec. 4.1]
  bool pin_openings = false;
  bool keep_drape = false;  // take a given start as the drape, without moving it (drape_from only)
  // Pbd: the paper's averaging instead of the equilibrium solver. Newton: the exact minimum, from the default's end
  // with its contacts and friction anchors held; without friction from the default's start.
  SolverKind solver = SolverKind::Default;
  double newton_residual = 1e-6;                 // at which Newton stops, in mean node weights, > 0
  double fibre_slack = 0.0;                      // delta of the position-based solver, 0..0.2
  double shear_limit_deg = 12.0;                 // rho of the position-based solver, 0..45
  SelfContact self_contact = SelfContact::Auto;  // Off: cloth passes through cloth
  int first_rung = 0;  // of the retry ladder to begin with, 0 or 1: as designed, higher and firmer
  // From flat, a finer mesh goes on from the drape of one of that many triangles, or of meshes in between, with its
  // friction: of the many ways in which friction and folds let cloth rest, all meshes take the same one. 0,
  // 500..200000; 0: every mesh from flat.
  int coarse_triangles = 4000;
  bool halve = true;  // where both sides are the same, move one and reflect it (solver Default); false: move both
};

struct DrapeDiagnostics {
  double upper_shift = 0.0;  // m the torso was raised by the arrangement
  bool bodice = false;       // the shoulders carry the garment: no waist hold, contact with the arms
  double hold_height = 0.0;  // m the waist is kept from sinking below; 0: not held
  int moved_nodes = 0;       // by the solver; of a symmetric garment those of one half
  int sewing_iterations = 0;
  int iterations = 0;
  int evaluations = 0;
  double energy = 0.0;                 // J
  bool stalled = false;                // no further decrease could be found, or it got nowhere
  bool tangled = false;                // it got nowhere for layers that do not come free
  int rung = 0;                        // of the retry ladder that gave the result
  std::vector<DrapeFinding> findings;  // warnings; from flat none is a refusal
};

struct DrapeResult {
  Drape drape;
  DrapeQuality quality;
  DrapeDiagnostics diagnostics;
};

// From flat. Requires a mesh of `pattern`. An attempt that a guard refuses (drape_guards.h) is repeated on the next
// rung of the ladder. Throws Error{DrapeFailed} with the findings of the last rung, Error{OptionInvalid}.
DrapeResult drape(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const DrapeOptions& options,
                  Progress* progress);

// From a given start, #N x 3 in the body's frame. Findings are reported, not acted upon; Error{DrapeFailed} only if the
// nodes are not finite.
DrapeResult drape_from(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const DrapeOptions& options, Progress* progress);

}  // namespace toile

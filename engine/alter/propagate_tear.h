// SPDX-License-Identifier: GPL-3.0-or-later
// Tear a stretched sheet: an edge tear cuts in from the middle of a side, a corner tear lets a side go along its seam.
//   edge tear: cut straight through, relax, sew up again beyond the first place that stays shut, relax
//   corner tear: release the whole side, relax, attach again what reaches its wanted place, relax
// Source: [Eggler2024, Sec. 6.3]; cut through, relax, re-zip: method.md section 5.  Lengths in metres.
#pragma once

#include "engine/alter/stretch.h"

namespace toile {

enum class TearKind {
  Release,  // corner tear: along side `side`
  Edge,     // edge tear: into the cloth from side `side`
};

struct Tear {
  TearKind kind = TearKind::Release;
  int panel = 0;
  int side = 0;                   // of the panel
  double at = 0.0;                // edge tear: where it starts, arc length along the cloth's side
  Vec2 direction = Vec2::Zero();  // edge tear: unit, in the cloth
  bool operator==(const Tear&) const = default;
};

// A place on a side where an opening breaks the outline: what is sewn there must open too.
struct TearMouth {
  int side = 0;
  double at = 0.0;  // arc length along the cloth's side
};

struct TearOutcome {
  bool opened = false;       // anything stays open
  double largest_gap = 0.0;  // m
  std::vector<TearMouth> mouths;
};

struct TearOptions {
  double least_gap = 0.003;  // m: what is less open is sewn up again                           [method, Sec. 5]
  bool mesh_edges = false;   // cut along mesh edges as the paper does, for comparison
  double smoothness = 0.5;   // alpha, of a cut along mesh edges, 0..1                          [Eggler2024, Sec. 6.3]
  double stress_radius = 0.08;  // m: around the start, over which the stress is averaged          [method, Sec. 5]
  double grain_snap = 15.0;     // degrees: a cut this near to a fibre runs along it               [method, Sec. 5]
  RelaxOptions relaxation;
};

TearOutcome propagate_tear(Sheet& sheet, const Tear& tear, const TearOptions& options, Progress* progress = nullptr);

// Carries out several tears of one panel: all sides are let go at once, then the cuts are made in their order. One
// outcome per tear. `shared`: see relax(); for the sides alone.
std::vector<TearOutcome> propagate_tears(Sheet& sheet, const std::vector<Tear>& tears, const TearOptions& options,
                                         Progress* progress = nullptr, SheetEquations* shared = nullptr);

// Across the averaged largest stretch around a border vertex, into the cloth, snapped to the grain.
Vec2 tear_direction(const Sheet& sheet, int vertex, const TearOptions& options);

// Border vertex of a side nearest to an arc length, not a corner; -1 if the side has none.
int vertex_on_side(const Sheet& sheet, int side, double at);

// How far inside its wanted side a vertex stands, m; negative outside.
double gap_to_side(const Sheet& sheet, int vertex, int side);

}  // namespace toile

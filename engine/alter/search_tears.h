// SPDX-License-Identifier: GPL-3.0-or-later
// Which sets of tears would bring one panel within the allowed stretch: each set is carried out on a copy of the
// stretched sheet and relaxed for itself, so that no set holds a tear which another one makes needless
// [Eggler2024, Sec. 6.2, Fig. 10].
#pragma once

#include <optional>

#include "engine/alter/stretch.h"
#include "engine/alter/tear_units.h"

namespace toile {

struct TearSet {
  std::vector<int> units;            // of the panel, ascending; empty: the panel is left alone
  SheetStress stress;                // what it leaves
  std::vector<TearMouth> mouths;     // where it breaks the outline
  std::vector<double> largest_gaps;  // m, per unit
};

// A set as it was tried: the tears of each of its units, and what they leave if they can be made. Nothing of it depends
// on the stretch limit.
struct TriedSet {
  std::vector<std::vector<Tear>> units;
  std::optional<TearSet> left;
};

struct SearchTearsOptions {
  double stretch_limit = 0.03;               // mu
  double least_strip = 0.015;                // m: a cut that opens less is not made
  bool removing = false;                     // what opens is taken away; the original pattern is where the sheet lies
  std::vector<std::vector<Vec2>> keep_outs;  // regions of the original pattern that are neither cut nor taken away
  TearOptions tear;
  int beam = 4;        // sets of one size that are enlarged
  int most_units = 4;  // of a set
};

// How far kept cloth reaches out of the wanted panel, m: where a tear made it overlap what it should lie beside.
double farthest_outside(const Sheet& sheet);

// Strain that is left over what is allowed; 1: just that. By the strain that a twentieth of the cloth exceeds, or by
// what all of it adds to the fit's error (rms of both directions) against half the limit, whichever is kinder: round
// the tips of darts and corners strain is high in little cloth, and no tear helps. Where strain moves the cloth's edges
// by less than can be measured on bodies, nothing is left: a millimetre strains narrow bands much.
double share_of_strain(const SheetStress& stress, double limit);

// How far the mean strain moves the cloth's edges off over how far it may, which is as far as the allowed stretch moves
// those of 30 cm of cloth: 3 % of a trouser leg would be a hem 30 mm too high.
double share_of_shift(const SheetStress& stress, double limit);

// How far the cloth leans, by shear or by strain that grows across it, over how far mean strain may move its edges.
double share_of_lean(const SheetStress& stress, double limit);

// The larger of strain and shift.
double share_of_limit(const SheetStress& stress, double limit);

// Times the limit; a panel that stopped so near is done: strain at the tip of a tear is singular, so the last
// percentiles stay a little over the limit where nothing is left to gain.
inline constexpr double kNearEnough = 1.25;

// What farther out than this is no alteration, m.
inline constexpr double kMostOutside = 0.01;

// Adds to `sets` (the empty set first, then in the order they are tried) what the units from `first_unit` on make
// possible; with `sets` empty and `first_unit` 0 everything. `trials` is counted up. `equations`: of the sheet.
// `tried`: sets that were tried on this sheet; grows.
void search_tears(const Sheet& stretched, const std::vector<TearUnit>& units, int first_unit,
                  const SearchTearsOptions& options, SheetEquations& equations, std::vector<TriedSet>& tried,
                  std::vector<TearSet>& sets, int& trials, Progress* progress = nullptr);

}  // namespace toile

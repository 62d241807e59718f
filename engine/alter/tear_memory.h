// SPDX-License-Identifier: GPL-3.0-or-later
// What one pass has found out about the cloth of a garment. How cloth lies once it is stretched, torn and relaxed does
// not depend on how much stretch it may keep, so that plans with less of it look up what earlier ones have tried.
#pragma once

#include <array>
#include <memory>

#include "engine/alter/search_tears.h"

namespace toile {

// A panel's tears carried out on the garment's own mesh, beginning where the coarse one lies.
struct CarriedOut {
  Sheet planned;
  std::vector<Tear> tears;
  Sheet sheet;
  std::vector<TearOutcome> outcomes;
};

// A vertex that is held at its place along a seam.
struct SeamHold {
  int vertex = 0, side = 0;
  double at = 0.0;  // arc length along the wanted side
  bool moves = false;
  bool operator==(const SeamHold&) const = default;
};

// A sheet relaxed while it is held.
struct HeldSheet {
  Sheet before;
  std::vector<SeamHold> holds;
  Sheet after;
};

// One panel, of which only one thread asks at a time.
struct PanelMemory {
  std::shared_ptr<SheetEquations> coarse, fine;  // of the sheets before they are cut, or nothing yet
  std::shared_ptr<const Sheet> stretched;        // the coarse sheet, relaxed; or nothing yet
  std::array<std::vector<TriedSet>, 2> tried;    // beginning at the plain map, and at the stretched sheet
  std::vector<CarriedOut> carried_out;
  std::vector<HeldSheet> held;
};

using TearMemory = std::vector<PanelMemory>;  // per panel

// Those of the sheet, made where they are not known.
SheetEquations& equations_of(std::shared_ptr<SheetEquations>& known, const Sheet& sheet, double hold);

// Whether the cloth is the same and lies alike.
bool lie_alike(const Sheet& a, const Sheet& b);

}  // namespace toile

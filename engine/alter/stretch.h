// SPDX-License-Identifier: GPL-3.0-or-later
// Stretch one panel's cloth onto another outline and let it relax.
//
// Unknown: where every vertex of the sheet is.  Minimise
//   sum_f A_f |G_f - P_f|^2  +  1e3 sum_attached (n.(x - c))^2  +  h sum_v A_v |x - g|^2  +  1e-6 diag |x - x_before|^2
// with P_f the nearest gradient whose fibres have length l* = min(1, that of the plain map) at 90 +- 5 degrees, where
// shear costs long cloth what stretch does, and (c, n) foot and normal on the wanted side, on which attached vertices
// slide, and g the place in the plain map, which keeps cloth that hangs on no side, or could slide along one, from
// drifting off. Cloth that can slide as a whole, straight or round a bend, is held ten times as firmly; if
// its panel is its own mirror image, it does not shift across the axis a at all: sum_v A_v (x - g).a = 0.
// l* < 1: cloth that must shrink here is the business of the pass with the roles swapped, not stress.
//   local step: P_f      global step: a prefactored solve; (c, n) renewed every few sweeps
// Source: [Eggler2024, Sec. 6]; energy and weights method.md section 5.  Lengths in metres.
#pragma once

#include "engine/alter/sheet_equations.h"
#include "engine/core/progress.h"

namespace toile {

struct RelaxOptions {
  int max_renewals = 12;       // of foot points and normals, each with its factorisation, >= 1
  int sweeps = 6;              // between renewals, >= 1                                       [method, Sec. 5]
  double energy_drop = 1e-4;   // end when a renewal changes the energy by less; relative to the energy, > 0
  double hold = 0.01;          // h, 1/m^2: bends strain by about h times a panel's width times its way, >= 0
  double energy_floor = 1e-9;  // energy per area below which nothing is left to relax, dimensionless
};

struct SheetStress {
  double energy = 0.0;  // sum A |G - P|^2, m^2
  double p95 = 0.0;     // of max(|Gu|, |Gv|) - 1, area weighted over interior and border: tension only
  double p98 = 0.0;     // ... which near the tips of tears and darts, where strain is singular, tells more of the mesh
  double way = 0.0;     // m, how far the p95 of weft or warp strain brings the cloth's edges off: strain times extent
  double shift = 0.0;   // m, how far the mean of weft or warp strain brings the cloth's edges off
  double lean = 0.0;    // m, how far shear or strain that grows across the cloth brings an edge off sideways
  double area = 0.0;    // of the cloth, m^2
};

// Moves sheet.now to (near) the minimum; the cloth's present place is the start. `shared`: the equations of the sheet
// with this `hold`, or of an uncut copy of it; made here where they are not given.
void relax(Sheet& sheet, const RelaxOptions& options = {}, Progress* progress = nullptr,
           SheetEquations* shared = nullptr);

// What is left in the cloth where it is.
SheetStress measure_stress(const Sheet& sheet);

// Gradient of the map from the cloth to `now` (or to the plain map's `guide`) on one face.
Mat2 sheet_gradient(const Sheet& sheet, std::size_t face);
Mat2 guide_gradient(const Sheet& sheet, std::size_t face);

}  // namespace toile

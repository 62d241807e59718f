// SPDX-License-Identifier: GPL-3.0-or-later
// Tubes of many panels round random forms. Metres.
#pragma once

#include "engine/core/body.h"
#include "engine/core/pattern.h"
#include "tests/support/dice.h"

namespace toile::stress {

struct FormShape {
  double height = 1.0, radius = 0.14;  // m
  double bulge = 0.0, bulge_at = 0.5;  // of the radius; of the height
  double depth = 1.0;                  // front to back over side to side
  int around = 32, rings = 24;
};
Body make_body(const FormShape& shape);
double girth(const FormShape& shape);  // of the cylinder without its bulge, m

struct Patchwork {
  int columns = 2, rows = 1;                                       // panels round and up
  double girth = 0.9, height = 0.5, bottom = 0.3, distance = 0.2;  // m; distance of the flat panels from the axis
  double shear = 0.0;                                              // skew of every panel, radians
  double sliver = 0.0;                                             // width of every third column, m; 0: as the others
  double godet = 0.0;           // base of a needle sewn between the first two columns, m; 0: none
  double short_seam = 0.0;      // length of a seam of its own at the top of every vertical seam, m; 0: none
  bool doubled_points = false;  // hems drawn with every point twice
  double gather = 1.0;          // rows are that much wider than the row below
  Fabric fabric;
};
Pattern make_pattern(const Patchwork& patchwork);

// `wild`: over six decades of stiffness, weight and bending, else one that is sold.
Fabric random_fabric(test::Dice& dice, bool wild);

}  // namespace toile::stress

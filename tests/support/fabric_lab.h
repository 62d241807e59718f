// SPDX-License-Identifier: GPL-3.0-or-later
// A textile laboratory for the fabrics of the library: cantilever, drape meter and tensile strip, simulated with the
// energies garments are draped with. SI units.
#pragma once

#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile::test {

struct Specimen {
  Pattern pattern;
  PatternMesh mesh;
  Drape drape;            // y up
  double residual = 0.0;  // of a mean node weight
};

// ASTM D1388: the overhang at which the line from the edge to the tip falls by 41.5 degrees; half of it is the bending
// length. 2.5 cm wide, `cells` cells along the overhang.
struct Cantilever {
  double overhang = 0.0;        // m, of the simulated strip
  double exact_overhang = 0.0;  // m, of the heavy elastica of the same stiffness and weight
  Specimen specimen;            // at the exact overhang
  double bending_length() const { return 0.5 * overhang; }
};
Cantilever cantilever(const Fabric& fabric, int cells);

// ISO 9073-9: a disc of 30 cm diameter hangs over one of 18 cm. `rings` of nodes lie on the free part.
struct DrapeDrop {
  double coefficient = 0.0;  // (shadow - disc) / (specimen - disc), dimensionless
  int folds = 0;             // maxima of the shadow's radius
  std::vector<Vec2> shadow;  // outline, m
  Specimen specimen;
};
// The `number`th time a specimen is laid on the disc: every specimen twice, with either face up. Each has an unevenness
// of its own, the same on every mesh, and its grain is turned against the mesh.
DrapeDrop drape_drop(const Fabric& fabric, int rings, int number);

// One cloth falls into different numbers of folds from one time to the next, and its coefficient with them: the mean
// of several specimens with either face up is what the standard reports, and what repeated measurements need
// [Jeong1998].
struct DrapeMeter {
  double coefficient = 0.0;  // mean of the drops
  double spread = 0.0;       // standard deviation of one drop
  std::vector<DrapeDrop> drops;
};
DrapeMeter drape_meter(const Fabric& fabric, int rings, int drops = 6);

// A strip of 20 x 5 cm between clamps, pulled along a direction `angle` from the warp (0 warp, pi/2 weft, pi/4 bias) by
// `load`, N per metre of width: its extension, dimensionless.
struct TensileStrip {
  double extension = 0.0;
  Specimen specimen;
};
TensileStrip tensile_strip(const Fabric& fabric, double angle, double load);

// Overhang over (bending stiffness / weight per area)^(1/3) of the heavy elastica whose chord falls by 41.5 degrees.
double elastica_overhang_factor();

}  // namespace toile::test

// SPDX-License-Identifier: GPL-3.0-or-later
// Make a mannequin: a closed human body in A-pose from tape measurements alone.
//
// Missing measurements are completed from published proportions (mannequin_proportions.h); the shape
// (mannequin_shape.h) follows from sex and build; then  measure -> scale the rows of the cage -> measure  until the
// tape agrees:
//   factor <- factor * asked / measured,  measured by measure_body as on any other body.
// All mannequins share their vertices and triangles, so that the map between two of them is exact. Lengths in metres.
#pragma once

#include "engine/core/body.h"
#include "engine/core/record.h"

namespace toile {

// Whose proportions complete the measurements and shape what no tape tells.
enum class Figure {
  Person,  // half way between a woman and a man
  Woman,
  Man,
  Child,  // by height: larger head, shorter legs, neither sex
};

struct MakeMannequinOptions {
  Figure figure = Figure::Person;
  int most_sweeps = 16;        // of measuring and scaling, >= 1
  double close_enough = 1e-3;  // m: stop when every measurement is met within this, > 0
  double tolerance = 5e-3;     // m: refuse when an asked measurement is missed by more, >= close_enough
};

struct MakeMannequinResult {
  Body body;           // with skeleton, landmarks and the measurements taken from its surface
  Record diagnostics;  // sweeps, worst_miss_mm, completed measurements
};

// `asked`: any subset of the names in engine/bodies/measurements.md that shape a mannequin (mannequin_measurements()).
// The bust points are given landmarks of the body: measure_body with them finds the same bust girth.
// Ensures: closed, two-manifold, outward oriented, symmetric about x = 0, soles on y = 0.
// Throws OptionInvalid: unknown name, value no person has, or measurements that no one body can have together.
MakeMannequinResult make_mannequin(const Measurements& asked, const MakeMannequinOptions& options = {});

// The names make_mannequin understands.
std::vector<std::string> mannequin_measurements();

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// What usually goes with a height, a sex and a build: completes a subset of tape measurements. Metres.
#pragma once

#include "engine/bodies/make_mannequin.h"

namespace toile {

// All measurements a mannequin is made to, the asked ones unchanged; without a height, an average one.
//
// Every girth is (average + slope * build) of its figure, scaled with height. The build is the mean over the asked
// girths of how many sizes they lie above the average; a size is 4 cm of bust or chest. Where the numbers come from:
//   women: size 38 at 168 cm, and the steps of the German DOB table (bust = 2 size + 12); men: size 50 at 178 cm
//   (chest = 2 size); children: size = height, chest, waist and hip after European size tables under EN 13402-3;
//   inside leg, neck, limbs and shoulders: chosen by us near the means of ANSUR II [Gordon2014], slimmer than these by
//   up to some centimetres at thigh and arm, since the people measured there are heavier than a size 38 or 50.
Measurements complete_measurements(const Measurements& asked, Figure figure);

// A head against an adult's of the same height, 1 for adults: children's heads are nearly grown. Girth of the skull (49
// cm at 88 cm height, 55 cm at 170 cm) and height from chin to crown (17.5 cm at 90 cm height, 22 cm at 170 cm): growth
// charts.
struct HeadSize {
  double girth = 1.0, height = 1.0;
};
HeadSize head_size(Figure figure, double height);

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Landmarks on the skin and tape measurements of a clean, closed body (a scan is measured through a registered body).
//
// Girths are lengths of convex hulls: a tape bridges hollows. Trunk, thigh, knee and calf are measured in horizontal
// slices, upper arm and wrist across the arm. Names follow ISO 8559-1; engine/bodies/measurements.md defines each.
// Metres, normalised frame.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Levels that the horizontal measurements are taken at, m over the floor.
struct MeasuringLevels {
  double crotch = 0.0;  // lowest point of the trunk between the legs
  double armpit = 0.0;  // where the arms grow onto the trunk, mean of both
  double chest = 0.0, bust = 0.0, underbust = 0.0, waist = 0.0, hip = 0.0, neck = 0.0, thigh = 0.0, knee = 0.0,
         calf = 0.0;
};

struct MeasureBodyResult {
  Landmarks landmarks;        // the 22 named points, those given unchanged
  Measurements measurements;  // m
  MeasuringLevels levels;
};

// `given` landmarks win over found ones and move the levels that hang on them (bust points, crotch).
// Requires the skeleton of this surface (find_skeleton). Throws BodyNotRecognised where a part cannot be sliced.
MeasureBodyResult measure_body(const TriangleMesh& body, const Skeleton& skeleton, const Landmarks& given = {});

// Lowest level at which the mid-plane is closed: by the trunk, or by thighs that press on each other right under it. m.
double find_crotch_level(const TriangleMesh& body, const Skeleton& skeleton);

}  // namespace toile

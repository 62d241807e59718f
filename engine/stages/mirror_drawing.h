// SPDX-License-Identifier: GPL-3.0-or-later
// Make the drawn outlines of mirror images exact mirror images of each other: corners, curves, notches.  Metres.
#pragma once

#include "engine/stages/garment_mirrors.h"

namespace toile {

// `drawn` is a pattern fitted to the symmetric flat positions `rest` (#V x 2) of `mesh`. Of a pair the first panel is
// copied onto the second; a panel with an axis becomes the mean of itself and its image.
void mirror_drawing(const PatternMesh& mesh, const GarmentMirrors& mirrors, const Points2& rest, Pattern& drawn);

}  // namespace toile

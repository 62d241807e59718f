// SPDX-License-Identifier: GPL-3.0-or-later
// The document beside an OBJ garment: seams by texture numbers, placements, labels, toile block. Inner header of io.
#pragma once

#include "engine/io/obj_outlines.h"

namespace toile {

struct NamedSeam {
  int a = 0, b = 0;  // border segments that the two sides begin with, each along its own outline
  bool right_wrong = false;
};

// Cuts the outlines so that every side the sidecar names is one edge. Throws Error{SeamInvalid, FileMalformed}.
std::vector<NamedSeam> apply_sidecar_seams(std::span<const std::uint8_t> sidecar, const ObjIslands& islands,
                                           BorderSegments& borders);

bool sidecar_names_seams(std::span<const std::uint8_t> sidecar);

// Labels, placements and the toile block, once the panels and edges are known.
void apply_sidecar_panels(std::span<const std::uint8_t> sidecar, Pattern& pattern);

}  // namespace toile

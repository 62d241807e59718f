// SPDX-License-Identifier: GPL-3.0-or-later
// Whole jobs by name, shared by tests and benchmarks: a garment, the body it fits and the body it shall fit.
#pragma once

#include <string>
#include <vector>

#include "engine/pipeline_inputs.h"

namespace toile::test {

struct Scene {
  std::string name;
  GarmentInput garment;
  BodyInput reference, target;
  bool fitted = false;  // held to the body all over: positions are not soft
};

// Names that stand for themselves: the shipped "tube_skirt", "leggings", "dress", ... need nothing beside the checkout;
// "leggings_tight", "tshirt_fitted", "dress_sleeveless", "skirt_pencil" (the fitted scenes), "skirt_circle",
// "dress_loose" and "leggings_scan" need ../shared/data.
std::vector<std::string> scene_names();

// One of those, or GARMENT:BODY with names of ../shared/data. Throws Error{NotFound}.
Scene named_scene(const std::string& name);

// A body or scan of ../shared/data. Throws Error{NotFound}.
BodyInput shared_body_input(const std::string& name);

}  // namespace toile::test

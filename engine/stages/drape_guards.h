// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a drape is acceptable: the garment is on, the right way round, where it belongs.
// Source: design/sewing.md, section 6.
#pragma once

#include <string>

#include "engine/bodies/body_guides.h"
#include "engine/stages/classify_panels.h"
#include "engine/stages/drape_quality.h"

namespace toile {

struct DrapeFinding {
  std::string name;  // snake_case: not_finite, inside_body, misplaced, limb_pierces, shoulder_slipped, waist_slipped,
                     // overstretched, crosses_itself, not_at_rest
  std::string message;   // with the measured figure
  bool refused = false;  // the drape cannot be used; else a warning
};

struct GuardScene {
  const PatternMesh& mesh;
  const GarmentClass* garment = nullptr;  // null for a form: no limbs, no shoulders
  const BodyGuides* guides = nullptr;
  std::vector<int> waist;    // nodes held, may be empty
  double hold_height = 0.0;  // m
  bool tangled = false;      // see DrapeDiagnostics
};

// `quality` is that of `drape`. Findings in the order of the names above.
std::vector<DrapeFinding> check_drape(const GuardScene& scene, const Drape& drape, const DrapeQuality& quality);

}  // namespace toile

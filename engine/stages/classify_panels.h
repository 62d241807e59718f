// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of the body each panel dresses: by its label where it has one, else by where it is placed and how its
// seams close. Source: design/sewing.md, section 5.
#pragma once

#include "engine/bodies/body_guides.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

enum class PanelKind { Trunk, Arm, TrouserLeg, Skirt };

struct PanelClass {
  PanelKind kind = PanelKind::Trunk;
  Side side = Left;  // of arms and trouser legs
  bool torso =
      false;  // trunk panel of a bodice: reaches from the bust to above the armpits (not a collar, hood or waistband)
};

struct GarmentClass {
  std::vector<PanelClass> panels;  // one per panel
  bool bodice = false;             // some panel is torso: the shoulders carry the garment
};

// `placed`: #V x 3, pattern vertices where the panels are placed; `guides`: of the body the placement belongs to.
GarmentClass classify_panels(const Pattern& pattern, const PatternMesh& mesh, const Points3& placed,
                             const BodyGuides& guides);

}  // namespace toile

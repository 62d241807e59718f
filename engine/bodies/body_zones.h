// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of the body each triangle of a worn garment covers: the zones that fits are reported by.
//
// Arms by the panel's label or by lying outside the line from the shoulder down through the armpit; the rest by height,
// between the levels of the skeleton. A form without skeleton has one zone.
#pragma once

#include "engine/core/body.h"
#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

enum class BodyZone {
  Whole,  // of a form
  Neck,
  Shoulders,
  Chest,
  Waist,
  Hips,
  Thighs,
  Knees,
  Calves,
  LeftUpperArm,
  RightUpperArm,
  LeftForearm,
  RightForearm,
};
inline constexpr int kBodyZoneCount = 13;
std::string_view zone_name(BodyZone zone);  // "neck", "left_upper_arm", ...

// One per triangle of the mesh, judged by its middle on `drape`, which is worn by `body`.
std::vector<BodyZone> body_zones(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape, const Body& body);

}  // namespace toile

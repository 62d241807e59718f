// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of the shape of every side while a pattern is derived: locked, straight, the leg of a dart.
#pragma once

#include "engine/stages/garment_mirrors.h"

namespace toile {

struct SideRule {
  bool sewn = false;
  bool locked = false;    // keeps its shape: of a locked panel or edge, or with a zip
  bool straight = false;  // stays a straight line
  int dart_tip = -1;      // leg of a dart: the corner number where its two legs meet; else -1
};

using SideRules = std::vector<std::vector<SideRule>>;  // per panel and edge

// Straight are the sides labelled so and, where `keep_straight`, the lines on folds, of hems and other unsewn edges, of
// darts, and along the grain. What holds for a side holds for its mirror image too.
SideRules side_rules(const Pattern& pattern, const GarmentMirrors& mirrors, bool keep_straight);

// Whether a panel is locked, or its mirror image is.
bool panel_locked(const Pattern& pattern, const GarmentMirrors& mirrors, int panel);

}  // namespace toile

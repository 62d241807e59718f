// SPDX-License-Identifier: GPL-3.0-or-later
// One picture of several views side by side, to one scale, with title, captions, marks and legend.
#pragma once

#include "engine/render/scene.h"

namespace toile {

// A circle with a word, drawn in the one view that sees it most squarely; none where it is hidden from all.
struct Mark {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // outside of the surface there
  std::string text;
};

struct SheetOptions {
  std::vector<View> views = {View::Front, View::Back, View::Left, View::Right};
  Box frame;                            // what is seen; m. Empty: nothing is framed and the views are blank
  int view_height = 720;                // pixels, 16..4096; the scale follows from it ...
  int max_view_width = 720;             // ... unless a view would grow wider than this
  std::string title;                    // above the views, may be empty
  std::optional<double> stretch_scale;  // legend of stretch_colour() at this scale, dimensionless
  std::vector<Mark> marks;              // in order of importance ...
  int marks_drawn = 1000;               // ... of which at most so many that can be seen are drawn
  int supersample = 2;                  // 1..4
};

Image contact_sheet(const std::vector<Surface>& surfaces, const SheetOptions& options);

}  // namespace toile

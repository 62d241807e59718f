// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a body, a garment on it, or its panels as they are placed, as PNG bytes: views from up to four sides to
// one scale, with a colour per triangle and a legend. Same input, same bytes.
#pragma once

#include "engine/core/body.h"
#include "engine/core/drape.h"
#include "engine/core/fitting_map.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/render/contact_sheet.h"

namespace toile {

enum class Framing {
  Garment,  // the garment with a margin; the body is cut off there. The body, if there is no garment
  Body,     // body and garment, whole
};

struct ViewOptions {
  std::vector<View> views = {View::Front, View::Back, View::Left, View::Right};
  Framing framing = Framing::Garment;
  std::optional<Box> frame;     // overrides `framing`: give one box to all pictures that are compared
  double margin = 0.05;         // round what is framed, m, >= 0
  int view_height = 720;        // pixels
  int max_view_width = 720;     // pixels
  double stretch_scale = 0.10;  // full red or blue at this signed stretch, dimensionless, > 0; one for a whole job
  bool legend = true;           // for stretch colours
  int marks = 0;                // mark this many of the largest stretches that can be seen, at least 10 cm apart
  const FittingMap* reference = nullptr;  // marks show the difference from this fit of the same mesh instead
  std::string title;
};

// The body in skin colour and the garment: coloured by the fitting map's signed stretch where a map is given, else a
// colour per panel; seams and hems as dark lines. Any pointer may be null; mesh and drape only together.
// Throws Error{Internal} if the drape or the map does not belong to the mesh.
Bytes render_views(const TriangleMesh* body, const PatternMesh* mesh, const Drape* drape, const FittingMap* map,
                   const ViewOptions& options);

// The same as pixels.
Image draw_views(const TriangleMesh* body, const PatternMesh* mesh, const Drape* drape, const FittingMap* map,
                 const ViewOptions& options);

// The flat panels where the pattern places them round the body, a colour each.
Bytes render_placed_panels(const TriangleMesh* body, const Pattern& pattern, const PatternMesh& mesh,
                           const ViewOptions& options);

}  // namespace toile

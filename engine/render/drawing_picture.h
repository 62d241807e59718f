// SPDX-License-Identifier: GPL-3.0-or-later
// A drawing as a picture: pieces side by side, filled softly, with their lines, notches and labels.
#pragma once

#include "engine/core/drawing.h"
#include "engine/render/image.h"

namespace toile {

// Triangles painted over a piece beneath its lines, e.g. the fitting map on flat panels. Millimetres, the piece's
// frame.
struct PiecePaint {
  Points2 vertices;          // #V x 2, mm
  Triangles triangles;       // #F x 3
  std::vector<Rgb> colours;  // one per triangle
};

struct DrawingPictureOptions {
  int width = 1400;                     // pixels, 64..8192; the height follows
  std::vector<PiecePaint> paint;        // one per piece, or empty
  std::optional<double> stretch_scale;  // legend of stretch_colour(), dimensionless
  std::string title;
};

Image draw_picture(const Drawing& drawing, const DrawingPictureOptions& options = {});

}  // namespace toile

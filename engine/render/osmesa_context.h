// SPDX-License-Identifier: GPL-3.0-or-later
// Off-screen rasterisation of coloured triangles and lines with a depth buffer. Colours are final: shading is done by
// the caller (scene.h), so that pixels do not hang on a driver's lighting.
#pragma once

#include "engine/render/image.h"

namespace toile {

// Triangle and line corners in the view volume: x to the right, y up, z towards the viewer, each from -1 to 1. What
// lies outside is clipped; of two surfaces the one with larger z is seen.
struct RasterBatch {
  std::vector<float> triangle_positions;       // 9 per triangle
  std::vector<std::uint8_t> triangle_colours;  // 9 per triangle, interpolated
  std::vector<float> line_positions;           // 6 per segment
  std::vector<std::uint8_t> line_colours;      // 6 per segment
  double line_width = 1.0;                     // pixels
};

// Each thread keeps one context for its life (16 ms to make). A process that forks must not have rasterised before: the
// library's worker threads do not survive in the child.
// Throws Error{Internal} if no context can be had, Error{LimitExceeded} for sides above 8192 pixels.
Image rasterise(const RasterBatch& batch, int width, int height, Rgb background);

}  // namespace toile

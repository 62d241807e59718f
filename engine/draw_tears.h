// SPDX-License-Identifier: GPL-3.0-or-later
// Draw how an alteration was found: one frame per panel and round of tears, the cloth as it lies stretched over the
// outline it is to take, coloured by its strain [Eggler2024, Fig. 12]. Insertions: the old cloth on the wanted outline;
// removals: the wanted cloth on the old outline. Millimetres.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/render/drawing_picture.h"

namespace toile {

struct TearDrawing {
  Drawing drawing;                // a piece per frame, all of one height, so that pictures keep their order
  std::vector<PiecePaint> paint;  // one per piece: stretch along the fibre that is stretched more
  double stretch_scale = 0.0;     // of the colours: twice the allowed stretch
};

TearDrawing draw_tears(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                       const AlterPatternResult& altered, const AlterPatternOptions& options);

// The same as a picture.
Image picture_of_tears(const TearDrawing& tears);

}  // namespace toile

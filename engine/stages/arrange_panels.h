// SPDX-License-Identifier: GPL-3.0-or-later
// Move the flat panels round a body, before anything is sewn, so that every limb lies inside its flat tube.
//
// Only translations and shifts: torso over the shoulders, skirts and legs up to their torso, sleeves and trouser legs
// centred on the limb station by station, seam nodes out of the body within their panels' planes. 5 closed-form steps.
// Source: design/sewing.md D. Metres.
#pragma once

#include "engine/geometry/distance_field.h"
#include "engine/stages/classify_panels.h"

namespace toile {

struct ArrangeOptions {
  double lift = 0.015;       // m added to the height of the upper part once its shoulder seams clear the body, 0..0.1
  double thickness = 0.003;  // of contact, m: how far out of the body seam nodes are brought
};

struct ArrangeResult {
  Points3 nodes;              // #N x 3, welded
  double upper_shift = 0.0;   // m the torso was raised in all
  bool at_limit = false;      // the best height lay at the end of the range searched: the garment does not belong here
  double waist_height = 0.0;  // m the labelled waist line hangs at after arranging; 0 without a label or with a bodice
};

// Points where the panels are placed, #V x 3.
Points3 placed_vertices(const Pattern& pattern, const PatternMesh& mesh);
// Mean over the vertices of each node, #N x 3.
Points3 welded(const PatternMesh& mesh, const Points3& vertices);

// Nodes of the edges labelled lower_interface; without any, of the highest unsewn edges.
std::vector<int> waist_nodes(const Pattern& pattern, const PatternMesh& mesh, const Points3& vertices);

// The garment's openings: nodes of its unsewn edges, one list for each connected line (hems, neckline, cuffs, waist).
std::vector<std::vector<int>> free_lines(const Pattern& pattern, const PatternMesh& mesh);

// `levels`: of the body that the placement belongs to; the same as `guides.levels` on the garment's own body.
ArrangeResult arrange_panels(const Pattern& pattern, const PatternMesh& mesh, const GarmentClass& garment,
                             const BodyGuides& guides, const BodyLevels& levels, SignedField& field,
                             const ArrangeOptions& options);

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles for one sampled panel outline: plain, mirrored about its own axis, or as the mirror image of another panel.
#pragma once

#include <optional>

#include "engine/geometry/mesh_polygon.h"
#include "engine/stages/panel_boundary.h"
#include "engine/stages/panel_mirrors.h"

namespace toile {

// All three: points are the boundary's first, in its order; triangles are counter-clockwise in the panel plane.
PolygonMesh mesh_panel(const PanelBoundary& boundary, double edge_length);

// One half is meshed and reflected. Empty when the samples do not mirror each other or the axis leaves the panel.
std::optional<PolygonMesh> mesh_symmetric_panel(const PanelBoundary& boundary, const PanelMirror& mirror,
                                                double edge_length);

// The mesh of the source panel, reflected. Empty when the samples of the two boundaries do not mirror each other.
std::optional<PolygonMesh> mirrored_mesh(const PanelBoundary& boundary, const PanelMirror& mirror,
                                         const PanelBoundary& source_boundary, const PolygonMesh& source_mesh);

// Splits every inner edge whose two ends are the same point once sewn, so that no triangle loses a corner by sewing.
// `sewn_as` gives boundary vertices that become one the same number.
void split_pinched_edges(PolygonMesh& mesh, const std::vector<int>& sewn_as);

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Garments and bodies whose answers are known in closed form: tubes, and a sheet. Metres, built in code.
#pragma once

#include <functional>

#include "engine/core/body.h"
#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile::test {

using RadiusOfHeight = std::function<double(double y)>;

// Closed surface of revolution about the y axis from y = 0 to `height`, caps included; its first (rings + 1) x around
// vertices lie ring by ring from the bottom, vertex j of a ring at angle 2 pi j / around from +z towards +x. Two bodies
// of the same counts correspond vertex by vertex.
Body tube_body(const std::string& name, const RadiusOfHeight& radius, double height, int around = 96, int rings = 48);
Body tube_body(const std::string& name, double radius, double height, int around = 96, int rings = 48);

// Two rectangles girth / 2 wide, "front" at z = +distance and "back" at z = -distance (turned by 180 degrees about y),
// right sides out, lower edge at `bottom_y`; sewn to each other along both sides. Edges: 0 hem, 1 right, 2 waist
// (labelled lower_interface), 3 left.
Pattern tube_skirt_pattern(double girth, double height, double bottom_y, double distance);

// One rectangle hanging in the plane z = 0, upper edge (edge 2) at y = top_y; not sewn.
Pattern sheet_pattern(double width, double height, double top_y);

// Regular mesh of a pattern of rectangles (corners counter-clockwise from the lower left): every panel becomes columns
// x rows cells of two triangles, diagonals alternating; seams are welded vertex by vertex.
PatternMesh structured_mesh(const Pattern& rectangles, int columns, int rows);

// Nodes where the placement of the panels puts them (mean over the vertices of a node): #N x 3.
Points3 placed_nodes(const Pattern& pattern, const PatternMesh& mesh);

// The tube skirt wrapped round the y axis: rest position (s, t) goes to angle 2 pi s / girth, height bottom_y + t *
// stretch_y.
Drape wrapped_tube(const Pattern& tube, const PatternMesh& mesh, const RadiusOfHeight& radius, double bottom_y,
                   double stretch_y = 1.0);

}  // namespace toile::test

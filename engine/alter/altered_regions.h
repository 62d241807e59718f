// SPDX-License-Identifier: GPL-3.0-or-later
// One altered panel as it will be sewn: the wanted panel parted into kept cloth and insertions that share their
// borders.
//
// Where cloth is cut open the kept cloth turns in one seam allowance, so the border lies that far inside it and the
// insertion is that much wider; where a seam is unpicked the old allowance serves and the border stays. What the seam
// allowance gives stays with the kept cloth. A cut where cloth is taken away is a seam of the cloth with itself. Used
// by sew_altered only.   Lengths in metres, all places in the wanted panel.
#pragma once

#include <compare>

#include "engine/alter/alter_pattern.h"

namespace toile {

// A line along which a panel is sewn or ends: an edge of the original pattern, or one lip of a cut.
struct BorderTrack {
  int edge = -1;      // of the panel, or
  int cut = -1;       // of the removing pass, with its
  bool left = false;  // lip
  auto operator<=>(const BorderTrack&) const = default;
};

// From one point of a region's border to the next.
struct RegionBorder {
  int from = 0, to = 0;  // points
  int neighbour = -1;    // region on the other side; -1: the border runs along `track`
  BorderTrack track;
  double at_from = 0.0, at_to = 0.0;  // places on the track: number of the mesh vertex along the edge and the share
                                      // of the way to the next one; arc length along a cut, m
  bool operator==(const RegionBorder&) const = default;
};

struct AlteredPart {
  int insertion = -1;              // number in PanelAlteration::insertions; -1: kept cloth
  std::vector<RegionBorder> loop;  // counter-clockwise
};

struct AlteredParts {
  std::vector<Vec2> points;
  std::vector<AlteredPart> parts;
  std::vector<bool> corner;  // per point: a border turns or ends here, so that pieces must have a corner
  std::string problem;       // why the panel cannot be parted, or empty
};

// `let_out`: per insertion, whether the seam allowance gives it. `trims`: slivers of less than a millimetre go to what
// lies beside them.
AlteredParts part_altered_panel(const PatternMesh& mesh, const Points2& target_rest, const Sheet& inserting,
                                const Sheet& removing, const PanelAlteration& alteration,
                                const std::vector<bool>& let_out, double turn_in, bool trims = false);

// The wanted panel in one piece, its borders along its edges.
AlteredParts whole_panel(const PatternMesh& mesh, const Points2& target_rest, const std::vector<Vec2>& wanted,
                         int panel);

}  // namespace toile

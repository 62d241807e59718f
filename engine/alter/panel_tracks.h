// SPDX-License-Identifier: GPL-3.0-or-later
// Which edge of a panel, or which cut, a piece of border runs along, and where on it. Used by altered_regions only.
// Lengths in metres, in the wanted panel.
#pragma once

#include "engine/alter/altered_regions.h"

namespace toile {

class PanelTracks {
 public:
  PanelTracks(const PatternMesh& mesh, const Points2& target_rest, int panel);

  // Both fill the track and the two places; false, when a-b does not run there.
  bool along_edge(const Vec2& a, const Vec2& b, RegionBorder& border) const;
  bool along_cut(const Sheet& sheet, std::size_t cut, const Vec2& a, const Vec2& b, double reach,
                 RegionBorder& border) const;
  // The same whatever the distance.
  void nearest_edge(const Vec2& a, const Vec2& b, RegionBorder& border) const;

 private:
  bool along_edge_within(const Vec2& a, const Vec2& b, double reach, RegionBorder& border) const;

  std::vector<std::vector<Vec2>> edges_;  // from start to end as in the pattern; empty where collapsed
};

}  // namespace toile

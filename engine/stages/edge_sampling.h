// SPDX-License-Identifier: GPL-3.0-or-later
// Where along every panel edge the mesh has vertices, such that both sides of a seam pair up.
//
// Edges sewn to each other share one list of arc-length fractions, n = round(mean length / h) even steps between
// notches; sides shorter than h / 4 collapse into one vertex, unless that left their panel fewer than three sides.
// Lengths in metres.
#pragma once

#include <vector>

#include "engine/core/pattern.h"
#include "engine/stages/panel_mirrors.h"

namespace toile {

struct EdgeSamples {
  bool collapsed = false;  // the whole edge is one vertex
  std::vector<double>
      fractions;  // of the arc length from the edge's start, ascending, with 0 and 1; empty if collapsed
};

class EdgeSampling {
 public:
  // Symmetric panels get a vertex where an edge crosses their mirror axis.
  EdgeSampling(const Pattern& pattern, const PanelMirrors& mirrors, double edge_length);

  EdgeSamples samples(PanelId panel, int edge) const;
  int segment_count(PanelId panel, int edge) const;
  // Twice as many vertices on this edge and on what is sewn to it; a collapsed edge is opened again.
  void refine(PanelId panel, int edge);

 private:
  // A seam, or an edge that is not sewn. `breaks` are the fractions along its first side that must be vertices, with
  // 0 and 1; `steps[i]` even steps lie between breaks i and i + 1.
  struct Group {
    double length = 0.0;  // mean of the sides, and of their mirror images
    bool collapsed = false;
    std::vector<double> breaks = {0.0, 1.0};
    std::vector<int> steps;
  };
  struct Place {
    int group = -1;
    bool backwards = false;  // runs against the group's first side
  };

  void collect_groups(const Pattern& pattern);
  void share_mirrored_lengths(const PanelMirrors& mirrors);
  void add_breaks(const Pattern& pattern, const PanelMirrors& mirrors, double edge_length);
  void collapse_short_groups(const Pattern& pattern, double edge_length);
  void keep_three_sides(const Pattern& pattern);
  void open_closed_loops(const Pattern& pattern);
  void fill_small_panels(const Pattern& pattern);
  Group& group_of(int panel, int edge);
  const Group& group_of(int panel, int edge) const;
  Place& place(int panel, int edge) { return places_[static_cast<std::size_t>(panel)][static_cast<std::size_t>(edge)]; }

  std::vector<Group> groups_;
  std::vector<std::vector<Place>> places_;  // per panel and edge
};

}  // namespace toile

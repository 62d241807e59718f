// SPDX-License-Identifier: GPL-3.0-or-later
// Draw a moved pattern mesh as a pattern again: the original panels with their corners and curves carried along.
//
// Every edge keeps its type (line, Bézier, arc) and its place in the numbering; its curve is fitted to where the mesh
// vertices along it went. Hems, darts, fold lines and edges along the grain stay straight when they were (or as
// labelled); another edge that its type cannot follow within the tolerance becomes a cubic Bézier, or at worst a
// polyline. Then the least change of corners and curves restores the length ratio of sewn sides. Mirror images are
// drawn as mirror images. Notches, grainlines and keep-out regions follow; the middle of a panel's corners stays over
// the place on the floor where it is placed.  Lengths in metres.
#pragma once

#include "engine/stages/garment_mirrors.h"

namespace toile {

struct FitPatternEdgesOptions {
  double tolerance = 0.5e-3;       // m; an edge keeps its type if it passes its mesh vertices this near, > 0
  double cubic_tolerance = 30e-3;  // m; as a cubic it may pass them this far away before it becomes a polyline, > 0
  bool keep_straight =
      true;  // straight hems, darts, folds and edges along the grain stay so wherever their vertices went
  bool smooth_corners = true;    // edges leave corners as the cloth there is carried, and run on where they ran on
  bool keep_seam_ratios = true;  // sewn sides keep the ratio of their lengths
};

struct FitPatternEdgesResult {
  Pattern pattern;
  std::vector<std::vector<double>> deviation;  // per panel and edge: farthest mesh vertex from its edge, m
  double largest_deviation = 0.0;              // m, over all edges
  double largest_seam_mismatch = 0.0;          // m, of a sewn side from its length in the original ratio
  int bent_edges = 0;                          // edges that became cubic Béziers because their type could not follow
  int polyline_edges = 0;                      // edges that no cubic could follow: a polyline through the mesh vertices
};

// Requires: `mesh` is the mesh of `original`; `target_rest` (#V x 2) are its moved rest positions; `mirrors` of both,
// or empty. Ensures: the same panels, edges, seams and labels in the same order.
FitPatternEdgesResult fit_pattern_edges(const Pattern& original, const PatternMesh& mesh, const Points2& target_rest,
                                        const GarmentMirrors& mirrors = {}, const FitPatternEdgesOptions& options = {});

}  // namespace toile

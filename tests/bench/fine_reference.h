// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene comes to on a much finer mesh with a tight residual, and how far a coarser answer is from it. Points are
// compared where they lie in the cloth: the flat pattern is the same for all meshes. Metres.
#pragma once

#include "engine/pipeline.h"
#include "engine/stages/drape_held.h"
#include "tests/support/scenes.h"

namespace toile::bench {

// What one point of a Pareto front is computed with.
struct Accuracy {
  int triangles = 10000;
  double stop_residual = 0.3;  // of both drapes and those of the derivation, in mean node weights
  SolverKind solver = SolverKind::Default;
  double stop_settled = DrapeOptions().stop_settled;       // 0: only stop_residual counts
  int coarse_triangles = DrapeOptions().coarse_triangles;  // 0: the reference drape is sought from flat on its own mesh
};

// Bodies and map of a scene: made once, the same for all accuracies.
struct SceneBodies {
  Pattern pattern;
  Body reference, target;
  BodyMap map;
};
SceneBodies read_scene(const test::Scene& scene);

struct Answer {
  PatternMesh mesh;
  Drape reference_drape, target_drape;
  Points2 target_rest;     // the derived pattern, #V x 2
  double cpu_s = 0.0;      // of meshing, draping, transport and derivation
  HeldDrape held = {};     // the reference drape
  double residual = 0.0;   // of the reference drape
  double hem_girth = 0.0;  // of the reference drape, m
};
Answer answer(const SceneBodies& scene, const Accuracy& accuracy);

// The same rest state on triangles cut into four: the reference drape goes on from the end of that of `coarse` with its
// friction and its waist's height held, all else follows from it. The accuracy's number of triangles is not used.
Answer refined(const SceneBodies& scene, const Answer& coarse, const Accuracy& accuracy);

// Stretch is compared with the mean of the fine fitting map over each coarse triangle.
struct AnswerError {
  double stretch = 0.0;           // rms of weft and warp of the reference drape's fitting map, dimensionless
  double triangle_stretch = 0.0;  // the same of each triangle's own, not recovered from its neighbours'
  double position = 0.0;          // rms of the reference drape's nodes, m
  double pattern = 0.0;  // rms of the derived outlines, each panel moved onto the other without deforming it, m
  double hem = 0.0;      // difference of the heights of the lowest node, m
  double girth = 0.0;    // difference of the girths of the lowest opening, m
};
AnswerError compare(const Answer& fine, const Answer& coarse);

// What a tape round the lowest opening measures, m.
double hem_girth(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape);

}  // namespace toile::bench

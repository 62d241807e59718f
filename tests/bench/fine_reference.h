// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene comes to on a much finer mesh with a tight residual, and how far a coarser answer is from it. Points are
// compared where they lie in the cloth: the flat pattern is the same for all meshes. Metres.
#pragma once

#include "engine/pipeline.h"
#include "tests/support/scenes.h"

namespace toile::bench {

// What one point of a Pareto front is computed with.
struct Accuracy {
  int triangles = 10000;
  double stop_residual = 0.3;  // of both drapes and those of the derivation, in mean node weights
  SolverKind solver = SolverKind::Default;
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
  Points2 target_rest;  // the derived pattern, #V x 2
  double cpu_s = 0.0;   // of meshing, draping, transport and derivation
};
Answer answer(const SceneBodies& scene, const Accuracy& accuracy);

struct AnswerError {
  double stretch = 0.0;            // rms of weft and warp of the reference drape, dimensionless
  double recovered_stretch = 0.0;  // the same of the stretch recovered from neighbouring triangles
  double position = 0.0;           // rms of the reference drape's nodes, m
  double pattern = 0.0;  // rms of the derived outlines, each panel moved onto the other without deforming it, m
  double hem = 0.0;      // difference of the heights of the lowest node, m
};
AnswerError compare(const Answer& fine, const Answer& coarse);

}  // namespace toile::bench

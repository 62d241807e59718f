// SPDX-License-Identifier: GPL-3.0-or-later
// Everything a user may choose for a job, under the names of `--options`, of job requests and of result.json. Each
// option has its one default here; schemas/options.schema.json repeats it and a test compares the two.
// Stages have option structs of their own; engine/pipeline.cpp fills them from these.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace toile {

enum class TearWeights { Release, Boundary, Greedy };
enum class CutKind { Straight, MeshEdges };
enum class SymmetryMode { Auto, Plane, Off };
enum class SolverKind { Default, Pbd, Newton };
enum class Preset { Draft, Standard, Fine };
enum class SelfContact { Auto, On, Off };

struct AlterOptions {
  int max_tears_per_side = 1;    // Theta: alterations per panel side over the whole run, 0..5     [Eggler2024, Eq. 2]
  double seam_preference = 1.5;  // gamma: favours existing seams, 1..10                           [Eggler2024, Eq. 4]
  double stretch_limit = 0.03;   // mu: stretch the altered cloth may keep, 0.005..0.3         [Eggler2024, Sec. 6.2]
  bool l_shapes = false;         // adjacent sides of a panel may both be released                 [Eggler2024, Eq. 5]
  double cut_smoothness = 0.5;   // alpha: smoothing of cut directions along a mesh-edge cut, 0..1
  TearWeights tear_weights = TearWeights::Release;  // how a candidate is valued
  CutKind cuts = CutKind::Straight;
  double min_strip_mm = 15.0;  // narrowest insertion worth sewing, 0..100
  double min_change_mm = 4.0;  // changes below are marked, 0..20                                [ISO20685]
  SymmetryMode symmetry = SymmetryMode::Auto;
  bool pin_extremities =
      false;                 // hold cuffs and hems where the body map puts them while draping [Eggler2024, Sec. 4.1]
  int physics_passes = 3;    // at most, in the derivation, 1..5
  int alteration_plans = 3;  // at most, until the altered garment lies in its place, 1..5
  SolverKind solver = SolverKind::Default;
  double fibre_slack = 0.0;       // delta, of the position-based solver: stretch a fibre gives for nothing, 0..0.2
  double shear_limit_deg = 12.0;  // rho, of the position-based solver, 0..45
  Preset preset = Preset::Standard;
  std::optional<int> triangles;  // of the garment, 500..200000; empty: the preset's
  SelfContact self_contact = SelfContact::Auto;
  std::vector<std::string> outputs = {"all"};  // names of files, or "all": only what is asked for is made
};

// Triangles of the garment for these options.
inline int garment_triangles(const AlterOptions& options) {
  if (options.triangles) return *options.triangles;
  switch (options.preset) {
    case Preset::Draft: return 4000;
    case Preset::Standard: return 10000;
    case Preset::Fine: return 22000;
  }
  return 10000;
}

}  // namespace toile

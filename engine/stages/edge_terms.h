// SPDX-License-Identifier: GPL-3.0-or-later
// Outline edges of a flat mesh whose length or shape is prescribed while a pattern is derived: the local half of
// sum_e |e(U) - t_e|^2. Used by derive_pattern only.
#pragma once

#include "engine/stages/side_rules.h"

namespace toile {

// The vector from pattern vertex `from` to `to`, and the one wanted for it.
struct EdgeTerm {
  int from = 0, to = 0;
  double stiffness = 1.0;  // against that of other terms
  Vec2 wanted = Vec2::Zero();
};

// Sewn edges in pairs keep their length ratio; straight sides and locked sides keep their shape; straight darts stay
// open: their legs may close, but not cross.
class EdgeTerms {
 public:
  EdgeTerms(const Pattern& pattern, const PatternMesh& mesh, const SideRules& rules);

  // Best wanted vectors for the positions `rest`: the minimum over each family's own freedom, so that the energy falls.
  void update(const Points2& rest);
  const std::vector<EdgeTerm>& terms() const { return terms_; }

  double energy(const Points2& rest) const;         // sum of stiffness |e - t|^2, m^2
  double pair_residual(const Points2& rest) const;  // largest |la - r lb| over sewn pairs of mesh edges, m
  double side_residual(const Points2& rest) const;  // largest |La - r Lb| over whole sewn sides, m

 private:
  struct Pair {
    int a, b;        // terms
    double ratio;    // |a| / |b| in the reference pattern
    double fixed_a;  // length of a locked ply, or 0
    double fixed_b;
    int seam;
  };
  struct Run {  // of consecutive terms along one side
    int begin, end;
    bool rigid;               // keeps its shape; else only straight
    std::vector<Vec2> shape;  // reference vectors of a rigid run
  };
  struct Dart {  // two straight runs
    int to_tip, from_tip;
    double side;  // +1: the panel lies to the left of its outline
  };
  struct Line {  // the common direction that keeps most of a run's vectors, and how much is lost beside it
    double angle, sharpness;
  };

  void add_seams(const Pattern& pattern, const PatternMesh& mesh, const SideRules& rules);
  void add_runs(const PatternMesh& mesh, const SideRules& rules, int panel);
  int add_run(const std::vector<int>& vertices, const Points2& rest, bool rigid);
  void update_pair(const Points2& rest, const Pair& pair);
  void turn_rigid(const Points2& rest, const Run& run);
  Line line_through(const Points2& rest, const Run& run) const;
  void straighten(const Points2& rest, const Run& run, double angle);
  void open_dart(const Points2& rest, const Dart& dart);

  std::vector<EdgeTerm> terms_;
  std::vector<Pair> pairs_;
  std::vector<Run> runs_;
  std::vector<Dart> darts_;
  std::vector<double> seam_ratio_;  // whole sides, reference |a| / |b|
};

}  // namespace toile

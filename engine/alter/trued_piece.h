// SPDX-License-Identifier: GPL-3.0-or-later
// One piece whose sewn edges are brought to given lengths.
//
// Unknown: where every point of the piece lies flat.  Minimise
//   sum_f A_f |C_f - I|^2 / 4  +  w sum_e (|e| - l_e)^2 / l_e  +  h sum_v A_v |x - x_before|^2
// with C_f the metric of the map from where the piece lies before, e the edges of the border with a wanted length; by
// Gauss-Newton on a coarse mesh. Used by true_seams only.   Lengths in metres.
#pragma once

#include <Eigen/Sparse>

#include "engine/alter/sewn_borders.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {

class TruedPiece {
 public:
  // Lies before where `border.rest` and `map.rest` have it, each of its warp and weft times `scale`. `is_new`: not cut
  // out of the original cloth.
  TruedPiece(const PieceBorder& border, const PieceMap& map, const Vec2& scale, bool is_new, double edge_length);

  // A chain of the border shall be so long.
  void want(const BorderChain& chain, double length);
  // Moves border and map. Leaves both and returns false, when the outline would cross itself.
  bool give(PieceBorder& border, PieceMap& map);

 private:
  struct Edge {
    int from, to;
    double length;
  };
  bool fit();
  double step();
  void add_row(std::initializer_list<std::pair<int, Vec2>> row, double residual);
  void add_metric(Eigen::Index f);
  const Vec2& before(int v) const { return before_[static_cast<std::size_t>(v)]; }

  double hold_, farthest_;
  Points2 target_;                          // of the mesh's points, in the wanted panel
  std::vector<Vec2> start_, before_, now_;  // flat: as handed in, scaled, trued
  Triangles triangles_;
  std::vector<int> first_;  // per vertex of the border: of the mesh
  int border_count_ = 0;
  std::vector<Edge> edges_;
  std::vector<double> area_;  // per point
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_;
  SparseSolver solver_;
};

}  // namespace toile

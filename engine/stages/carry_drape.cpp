// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/carry_drape.h"

#include "engine/geometry/flat_locator.h"
#include "engine/sim/cloth.h"

namespace toile {
namespace {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// #N of `to` x #N of `from`; rows sum to 1.
RowMatrix weights_between(const PatternMesh& from, const PatternMesh& to) {
  Eigen::VectorXd copies = Eigen::VectorXd::Zero(to.node_count);
  for (const int n : to.node_of_vertex) copies[n] += 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < to.panels.size(); ++p) {
    const PanelRange& range = from.panels[p];
    const Triangles triangles =
        from.triangles.middleRows(range.triangle_begin, range.triangle_end - range.triangle_begin);
    const FlatLocator locator(from.rest, triangles);
    for (int v = to.panels[p].vertex_begin; v < to.panels[p].vertex_end; ++v) {
      const FlatPlace place = locator.extended(to.rest.row(v));
      const int node = to.node_of_vertex[static_cast<std::size_t>(v)];
      for (int k = 0; k < 3; ++k)
        entries.emplace_back(node, from.node_of_vertex[static_cast<std::size_t>(triangles(place.triangle, k))],
                             place.weights[k] / copies[node]);
    }
  }
  RowMatrix weights(to.node_count, from.node_count);
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

FrictionState carry_friction(const RowMatrix& weights, const Points3& nodes, const FrictionState& friction,
                             const Points3& carried, const Eigen::VectorXd& area, const Eigen::VectorXd& carried_area) {
  Points3 slip = nodes - friction.anchor, normal = friction.normal;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    if (friction.load[i] <= 0) slip.row(i).setZero(), normal.row(i).setZero();
  FrictionState result;
  result.load = (weights * friction.load.cwiseQuotient(area)).cwiseMax(0.0).cwiseProduct(carried_area);
  result.anchor = carried - weights * slip;
  result.normal = weights * normal;
  for (Eigen::Index i = 0; i < carried.rows(); ++i) {
    const double length = result.normal.row(i).norm();
    if (length > 0)
      result.normal.row(i) /= length;
    else
      result.load[i] = 0;
  }
  return result;
}

}  // namespace

DrapeEnd carry_drape(const Pattern& pattern, const PatternMesh& from, const DrapeEnd& end, const PatternMesh& to) {
  const RowMatrix weights = weights_between(from, to);
  DrapeEnd result;
  result.drape.nodes = weights * end.drape.nodes;
  result.held.hold_height = end.held.hold_height;
  result.held.friction = carry_friction(weights, end.drape.nodes, end.held.friction, result.drape.nodes,
                                        make_cloth(pattern, from).node_area, make_cloth(pattern, to).node_area);
  return result;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/catmull_clark.h"

#include <algorithm>
#include <map>
#include <vector>

namespace toile {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

struct Edges {
  std::map<std::pair<int, int>, int> number;  // by rising end points, so that the order depends on nothing else
  std::vector<std::array<int, 2>> ends;
  std::vector<std::array<int, 2>> quads;  // the two beside it
};

Edges find_edges(const Quads& quads) {
  Edges edges;
  for (int q = 0; q < quads.rows(); ++q) {
    for (int k = 0; k < 4; ++k) {
      const auto [a, b] = std::minmax<int>(quads(q, k), quads(q, (k + 1) % 4));
      const auto [entry, fresh] = edges.number.try_emplace({a, b}, static_cast<int>(edges.ends.size()));
      if (fresh) {
        edges.ends.push_back({a, b});
        edges.quads.push_back({q, q});
      } else {
        edges.quads[static_cast<std::size_t>(entry->second)][1] = q;
      }
    }
  }
  return edges;
}

std::vector<int> valences(const Edges& edges, int point_count) {
  std::vector<int> valence(static_cast<std::size_t>(point_count), 0);
  for (const auto& ends : edges.ends)
    for (const int end : ends) ++valence[static_cast<std::size_t>(end)];
  return valence;
}

// Weights of a point by its valence n: itself, each edge neighbour, each point across a quad.
struct PointWeights {
  double self, edge, across;
};

// The stencil of every control point from its one-ring.
void add_points(Entries& entries, const Quads& quads, const Edges& edges, const std::vector<int>& valence,
                PointWeights (*weights)(int)) {
  const auto at = [&](int point) { return weights(valence[static_cast<std::size_t>(point)]); };
  for (int p = 0; p < static_cast<int>(valence.size()); ++p) entries.emplace_back(p, p, at(p).self);
  for (const auto& [a, b] : edges.ends) {
    entries.emplace_back(a, b, at(a).edge);
    entries.emplace_back(b, a, at(b).edge);
  }
  for (int q = 0; q < quads.rows(); ++q)
    for (int k = 0; k < 4; ++k) entries.emplace_back(quads(q, k), quads(q, (k + 2) % 4), at(quads(q, k)).across);
}

// Refined point v' = (n - 7/4)/n v + 3/(2 n^2) sum of neighbours + 1/(4 n^2) sum of points across.
PointWeights refined_weights(int n) {
  return {1.0 - 7.0 / (4.0 * n), 1.5 / (n * n), 0.25 / (n * n)};
}

// Limit point (n^2 v + 4 sum of neighbours + sum of points across) / (n (n + 5)).
PointWeights limit_weights(int n) {
  const double whole = n * (n + 5.0);
  return {n / (n + 5.0), 4.0 / whole, 1.0 / whole};
}

PointStencils stencils(const Entries& entries, Eigen::Index rows, int columns) {
  PointStencils matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

RefinedQuads refine_catmull_clark(const Quads& quads, int point_count) {
  const Edges edges = find_edges(quads);
  const int edge_count = static_cast<int>(edges.ends.size()), first_quad_point = point_count + edge_count;
  Entries entries;
  add_points(entries, quads, edges, valences(edges, point_count), refined_weights);
  for (int e = 0; e < edge_count; ++e) {  // both ends and the middles of both quads, a quarter each
    const auto& [ends, beside] =
        std::pair(edges.ends[static_cast<std::size_t>(e)], edges.quads[static_cast<std::size_t>(e)]);
    for (const int end : ends) entries.emplace_back(point_count + e, end, 0.25);
    for (const int q : beside)
      for (int k = 0; k < 4; ++k) entries.emplace_back(point_count + e, quads(q, k), 0.0625);
  }
  RefinedQuads fine;
  fine.quads.resize(4 * quads.rows(), 4);
  for (int q = 0; q < quads.rows(); ++q) {
    const auto middle = [&](int k) {
      return point_count + edges.number.at(std::minmax<int>(quads(q, k % 4), quads(q, (k + 1) % 4)));
    };
    for (int k = 0; k < 4; ++k) {
      entries.emplace_back(first_quad_point + q, quads(q, k), 0.25);
      // Turned so that the coarse quad's first diagonal goes on in its first and third quarter.
      std::array<int, 4> quarter = {quads(q, k), middle(k), first_quad_point + q, middle(k + 3)};
      if (k % 2 == 1) std::rotate(quarter.begin(), quarter.begin() + 1, quarter.end());
      fine.quads.row(4 * q + k) << quarter[0], quarter[1], quarter[2], quarter[3];
    }
  }
  fine.points = stencils(entries, first_quad_point + quads.rows(), point_count);
  return fine;
}

PointStencils catmull_clark_limit(const Quads& quads, int point_count) {
  const Edges edges = find_edges(quads);
  Entries entries;
  add_points(entries, quads, edges, valences(edges, point_count), limit_weights);
  return stencils(entries, point_count, point_count);
}

Points3 interpolating_control_points(const PointStencils& limit, const Points3& wanted, int sweeps) {
  Points3 control = wanted;
  for (int sweep = 0; sweep < sweeps; ++sweep) control += wanted - limit * control;
  return control;
}

}  // namespace toile

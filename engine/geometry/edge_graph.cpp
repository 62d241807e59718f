// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/edge_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

namespace toile {
namespace {
std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
}  // namespace

EdgeGraph::EdgeGraph(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> keys;
  keys.reserve(at(mesh.triangle_count()) * 3);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int e = 0; e < 3; ++e) {
      const auto a = static_cast<std::uint32_t>(mesh.triangles(f, e));
      const auto b = static_cast<std::uint32_t>(mesh.triangles(f, (e + 1) % 3));
      keys.push_back(static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b));
    }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  edges_.reserve(keys.size());
  for (const std::uint64_t key : keys)
    edges_.push_back({static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)});

  begin_.assign(at(mesh.vertex_count()) + 1, 0);
  for (const auto& [a, b] : edges_) ++begin_[at(a) + 1], ++begin_[at(b) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  neighbour_.resize(edges_.size() * 2);
  length_.resize(edges_.size() * 2);
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  const auto add = [&](int from, int to, double length) {
    const int slot = next[at(from)]++;
    neighbour_[at(slot)] = to;
    length_[at(slot)] = length;
  };
  // Edges are sorted by their smaller vertex, so every list comes out ascending: first the smaller, then the larger.
  for (const auto& [a, b] : edges_) add(b, a, (mesh.vertices.row(a) - mesh.vertices.row(b)).norm());
  for (const auto& [a, b] : edges_) add(a, b, (mesh.vertices.row(a) - mesh.vertices.row(b)).norm());
}

std::span<const int> EdgeGraph::neighbours(int vertex) const {
  return std::span(neighbour_).subspan(at(begin_[at(vertex)]), at(begin_[at(vertex) + 1] - begin_[at(vertex)]));
}

Eigen::VectorXd EdgeGraph::distances(std::span<const int> sources) const {
  Eigen::VectorXd distance =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(begin_.size()) - 1, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;  // ties fall to the smaller vertex: the order is the same every time
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const int s : sources) distance[s] = 0.0, open.emplace(0.0, s);
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    for (int k = begin_[at(v)]; k < begin_[at(v) + 1]; ++k) {
      const int n = neighbour_[at(k)];
      const double through = d + length_[at(k)];
      if (through < distance[n]) distance[n] = through, open.emplace(through, n);
    }
  }
  return distance;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/half_edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace toile {

namespace {

struct EdgeKey {
  std::uint64_t vertices;  // the lower one in the high word
  int half_edge;
  bool operator<(const EdgeKey& other) const {
    return vertices != other.vertices ? vertices < other.vertices : half_edge < other.half_edge;
  }
};

// Counted out by their lower vertices first: what is left to sort are a handful of edges at each.
std::vector<EdgeKey> sorted_edges(const Triangles& triangles) {
  if (triangles.rows() == 0) return {};
  const int count = static_cast<int>(triangles.rows()) * 3;
  const auto lower = [&](int h) {
    return static_cast<std::size_t>(std::min(half_edge_start(triangles, h), half_edge_end(triangles, h)));
  };
  std::vector<int> begin(static_cast<std::size_t>(triangles.maxCoeff()) + 2, 0);
  for (int h = 0; h < count; ++h) ++begin[lower(h) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<EdgeKey> keys(static_cast<std::size_t>(count));
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (int h = 0; h < count; ++h) {
    const auto a = static_cast<std::uint64_t>(half_edge_start(triangles, h));
    const auto b = static_cast<std::uint64_t>(half_edge_end(triangles, h));
    keys[static_cast<std::size_t>(next[lower(h)]++)] = {std::min(a, b) << 32 | std::max(a, b), h};
  }
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) std::sort(keys.begin() + begin[v], keys.begin() + begin[v + 1]);
  return keys;
}

int find_root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    auto& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

void join(std::vector<int>& parent, int a, int b) {
  a = find_root(parent, a), b = find_root(parent, b);
  parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

}  // namespace

HalfEdges find_half_edges(const Triangles& triangles) {
  const std::vector<EdgeKey> keys = sorted_edges(triangles);
  HalfEdges edges;
  edges.opposite.assign(keys.size(), HalfEdges::kBoundary);
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && keys[end].vertices == keys[begin].vertices) ++end;
    if (end - begin == 2) {
      edges.opposite[static_cast<std::size_t>(keys[begin].half_edge)] = keys[begin + 1].half_edge;
      edges.opposite[static_cast<std::size_t>(keys[begin + 1].half_edge)] = keys[begin].half_edge;
    } else if (end - begin > 2) {
      for (std::size_t i = begin; i < end; ++i)
        edges.opposite[static_cast<std::size_t>(keys[i].half_edge)] = HalfEdges::kTangled;
    }
  }
  return edges;
}

std::vector<int> corner_fans(const Triangles& triangles, const HalfEdges& edges) {
  std::vector<int> fan(edges.opposite.size());
  std::iota(fan.begin(), fan.end(), 0);
  for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h) {
    const int other = edges.opposite[static_cast<std::size_t>(h)];
    if (other <= h) continue;
    const bool twisted = edges.is_twisted(triangles, h);
    join(fan, h, twisted ? other : next_half_edge(other));
    join(fan, next_half_edge(h), twisted ? next_half_edge(other) : other);
  }
  for (int c = 0; c < static_cast<int>(fan.size()); ++c) fan[static_cast<std::size_t>(c)] = find_root(fan, c);
  return fan;
}

std::vector<std::vector<int>> boundary_loops(const Triangles& triangles, const HalfEdges& edges) {
  std::vector<int> onward(static_cast<std::size_t>(triangles.maxCoeff()) + 1, -1);  // vertex -> open half-edge
  for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h)
    if (edges.opposite[static_cast<std::size_t>(h)] == HalfEdges::kBoundary)
      onward[static_cast<std::size_t>(half_edge_start(triangles, h))] = h;
  std::vector<std::vector<int>> loops;
  for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h) {
    if (edges.opposite[static_cast<std::size_t>(h)] != HalfEdges::kBoundary) continue;
    int vertex = half_edge_start(triangles, h);
    if (onward[static_cast<std::size_t>(vertex)] != h) continue;  // walked before
    std::vector<int> loop;
    while (onward[static_cast<std::size_t>(vertex)] >= 0) {
      loop.push_back(vertex);
      const int step = std::exchange(onward[static_cast<std::size_t>(vertex)], -1);
      vertex = half_edge_end(triangles, step);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

SurfaceDefects find_defects(int vertex_count, const Triangles& triangles) {
  const HalfEdges edges = find_half_edges(triangles);
  SurfaceDefects defects;
  for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h) {
    const int other = edges.opposite[static_cast<std::size_t>(h)];
    defects.open_edges += other == HalfEdges::kBoundary;
    defects.twisted_edges += other > h && edges.is_twisted(triangles, h);
  }
  const std::vector<EdgeKey> keys = sorted_edges(triangles);
  for (std::size_t i = 2; i < keys.size(); ++i)  // one for each edge: where its third triangle comes
    defects.tangled_edges +=
        keys[i].vertices == keys[i - 2].vertices && (i < 3 || keys[i].vertices != keys[i - 3].vertices);
  const std::vector<int> fans = corner_fans(triangles, edges);
  std::vector<int> fan_count(static_cast<std::size_t>(vertex_count), 0);
  for (int c = 0; c < static_cast<int>(fans.size()); ++c)
    if (fans[static_cast<std::size_t>(c)] == c)
      defects.pinched_vertices += ++fan_count[static_cast<std::size_t>(half_edge_start(triangles, c))] == 2;
  return defects;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/clean_mesh.h"

#include <algorithm>
#include <utility>

#include "engine/geometry/components.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/mend_slivers.h"
#include "engine/geometry/position_index.h"

namespace toile {

namespace {

// A mesh in which more than this share of the triangles has an opposite twin is a two-sided export: one side is kept.
constexpr double kTwoSided = 0.25;
// An open piece of fewer triangles than this share of the largest piece's is debris, however large its triangles are.
constexpr double kStrayShare = 0.01;
// Removing triangles can expose new tangles only where many sheets meet; real scans need one or two rounds.
constexpr int kMaxRounds = 8;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

void keep_triangles(Triangles& triangles, const std::vector<bool>& keep) {
  int kept = 0;
  for (int f = 0; f < triangles.rows(); ++f)
    if (keep[at(f)]) triangles.row(kept++) = triangles.row(f).eval();
  triangles.conservativeResize(kept, 3);
}

int remove_repeated_corners(Triangles& triangles) {
  const auto before = triangles.rows();
  std::vector<bool> keep(at(static_cast<int>(before)));
  for (int f = 0; f < before; ++f)
    keep[at(f)] =
        triangles(f, 0) != triangles(f, 1) && triangles(f, 1) != triangles(f, 2) && triangles(f, 2) != triangles(f, 0);
  keep_triangles(triangles, keep);
  return static_cast<int>(before - triangles.rows());
}

struct CornerSet {
  std::array<std::int32_t, 3> corners;  // rising
  bool even;                            // whether the triangle runs through them in rising order
  int triangle;
  bool operator<(const CornerSet& other) const {
    return corners != other.corners ? corners < other.corners : triangle < other.triangle;
  }
};

std::vector<CornerSet> sorted_corner_sets(const Triangles& triangles) {
  std::vector<CornerSet> sets;
  sets.reserve(at(static_cast<int>(triangles.rows())));
  for (int f = 0; f < triangles.rows(); ++f) {
    std::array<std::int32_t, 3> c = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    bool even = true;
    for (auto [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)})
      if (c[at(i)] > c[at(j)]) std::swap(c[at(i)], c[at(j)]), even = !even;
    sets.push_back({c, even, f});
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

// Copies of a triangle go but for one. Two opposite triangles on the same corners are a fold without volume and go
// both, unless the whole mesh is drawn from both sides.
int remove_duplicates(Triangles& triangles) {
  const std::vector<CornerSet> sets = sorted_corner_sets(triangles);
  std::vector<bool> keep(sets.size(), true);
  std::vector<int> folds;
  int removed = 0;
  for (std::size_t begin = 0, end = 0; begin < sets.size(); begin = end) {
    bool opposite = false;
    for (; end < sets.size() && sets[end].corners == sets[begin].corners; ++end) {
      if (end == begin) continue;
      keep[at(sets[end].triangle)] = false;
      opposite = opposite || sets[end].even != sets[begin].even;
      ++removed;
    }
    if (opposite) folds.push_back(sets[begin].triangle);
  }
  if (static_cast<double>(folds.size()) < kTwoSided * static_cast<double>(sets.size()))
    for (const int f : folds) keep[at(f)] = false, ++removed;
  keep_triangles(triangles, keep);
  return removed;
}

// Only vertices of open edges are merged: where the surface is closed, points that touch are separate places of it.
int weld_open_vertices(const Points3& vertices, Triangles& triangles) {
  const HalfEdges edges = find_half_edges(triangles);
  std::vector<bool> open(at(static_cast<int>(vertices.rows())), false);
  for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h)
    if (edges.opposite[at(h)] == HalfEdges::kBoundary)
      open[at(half_edge_start(triangles, h))] = open[at(half_edge_end(triangles, h))] = true;
  PositionIndex positions;
  std::vector<int> first_vertex;
  std::vector<int> merged(open.size());
  int welded = 0;
  for (int v = 0; v < vertices.rows(); ++v) {
    merged[at(v)] = v;
    if (!open[at(v)]) continue;
    const int number = positions.add(vertices.row(v).transpose());
    if (number == static_cast<int>(first_vertex.size())) first_vertex.push_back(v);
    merged[at(v)] = first_vertex[at(number)];
    welded += merged[at(v)] != v;
  }
  if (welded == 0) return 0;
  for (int f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) triangles(f, k) = merged[at(triangles(f, k))];
  return welded;
}

// Removes the triangles of which some half-edge answers to `is_bad`.
template <class IsBad>
int remove_triangles_at(Triangles& triangles, const HalfEdges& edges, IsBad is_bad) {
  std::vector<bool> keep(at(static_cast<int>(triangles.rows())), true);
  int removed = 0;
  for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h)
    if (is_bad(h) && keep[at(h / 3)]) keep[at(h / 3)] = false, ++removed;
  if (removed > 0) keep_triangles(triangles, keep);
  return removed;
}

// Walks over each piece from its first triangle and turns what disagrees; then turns the piece back if the greater part
// was turned. Returns the number of turned triangles.
int agree_in_orientation(Triangles& triangles, const HalfEdges& edges) {
  const int count = static_cast<int>(triangles.rows());
  std::vector<signed char> turn(at(count), -1);
  std::vector<int> piece;
  int turned = 0;
  for (int seed = 0; seed < count; ++seed) {
    if (turn[at(seed)] >= 0) continue;
    piece.assign(1, seed);
    turn[at(seed)] = 0;
    int turned_here = 0;
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (int h = 3 * piece[i]; h < 3 * piece[i] + 3; ++h) {
        const int other = edges.opposite[at(h)];
        if (other < 0 || turn[at(other / 3)] >= 0) continue;
        turn[at(other / 3)] = static_cast<signed char>(turn[at(piece[i])] ^ (edges.is_twisted(triangles, h) ? 1 : 0));
        turned_here += turn[at(other / 3)];
        piece.push_back(other / 3);
      }
    if (2 * turned_here > static_cast<int>(piece.size())) {
      for (const int f : piece) turn[at(f)] ^= 1;
      turned_here = static_cast<int>(piece.size()) - turned_here;
    }
    turned += turned_here;
  }
  for (int f = 0; f < count; ++f)
    if (turn[at(f)] == 1) std::swap(triangles(f, 1), triangles(f, 2));
  return turned;
}

void make_oriented(Triangles& triangles, CleanMeshReport& report) {
  for (int round = 0; round < kMaxRounds; ++round) {
    HalfEdges edges = find_half_edges(triangles);
    const int tangled =
        remove_triangles_at(triangles, edges, [&](int h) { return edges.opposite[at(h)] == HalfEdges::kTangled; });
    report.tangled_triangles += tangled;
    if (tangled > 0) edges = find_half_edges(triangles);
    const int turned = agree_in_orientation(triangles, edges);
    report.flipped_triangles += turned;
    if (turned > 0) edges = find_half_edges(triangles);
    const int one_sided = remove_triangles_at(triangles, edges, [&](int h) { return edges.is_twisted(triangles, h); });
    report.one_sided_triangles += one_sided;
    if (one_sided == 0) return;
  }
}

// Where fans meet in a point at the rim of a hole, only the largest stays: split apart they would leave two points in
// one place. Returns the number of triangles removed.
int remove_open_fans(Triangles& triangles, int vertex_count) {
  const HalfEdges edges = find_half_edges(triangles);
  const std::vector<int> fans = corner_fans(triangles, edges);
  std::vector<int> size(fans.size(), 0), largest(at(vertex_count), -1);
  std::vector<bool> open(fans.size(), false);
  for (int c = 0; c < static_cast<int>(fans.size()); ++c) {
    const int fan = fans[at(c)], before = c % 3 == 0 ? c + 2 : c - 1;
    ++size[at(fan)];
    if (edges.opposite[at(c)] < 0 || edges.opposite[at(before)] < 0) open[at(fan)] = true;
  }
  for (int c = 0; c < static_cast<int>(fans.size()); ++c) {
    int& best = largest[at(half_edge_start(triangles, c))];
    if (fans[at(c)] == c && (best < 0 || size[at(c)] > size[at(best)])) best = c;
  }
  std::vector<bool> keep(at(static_cast<int>(triangles.rows())), true);
  for (int c = 0; c < static_cast<int>(fans.size()); ++c)
    if (open[at(fans[at(c)])] && fans[at(c)] != largest[at(half_edge_start(triangles, c))]) keep[at(c / 3)] = false;
  const int removed = static_cast<int>(std::count(keep.begin(), keep.end(), false));
  if (removed > 0) keep_triangles(triangles, keep);
  return removed;
}

int split_pinched_vertices(TriangleMesh& mesh) {
  const std::vector<int> fans = corner_fans(mesh.triangles, find_half_edges(mesh.triangles));
  std::vector<int> fan_of_vertex(at(mesh.vertex_count()), -1);
  std::vector<int> vertex_of_fan(fans.size(), -1);
  std::vector<int> origin;
  for (int c = 0; c < static_cast<int>(fans.size()); ++c) {
    if (fans[at(c)] != c) continue;
    const int v = half_edge_start(mesh.triangles, c);
    const bool first = fan_of_vertex[at(v)] < 0;
    if (first) fan_of_vertex[at(v)] = c;
    vertex_of_fan[at(c)] = first ? v : mesh.vertex_count() + static_cast<int>(origin.size());
    if (!first) origin.push_back(v);
  }
  if (origin.empty()) return 0;
  const int before = mesh.vertex_count();
  mesh.vertices.conservativeResize(before + static_cast<int>(origin.size()), 3);
  for (std::size_t i = 0; i < origin.size(); ++i)
    mesh.vertices.row(before + static_cast<int>(i)) = mesh.vertices.row(origin[i]).eval();
  for (int c = 0; c < static_cast<int>(fans.size()); ++c) mesh.triangles(c / 3, c % 3) = vertex_of_fan[at(fans[at(c)])];
  return static_cast<int>(origin.size());
}

// Which pieces are the surface: large enough, and either closed or of more than a few stray triangles.
std::vector<bool> worthy_pieces(const TriangleMesh& mesh, const MeshComponents& pieces, double share) {
  const HalfEdges edges = find_half_edges(mesh.triangles);
  std::vector<int> size(pieces.area.size(), 0);
  std::vector<bool> closed(pieces.area.size(), true), worthy(pieces.area.size());
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const std::size_t piece = at(pieces.of_triangle[at(f)]);
    ++size[piece];
    for (int h = 3 * f; h < 3 * f + 3; ++h) closed[piece] = closed[piece] && edges.opposite[at(h)] >= 0;
  }
  for (std::size_t i = 0; i < worthy.size(); ++i)
    worthy[i] = pieces.area[i] >= share * pieces.area.front() && (closed[i] || size[i] >= kStrayShare * size.front());
  return worthy;
}

void remove_specks(TriangleMesh& mesh, double share, CleanMeshReport& report) {
  const MeshComponents pieces = find_components(mesh);
  if (pieces.area.size() < 2) return;
  const std::vector<bool> worthy = worthy_pieces(mesh, pieces, share);
  std::vector<bool> keep(at(mesh.triangle_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f) keep[at(f)] = worthy[at(pieces.of_triangle[at(f)])];
  report.specks += static_cast<int>(std::count(worthy.begin(), worthy.end(), false));
  report.speck_triangles += static_cast<int>(std::count(keep.begin(), keep.end(), false));
  keep_triangles(mesh.triangles, keep);
}

int count_unused_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(at(mesh.vertex_count()), false);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) used[at(mesh.triangles(f, k))] = true;
  return static_cast<int>(std::count(used.begin(), used.end(), false));
}

}  // namespace

CleanMeshReport clean_mesh(TriangleMesh& mesh, const CleanMeshOptions& options) {
  CleanMeshReport report;
  report.unused_vertices = count_unused_vertices(mesh);
  report.repeated_corners = remove_repeated_corners(mesh.triangles);
  report.welded_vertices = weld_open_vertices(mesh.vertices, mesh.triangles);
  if (report.welded_vertices > 0) report.repeated_corners += remove_repeated_corners(mesh.triangles);
  report.duplicate_triangles = remove_duplicates(mesh.triangles);
  make_oriented(mesh.triangles, report);
  for (int round = 0, removed = 1; removed > 0 && round < kMaxRounds; ++round) {
    removed = remove_open_fans(mesh.triangles, mesh.vertex_count());
    report.pinched_triangles += removed;
  }
  report.split_vertices = split_pinched_vertices(mesh);
  remove_specks(mesh, options.speck_area, report);
  report.slivers = mend_slivers(mesh, options.sliver_height);
  if (count_unused_vertices(mesh) > 0)
    mesh = extract_triangles(mesh, std::vector<bool>(at(mesh.triangle_count()), true));
  return report;
}

int orient_outward(TriangleMesh& mesh) {
  const MeshComponents pieces = find_components(mesh);
  std::vector<double> volume(pieces.area.size(), 0.0);
  const Vec3 centre = mesh.vertices.colwise().mean().transpose();
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.triangles(f, 0)).transpose() - centre;
    volume[at(pieces.of_triangle[at(f)])] += a.dot(triangle_cross(mesh, f));
  }
  int turned = 0;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    if (volume[at(pieces.of_triangle[at(f)])] >= 0) continue;
    std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
    ++turned;
  }
  return turned;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/mend_slivers.h"

#include <algorithm>
#include <vector>

namespace toile {

namespace {

constexpr int kMaxPasses = 6;        // a collapse can leave a neighbour flat; real meshes need one or two
constexpr double kShortEdge = 0.01;  // of the mean edge length: collapsing it moves nothing that can be seen

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

class SliverMender {
 public:
  SliverMender(TriangleMesh& mesh, double height) : mesh_(mesh) {
    for (int f = 0; f < mesh_.triangle_count(); ++f)
      for (int k = 0; k < 3; ++k) mean_edge_ += edge_length(f, k);
    mean_edge_ /= std::max(1, 3 * mesh_.triangle_count());
    height_ = height * mean_edge_;
  }

  int run() {
    int mended = 0;
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      std::vector<int> slivers;
      for (int f = 0; f < mesh_.triangle_count(); ++f)
        if (is_sliver(f)) slivers.push_back(f);
      if (slivers.empty()) break;
      collect_triangles_of_vertices();
      int mended_now = 0;
      for (const int f : slivers) mended_now += mend(f);
      drop_removed();
      mended += mended_now;
      if (mended_now == 0) break;
    }
    return mended;
  }

 private:
  Vec3 corner(int f, int k) const { return mesh_.vertices.row(mesh_.triangles(f, k % 3)).transpose(); }
  double edge_length(int f, int k) const { return (corner(f, k + 1) - corner(f, k)).norm(); }

  bool is_sliver(int f) const {
    const double twice_area = (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).norm();
    const double longest = std::max({edge_length(f, 0), edge_length(f, 1), edge_length(f, 2)});
    return twice_area < height_ * longest || longest <= height_;
  }

  void collect_triangles_of_vertices() {
    around_.assign(at(mesh_.vertex_count()), {});
    touched_.assign(at(mesh_.vertex_count()), false);
    removed_.assign(at(mesh_.triangle_count()), false);
    for (int f = 0; f < mesh_.triangle_count(); ++f)
      for (int k = 0; k < 3; ++k) around_[at(mesh_.triangles(f, k))].push_back(f);
  }

  std::vector<int> neighbours(int v) const {
    std::vector<int> found;
    for (const int f : around_[at(v)])
      for (int k = 0; k < 3; ++k)
        if (mesh_.triangles(f, k) != v) found.push_back(mesh_.triangles(f, k));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  bool on_boundary(int v, const std::vector<int>& near) const { return near.size() != around_[at(v)].size(); }

  bool mend(int f) {
    for (int k = 0; k < 3; ++k)
      if (touched_[at(mesh_.triangles(f, k))]) return false;  // the next pass looks again
    int shortest = 0, longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (edge_length(f, k) < edge_length(f, shortest)) shortest = k;
      if (edge_length(f, k) > edge_length(f, longest)) longest = k;
    }
    if (edge_length(f, shortest) < kShortEdge * mean_edge_) return collapse(f, shortest);
    return flip(f, longest) || collapse(f, shortest);
  }

  // Keeps the vertex of lower number. Allowed when the two ends share no neighbours but those across the edge.
  bool collapse(int f, int k) {
    int a = mesh_.triangles(f, k), b = mesh_.triangles(f, (k + 1) % 3);
    if (a > b) std::swap(a, b);
    const std::vector<int> near_a = neighbours(a), near_b = neighbours(b);
    std::vector<int> shared, both;
    std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(), std::back_inserter(shared));
    std::set_union(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(), std::back_inserter(both));
    const auto across =
        std::count_if(around_[at(b)].begin(), around_[at(b)].end(), [&](int g) { return has_vertex(g, a); });
    if (static_cast<std::ptrdiff_t>(shared.size()) != across || both.size() <= 4) return false;
    if (across == 2 && on_boundary(a, near_a) && on_boundary(b, near_b)) return false;
    for (const int v : both) touched_[at(v)] = true;
    for (const int g : around_[at(b)]) {
      if (has_vertex(g, a)) removed_[at(g)] = true;
      for (int i = 0; i < 3; ++i)
        if (mesh_.triangles(g, i) == b) mesh_.triangles(g, i) = a;
    }
    return true;
  }

  // Replaces edge ab of triangles abc and bad by cd.
  bool flip(int f, int k) {
    const int a = mesh_.triangles(f, k), b = mesh_.triangles(f, (k + 1) % 3), c = mesh_.triangles(f, (k + 2) % 3);
    int g = -1, d = -1;
    for (const int other : around_[at(a)])
      for (int i = 0; i < 3; ++i)
        if (other != f && mesh_.triangles(other, i) == b && mesh_.triangles(other, (i + 1) % 3) == a)
          g = other, d = mesh_.triangles(other, (i + 2) % 3);
    if (g < 0 || touched_[at(d)]) return false;
    const std::vector<int> near_c = neighbours(c);
    if (std::binary_search(near_c.begin(), near_c.end(), d)) return false;
    mesh_.triangles.row(f) << c, a, d;
    mesh_.triangles.row(g) << d, b, c;
    for (const int v : {a, b, c, d}) touched_[at(v)] = true;
    return true;
  }

  bool has_vertex(int f, int v) const { return (mesh_.triangles.row(f).array() == v).any(); }

  void drop_removed() {
    int kept = 0;
    for (int f = 0; f < mesh_.triangle_count(); ++f)
      if (!removed_[at(f)]) mesh_.triangles.row(kept++) = mesh_.triangles.row(f).eval();
    mesh_.triangles.conservativeResize(kept, 3);
  }

  TriangleMesh& mesh_;
  double mean_edge_ = 0.0, height_ = 0.0;
  std::vector<std::vector<int>> around_;  // vertex -> triangles
  std::vector<bool> touched_;             // vertices whose surroundings changed in this pass
  std::vector<bool> removed_;             // triangles
};

}  // namespace

int mend_slivers(TriangleMesh& mesh, double height) {
  return SliverMender(mesh, height).run();
}

}  // namespace toile

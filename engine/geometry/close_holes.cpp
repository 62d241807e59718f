// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/close_holes.h"

#include <algorithm>
#include <set>

#include "engine/geometry/fair_vertices.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/hole_patch.h"
#include "engine/geometry/hole_triangulation.h"

namespace toile {

namespace {

// A patch is not refined beyond this many points: a body cut in half is closed coarsely rather than for seconds.
constexpr int kMaxPatchPoints = 20'000;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

class HoleCloser {
 public:
  HoleCloser(TriangleMesh& mesh, const CloseHolesOptions& options) : mesh_(mesh), options_(options) {}

  std::vector<ClosedHole> run(Progress* progress) {
    if (mesh_.triangle_count() == 0) return {};
    const HalfEdges edges = find_half_edges(mesh_.triangles);
    const std::vector<std::vector<int>> loops = boundary_loops(mesh_.triangles, edges);
    if (loops.empty()) return {};
    collect_loop_facts(edges, loops);
    const int first_new = mesh_.vertex_count();
    std::vector<ClosedHole> closed;
    for (const std::vector<int>& loop : loops) {
      check_cancelled(progress);
      closed.push_back(close(loop));
    }
    append();
    std::vector<int> moving;
    for (int v = first_new; v < mesh_.vertex_count(); ++v) moving.push_back(v);
    fair_vertices(mesh_, moving);
    for (const int v : moving) mesh_.vertices(v, 1) = std::max(mesh_.vertices(v, 1), options_.lowest_y);
    return closed;
  }

 private:
  Vec3 position(int v) const { return mesh_.vertices.row(v).transpose(); }

  // Per loop vertex: which vertices it is joined to, mean length of its edges; per open edge: the normal across it.
  void collect_loop_facts(const HalfEdges& edges, const std::vector<std::vector<int>>& loops) {
    on_loop_.assign(at(mesh_.vertex_count()), -1);
    int count = 0;
    for (const auto& loop : loops)
      for (const int v : loop) on_loop_[at(v)] = count++;
    neighbours_.resize(at(count));
    outer_normal_.assign(at(count), Vec3::Zero());
    for (int h = 0; h < static_cast<int>(edges.opposite.size()); ++h) {
      const int a = half_edge_start(mesh_.triangles, h), b = half_edge_end(mesh_.triangles, h);
      if (on_loop_[at(a)] >= 0) neighbours_[at(on_loop_[at(a)])].push_back(b);
      if (on_loop_[at(b)] >= 0) neighbours_[at(on_loop_[at(b)])].push_back(a);
      if (edges.opposite[at(h)] == HalfEdges::kBoundary) outer_normal_[at(on_loop_[at(a)])] = normal(h / 3);
    }
    for (auto& list : neighbours_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  Vec3 normal(int f) const {
    const Vec3 a = position(mesh_.triangles(f, 0));
    return (position(mesh_.triangles(f, 1)) - a).cross(position(mesh_.triangles(f, 2)) - a).stableNormalized();
  }

  double spacing(int v) const {
    double sum = 0.0;
    const auto& near = neighbours_[at(on_loop_[at(v)])];
    for (const int other : near) sum += (position(other) - position(v)).norm();
    return sum / static_cast<double>(near.size());
  }

  // Points in the same place (where fans were split) count as joined: an edge between them would have no length.
  bool joined(int a, int b) const {
    if (mesh_.vertices.row(a) == mesh_.vertices.row(b)) return true;
    const auto& near = neighbours_[at(on_loop_[at(a)])];
    return std::binary_search(near.begin(), near.end(), b);
  }

  ClosedHole close(const std::vector<int>& boundary) {
    // New triangles run against the open half-edges.
    const std::vector<int> loop(boundary.rbegin(), boundary.rend());
    const int n = static_cast<int>(loop.size());
    HoleLoop hole;
    HolePatch patch;
    ClosedHole report;
    for (int i = 0; i < n; ++i) {
      const int v = loop[at(i)], next = loop[at((i + 1) % n)];
      hole.points.push_back(position(v));
      hole.normals.push_back(outer_normal_[at(on_loop_[at(next)])]);
      patch.spacing.push_back(spacing(v));
      report.perimeter += (position(next) - position(v)).norm();
      report.centre += position(v) / n;
    }
    hole.joined = [&](int i, int k) { return joined(loop[at(i)], loop[at(k)]); };
    patch.points = hole.points;
    patch.loop_size = n;
    patch.joined = hole.joined;
    patch.triangles = triangulate_hole(hole);
    if (patch.triangles.empty()) fan_from_centre(patch, report.centre);
    refine_patch(patch, n + kMaxPatchPoints);
    keep_patch(patch, loop);
    report.edges = n;
    report.added_vertices = static_cast<int>(patch.points.size()) - n;
    report.added_triangles = static_cast<int>(patch.triangles.size());
    return report;
  }

  // Always possible: a new vertex is joined to nothing yet.
  static void fan_from_centre(HolePatch& patch, const Vec3& centre) {
    double mean = 0.0;
    for (const double s : patch.spacing) mean += s / patch.loop_size;
    patch.points.push_back(centre);
    patch.spacing.push_back(mean);
    for (int i = 0; i < patch.loop_size; ++i)
      patch.triangles.emplace_back(i, (i + 1) % patch.loop_size, patch.loop_size);
  }

  void keep_patch(const HolePatch& patch, const std::vector<int>& loop) {
    const int first_new = mesh_.vertex_count() + static_cast<int>(new_points_.size());
    const auto vertex = [&](int i) { return i < patch.loop_size ? loop[at(i)] : first_new + i - patch.loop_size; };
    new_points_.insert(new_points_.end(), patch.points.begin() + patch.loop_size, patch.points.end());
    for (const Eigen::Vector3i& t : patch.triangles)
      new_triangles_.emplace_back(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  }

  void append() {
    const int old_vertices = mesh_.vertex_count(), old_triangles = mesh_.triangle_count();
    mesh_.vertices.conservativeResize(old_vertices + static_cast<int>(new_points_.size()), 3);
    for (std::size_t i = 0; i < new_points_.size(); ++i)
      mesh_.vertices.row(old_vertices + static_cast<int>(i)) = new_points_[i].transpose();
    mesh_.triangles.conservativeResize(old_triangles + static_cast<int>(new_triangles_.size()), 3);
    for (std::size_t i = 0; i < new_triangles_.size(); ++i)
      mesh_.triangles.row(old_triangles + static_cast<int>(i)) = new_triangles_[i].transpose();
  }

  TriangleMesh& mesh_;
  CloseHolesOptions options_;
  std::vector<int> on_loop_;  // vertex -> number among loop vertices, -1 elsewhere
  std::vector<std::vector<int>> neighbours_;
  std::vector<Vec3> outer_normal_;  // loop vertex -> normal of the triangle at the open half-edge that starts there
  std::vector<Vec3> new_points_;
  std::vector<Eigen::Vector3i> new_triangles_;
};

}  // namespace

std::vector<ClosedHole> close_holes(TriangleMesh& mesh, const CloseHolesOptions& options, Progress* progress) {
  return HoleCloser(mesh, options).run(progress);
}

}  // namespace toile

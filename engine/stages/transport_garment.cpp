// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/transport_garment.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "engine/core/units.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/surface_operators.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {
namespace {

Vec3 interpolate(const Points3& values, const Eigen::Vector3i& corners, const Vec3& weights) {
  return weights[0] * values.row(corners[0]).transpose() + weights[1] * values.row(corners[1]).transpose() +
         weights[2] * values.row(corners[2]).transpose();
}

// Moves nodes that are nearer than `clearance` to the outside of the surface, and counts them.
struct PushOut {
  int pushed = 0;
  double deepest = 0.0;

  void apply(const SurfaceTree& tree, const TriangleMesh& surface, double clearance, Points3& nodes) {
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      const Vec3 p = nodes.row(i);
      const SurfacePoint nearest = tree.closest_point(p);
      const bool inside = tree.winding_number(p) > 0;
      if (!inside && nearest.distance() >= clearance) continue;
      const Eigen::Vector3i corners = surface.triangles.row(nearest.triangle);
      const Vec3 a = surface.vertices.row(corners[0]), b = surface.vertices.row(corners[1]),
                 c = surface.vertices.row(corners[2]);
      const Vec3 normal = (b - a).cross(c - a).normalized();
      nodes.row(i) = (nearest.point + clearance * normal).transpose();
      ++pushed;
      if (inside) deepest = std::max(deepest, nearest.distance());
    }
  }
};

// Where neighbours' closest points are farther apart than they are themselves by this factor, the body bends away from
// them as under a bust: what carries one does not carry the other.
constexpr double kJump = 1.5;
constexpr double kJumpTrust = 0.01;
constexpr double kPlateReach = 0.02;  // m, of the plate where the body is trusted by half
constexpr double kLeastTrust = 1e-4;  // far nodes: the plate then reaches ten times as far
constexpr double kHeld = 1e3;         // weight of near nodes, which keep their place
constexpr double kHemShare = 0.1;     // of the plate at open edges: a hem goes on nearly as the cloth above it does
constexpr double kLeastCotangent = 1e-3, kMostCotangent = 10.0;

// 1 near the body, falling smoothly to kLeastTrust far from it.
double trust(double distance, const TransportGarmentOptions& options) {
  const double t = std::clamp((distance - options.near) / (options.far - options.near), 0.0, 1.0);
  return std::max(std::pow(1.0 - t * t * (3.0 - 2.0 * t), 3), kLeastTrust);
}

// The garment's triangles over its nodes, without those that a collapsed edge has flattened.
Triangles node_triangles(const PatternMesh& mesh) {
  Triangles out(mesh.triangle_count(), 3);
  Eigen::Index count = 0;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i t = mesh.nodes_of_triangle(f);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.row(count++) = t;
  }
  return out.topRows(count);
}

// `feet`: closest points of the nodes.
void distrust_jumps(const Triangles& triangles, const Points3& nodes, const Points3& feet, Eigen::VectorXd& trusted) {
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      if ((feet.row(a) - feet.row(b)).norm() < kJump * (nodes.row(a) - nodes.row(b)).norm()) continue;
      for (const int node : {a, b}) trusted[node] = std::min(trusted[node], kJumpTrust);
    }
}

// Replaces the displacement of far nodes by a thin plate through that of the near ones. Open edges count
// little in the plate: a hem goes on nearly as the cloth above it does.
int bridge_gaps(const Triangles& triangles, const Points3& rest, const Eigen::VectorXd& trusted, Points3& carried) {
  const auto gaps = static_cast<int>((trusted.array() < 1.0).count());
  if (gaps == 0) return 0;
  const Eigen::VectorXd areas = vertex_areas(rest, triangles).cwiseMax(1e-9);
  Eigen::VectorXd inner = areas.cwiseInverse();
  const HalfEdges edges = find_half_edges(triangles);
  for (std::size_t h = 0; h < edges.opposite.size(); ++h)
    if (edges.opposite[h] < 0)
      for (const int v :
           {half_edge_start(triangles, static_cast<int>(h)), half_edge_end(triangles, static_cast<int>(h))})
        inner[v] = kHemShare / areas[v];
  const SparseMatrix laplacian = cotangent_laplacian(rest, triangles, kLeastCotangent, kMostCotangent);
  SparseMatrix system = std::pow(kPlateReach, 4) * (laplacian * inner.asDiagonal() * laplacian);
  const Eigen::VectorXd held = (trusted.array() < 1.0).select(trusted.array(), kHeld) * areas.array();
  for (Eigen::Index i = 0; i < held.size(); ++i) system.coeffRef(i, i) += held[i];
  system.makeCompressed();
  SparseSolver solver;
  if (!solver.factor(system)) return 0;  // the carried positions stand as they are
  const Eigen::MatrixXd bridged = solver.solve(held.asDiagonal() * (carried - rest));
  for (Eigen::Index i = 0; i < carried.rows(); ++i)
    if (trusted[i] < 1.0) carried.row(i) = rest.row(i) + bridged.row(i);
  return gaps;
}

}  // namespace

TransportGarmentResult transport_garment(const PatternMesh& mesh, const Drape& reference_drape,
                                         const Body& reference_body, const Body& target_body, const BodyMap& map,
                                         const TransportGarmentOptions& options, const Progress* progress) {
  const TriangleMesh& surface = reference_body.surface;
  const SurfaceTree reference_tree(surface.vertices, surface.triangles);
  const Points3 normals = vertex_normals(surface.vertices, surface.triangles);
  const Points3 mapped_normals = vertex_normals(map.mapped, surface.triangles);

  TransportGarmentResult result;
  Points3& nodes = result.drape.nodes;
  nodes.resize(reference_drape.nodes.rows(), 3);
  Eigen::VectorXd trusted(nodes.rows());
  Points3 feet(nodes.rows(), 3);
  int near = -1;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const Vec3 v = reference_drape.nodes.row(i);
    const SurfacePoint c = reference_tree.closest_point(v, std::numeric_limits<double>::infinity(), near);
    near = c.triangle;
    feet.row(i) = c.point.transpose();
    trusted[i] = trust(c.distance(), options);
    const Eigen::Vector3i corners = surface.triangles.row(c.triangle);
    const Vec3 from = interpolate(normals, corners, c.barycentric);
    const Vec3 to = interpolate(mapped_normals, corners, c.barycentric);
    const auto turn = Eigen::Quaterniond::FromTwoVectors(from, to);
    nodes.row(i) = (interpolate(map.mapped, corners, c.barycentric) + turn * (v - c.point)).transpose();
  }
  report(progress, "transport", 0.5);
  const Triangles triangles = node_triangles(mesh);
  distrust_jumps(triangles, reference_drape.nodes, feet, trusted);
  const int bridged = bridge_gaps(triangles, reference_drape.nodes, trusted, nodes);

  PushOut push;
  push.apply(SurfaceTree(target_body.surface.vertices, target_body.surface.triangles), target_body.surface,
             options.clearance, nodes);
  result.diagnostics.add("nodes", static_cast<int>(nodes.rows()))
      .add("nodes_bridged", bridged)
      .add("nodes_pushed_out", push.pushed)
      .add("deepest_before_push_mm", push.deepest * kMmPerMetre);
  report(progress, "transport", 1.0);
  return result;
}

}  // namespace toile

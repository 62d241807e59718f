// SPDX-License-Identifier: GPL-3.0-or-later
// Cloth against cloth. A refresh looks at which nodes and triangles, and which pairs of edges, are near each other and
// freezes each such pair: its closest points, the direction n between them and the plane half-way. Until the next
// refresh
//   repulsion  E = k A d [ d ln(d / g) - (d - g) ] for gaps g < d, g = n . (point on one side - point on the other),
//   planes     no node may cross the half-way planes of its pairs, and none may move further than half the reach:
//              together no pair can pass through each other, however large the step,
//   untangling where an edge pierces a triangle already, both are drawn along the direction that shortens the line of
//              intersection [Volino2006]; pairs close by have no known sides and are left free.
// Pairs are found by patches (cloth_patches.h): smooth cloth costs next to nothing. SI units.
#pragma once

#include "engine/core/pattern_mesh.h"
#include "engine/sim/cloth.h"
#include "engine/sim/cloth_patches.h"
#include "engine/sim/energy_hessian.h"

namespace toile {

struct ClothContactOptions {
  double thickness = 0.0015;    // d, gap at which layers begin to repel, m, > 0
  double stiffness = 5e3;       // k, N/m^3, > 0: of the repulsion where it begins
  double push = 0.002;          // how far one refresh wants to draw a piercing pair, m
  double push_stiffness = 1e5;  // N/m^3
};

class ClothContact {
 public:
  // `cloth` must outlive this; `mesh` need not.
  ClothContact(const Cloth& cloth, const PatternMesh& mesh, const ClothContactOptions& options);

  // Finds the pairs at `nodes` (#N x 3). The energy changes: evaluate again.
  void refresh(const Points3& nodes);

  // Adds the gradient (#N x 3, N) and returns the energy, J.
  double energy_gradient(const Points3& nodes, Points3& gradient) const;
  // Adds the second derivatives, which are never negative.
  void add_hessian(const Points3& nodes, BlockHessian& hessian) const;
  // Adds the lower triangle of the stiffness along the pairs' directions, N/m, as if it held for every coordinate.
  void add_stiffness(const Points3& nodes, std::vector<Eigen::Triplet<double>>& entries) const;

  // Shortens the moves from `from`, where all planes hold, to `to` so that they still hold.
  void limit(const Points3& from, Points3& to);
  // Some node was stopped for want of knowledge about what lies ahead: refresh soon.
  bool stale() const { return stale_; }

  int piercings() const { return static_cast<int>(piercings_.size()); }
  int planes() const { return static_cast<int>(planes_.size()); }  // 0: nothing is within reach

 private:
  struct Edge {
    std::array<int, 2> node;
    std::array<int, 2> triangle;  // -1: none; further triangles are left out
  };
  struct Pair {
    std::array<int, 5> node;
    std::array<double, 5> weight;  // positive on one side, negative on the other, 0 in unused places
    Vec3 normal;
    double stiffness;  // times area, N/m
    double offset;     // m, taken off n . sum(weight x)
    bool pushed;       // untangling instead of repulsion
    int of;            // vertex or edge it counts for
  };
  struct PiercedTriangle {
    int edge, triangle;
    double s;
    Vec3 barycentric;
  };
  struct Plane {
    int node;
    Vec3 normal;
    double offset;  // normal . x >= offset
  };

  void find_edges();
  void find_near(const Points3& nodes);
  void find_piercings(const Points3& nodes);
  void mark_around_piercings();
  void find_vertex_pairs(const Points3& nodes, int f, int g);
  void find_edge_pairs(const Points3& nodes, int f, int g);
  void add_pair(const Pair& pair, double distance, double along);
  void add_push(const Points3& nodes, const PiercedTriangle& piercing);
  Vec3 shortening(const Points3& nodes, const PiercedTriangle& piercing) const;
  void share_areas();
  void sort_planes();
  bool has_node(int triangle, int node) const;
  int corner(int triangle, int k) const { return triangles_(triangle, k); }
  // Second derivative of the pair's energy by its gap, N/m.
  double stiffness_of(const Pair& pair, const Points3& nodes) const;
  double gap_of(const Pair& pair, const Points3& nodes) const;
  double slope(double gap, double& energy, double& curvature) const;

  const Cloth& cloth_;
  ClothContactOptions options_;
  Triangles triangles_;  // of nodes
  ClothPatches patches_;
  std::vector<Edge> edges_;
  std::vector<std::array<int, 3>> owned_edges_;  // per triangle, -1: owned by another
  std::vector<int> owner_of_node_;
  std::vector<std::array<int, 3>> edges_of_triangle_;

  double reach_;
  Points3 seen_at_;  // #N x 3, of the last refresh
  bool fresh_ = false, stale_ = false;
  Points3 searched_at_;  // #N x 3, where candidates_ were found
  bool searched_ = false;
  std::vector<TriangleBox> boxes_;                      // per triangle
  std::vector<std::pair<int, int>> candidates_, near_;  // pairs of triangles
  std::vector<PiercedTriangle> piercings_;
  std::vector<char> marked_;  // nodes near a piercing
  std::vector<double> nearest_;
  std::vector<Pair> pairs_;
  std::vector<Plane> planes_;
};

}  // namespace toile

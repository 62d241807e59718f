// SPDX-License-Identifier: GPL-3.0-or-later
// Exact closest points on a triangle surface, by a tree of boxes. Any lengths (metres in Toile); double precision.
// The tree owns a copy of the surface's corners and is immutable: any number of threads may ask it at once.
#pragma once

#include <limits>

#include "engine/core/types.h"

namespace toile {

// What the closest point lies on: the inside of the triangle, one of its edges or one of its corners.
enum class TriangleFeature : std::uint8_t { Face, Edge, Corner };

struct SurfacePoint {
  int triangle = -1;  // -1: nothing within the given distance
  double distance_squared = std::numeric_limits<double>::infinity();
  Vec3 point = Vec3::Zero();
  Vec3 barycentric = Vec3::Zero();  // of the triangle's corners 0, 1, 2; >= 0, sum 1
  TriangleFeature feature = TriangleFeature::Face;
  int feature_index = 0;  // Edge: 0..2 from corner i to corner (i + 1) % 3; Corner: 0..2; Face: 0

  bool found() const { return triangle >= 0; }
  double distance() const { return std::sqrt(distance_squared); }
};

// Closest point of triangle abc to p (Ericson, Real-Time Collision Detection, 5.1.5); `triangle` is left at 0.
// A degenerate triangle is treated as its longest edge.
SurfacePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// Whether the line through (x, y) along z crosses triangle abc, and at which z: +1 where it leaves a solid on its way
// up (counter-clockwise seen from +z), -1 where it enters, 0 where it misses. A line through an edge or corner shared
// by several triangles is counted as if moved a little, consistently: the crossings of a closed surface always add up.
int line_crossing(const Vec2& xy, const Vec3& a, const Vec3& b, const Vec3& c, double& z);

class SurfaceTree {
 public:
  SurfaceTree() = default;
  // Requires finite vertices and indices in range. An empty surface is allowed: nothing is ever found.
  SurfaceTree(const Points3& vertices, const Triangles& triangles);

  // The closest point of the surface. `within`: give up beyond that distance. `start`: a triangle thought to be near
  // (the answer of a neighbouring query); it only makes the query faster.
  SurfacePoint closest_point(const Vec3& p, double within = std::numeric_limits<double>::infinity(),
                             int start = -1) const;

  // The same among triangles whose outer normal makes a cosine above `cosine` (>= 0) with the unit `direction`.
  SurfacePoint closest_point_facing(const Vec3& p, const Vec3& direction, double cosine,
                                    double within = std::numeric_limits<double>::infinity(), int start = -1) const;

  // Distance of the closest point: the same bits whatever the search starts with. `start` becomes its triangle.
  double distance(const Vec3& p, int& start) const;

  // How many times a closed surface winds round p, counted along the ray from p towards +z; 0 outside, 1 inside,
  // 2 where two parts overlap. Rays through edges and corners are counted once. Meaningless if the surface has holes.
  int winding_number(const Vec3& p) const;

  // Distance, negative where the winding number is positive: right on surfaces that touch or cross themselves.
  double signed_distance(const Vec3& p) const;

  int triangle_count() const { return static_cast<int>(slot_of_triangle_.size()); }

 private:
  static constexpr int kLeafSize = 4;  // slots of a leaf: triangles side by side, looked at together
  using Lanes = Eigen::Array<double, kLeafSize, 1>;
  struct Node {  // four children; boxes are widened so that single precision never hides a triangle
    std::array<float, 4> low[3], high[3];
    std::array<std::int32_t, 4> child;  // >= 0 node; -1 none; else ~(leaf * 8 + count)
  };
  struct Leaf {
    std::array<Lanes, 3> a, b, c;  // coordinates of the corners; slots without a triangle repeat the first one

    Lanes distances_squared(const Vec3& p) const;
  };
  struct Corners {
    Vec3 a, b, c;
  };
  struct Builder;
  template <class LookAt>
  void search(const Vec3& p, SurfacePoint& best, LookAt look_at) const;
  Corners corners(std::int32_t slot) const;
  void try_slot(const Vec3& p, std::int32_t slot, SurfacePoint& best) const;
  void try_leaf(const Vec3& p, std::int32_t leaf, SurfacePoint& best) const;  // the nearest of its triangles
  bool has(int triangle) const { return triangle >= 0 && triangle < triangle_count(); }

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<std::int32_t> triangle_of_slot_;  // kLeafSize a leaf
  std::vector<std::int32_t> slot_of_triangle_;
};

}  // namespace toile

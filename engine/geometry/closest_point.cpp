// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace toile {
namespace {

constexpr int kStackSize = 256;
// Widening of the boxes relative to the largest coordinate: covers rounding a query point to float (6e-8 relative)
// and the subtraction after it. Without it a query could skip the box that holds its answer.
constexpr float kBoxSlack = 1e-6F;
constexpr float kDistanceSlack = 1.0F - 1e-5F;
constexpr double kLaneSlack = 1.0 + 1e-12;  // of rounding between the formulas for one triangle and for four
constexpr double kTiny = 1e-300;            // in place of the square of a length that is zero

SurfacePoint point_on_edge(const Vec3& p, const Vec3& a, const Vec3& b, int edge) {
  const Vec3 ab = b - a;
  const double length_squared = ab.squaredNorm();
  const double t = length_squared > 0 ? std::clamp(ab.dot(p - a) / length_squared, 0.0, 1.0) : 0.0;
  SurfacePoint result;
  result.triangle = 0;
  result.point = a + t * ab;
  result.distance_squared = (p - result.point).squaredNorm();
  result.barycentric[edge] = 1 - t;
  result.barycentric[(edge + 1) % 3] = t;
  const bool at_end = t <= 0 || t >= 1;
  result.feature = at_end ? TriangleFeature::Corner : TriangleFeature::Edge;
  result.feature_index = t >= 1 ? (edge + 1) % 3 : edge;
  return result;
}

SurfacePoint at_corner(const Vec3& p, const Vec3& corner, int index) {
  SurfacePoint result;
  result.triangle = 0;
  result.point = corner;
  result.distance_squared = (p - corner).squaredNorm();
  result.barycentric[index] = 1;
  result.feature = TriangleFeature::Corner;
  result.feature_index = index;
  return result;
}

SurfacePoint on_longest_edge(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
  if (ab >= bc && ab >= ca) return point_on_edge(p, a, b, 0);
  return bc >= ca ? point_on_edge(p, b, c, 1) : point_on_edge(p, c, a, 2);
}

// Twice the signed area of (a, b, p) in the xy plane, exactly antisymmetric in a and b, so that the two triangles at
// an edge agree on which of them a ray crosses; exactly 0 at a corner (relative to p, a fused multiply-add rounds no
// product with 0), so that all triangles round a corner apply the same rule there.
double side_of_edge(const Vec3& a, const Vec3& b, double x, double y) {
  const bool swap = std::tie(b.x(), b.y()) < std::tie(a.x(), a.y());
  const Vec3& s = swap ? b : a;
  const Vec3& e = swap ? a : b;
  const double area = (s.x() - x) * (e.y() - y) - (s.y() - y) * (e.x() - x);
  return swap ? -area : area;
}

// Which triangle owns a point exactly on its edge: the rule of a point moved by an infinitesimal (eps, eps^2).
bool owns_edge(const Vec3& a, const Vec3& b) {
  const double dx = b.x() - a.x(), dy = b.y() - a.y();
  return -dy > 0 || (dy == 0 && dx > 0);
}

}  // namespace

int line_crossing(const Vec2& xy, const Vec3& a, const Vec3& b, const Vec3& c, double& z) {
  const double w[3] = {side_of_edge(b, c, xy.x(), xy.y()), side_of_edge(c, a, xy.x(), xy.y()),
                       side_of_edge(a, b, xy.x(), xy.y())};
  const Vec3* from[3] = {&b, &c, &a};
  const Vec3* to[3] = {&c, &a, &b};
  bool left = true, right = true;
  for (int i = 0; i < 3; ++i) {
    left = left && (w[i] > 0 || (w[i] == 0 && owns_edge(*from[i], *to[i])));
    right = right && (w[i] < 0 || (w[i] == 0 && owns_edge(*to[i], *from[i])));
  }
  const double sum = w[0] + w[1] + w[2];
  if (left == right || sum == 0) return 0;
  z = (w[0] * a.z() + w[1] * b.z() + w[2] * c.z()) / sum;
  return left ? 1 : -1;
}

namespace {

// +1 if the ray from p to +z leaves through the triangle, -1 if it enters, 0 if it misses.
int ray_crossing(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  double z = 0;
  const int side = line_crossing(p.head<2>(), a, b, c, z);
  return z > p.z() ? side : 0;
}

}  // namespace

SurfacePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return at_corner(p, a, 0);
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return at_corner(p, b, 1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return point_on_edge(p, a, b, 0);
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return at_corner(p, c, 2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return point_on_edge(p, c, a, 2);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return point_on_edge(p, b, c, 1);
  const double sum = va + vb + vc;
  if (!(sum > 0)) return on_longest_edge(p, a, b, c);
  SurfacePoint result;
  result.triangle = 0;
  result.barycentric = Vec3(va, vb, vc) / sum;
  result.point = a + ab * result.barycentric[1] + ac * result.barycentric[2];
  result.distance_squared = (p - result.point).squaredNorm();
  return result;
}

struct SurfaceTree::Builder {
  struct Item {
    Vec3 low, high, centre;
    std::int32_t triangle;
  };
  SurfaceTree& tree;
  const Points3& vertices;
  const Triangles& triangles;
  std::vector<Item> items;
  float slack = 0;

  using Iterator = std::vector<Item>::iterator;

  // Halves the items at the median of the longest extent of their centres.
  static Iterator split(Iterator begin, Iterator end) {
    Vec3 low = begin->centre, high = low;
    for (auto it = begin; it != end; ++it) low = low.cwiseMin(it->centre), high = high.cwiseMax(it->centre);
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [axis](const Item& l, const Item& r) {
      return l.centre[axis] != r.centre[axis] ? l.centre[axis] < r.centre[axis] : l.triangle < r.triangle;
    });
    return middle;
  }

  void set_box(Node& node, std::size_t k, Iterator begin, Iterator end) const {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (auto it = begin; it != end; ++it) low = low.cwiseMin(it->low), high = high.cwiseMax(it->high);
    for (int d = 0; d < 3; ++d) {
      node.low[d][k] = static_cast<float>(low[d]) - slack;
      node.high[d][k] = static_cast<float>(high[d]) + slack;
    }
  }

  std::int32_t add_leaf(Iterator begin, Iterator end) const {
    const auto leaf = static_cast<std::int32_t>(tree.leaves_.size());
    Leaf& lanes = tree.leaves_.emplace_back();
    for (int k = 0; k < kLeafSize; ++k) {
      const std::int32_t f = (k < end - begin ? begin + k : begin)->triangle;
      for (int d = 0; d < 3; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        lanes.a[axis][k] = vertices(triangles(f, 0), d);
        lanes.b[axis][k] = vertices(triangles(f, 1), d);
        lanes.c[axis][k] = vertices(triangles(f, 2), d);
      }
      if (k < end - begin) tree.slot_of_triangle_[static_cast<std::size_t>(f)] = leaf * kLeafSize + k;
      tree.triangle_of_slot_.push_back(f);
    }
    return ~(leaf * 8 + static_cast<std::int32_t>(end - begin));
  }

  std::int32_t add_node(Iterator begin, Iterator end) {
    const auto index = static_cast<std::int32_t>(tree.nodes_.size());
    tree.nodes_.emplace_back();
    const auto half = split(begin, end);
    const Iterator cuts[5] = {begin, half - begin > 1 ? split(begin, half) : half, half,
                              end - half > 1 ? split(half, end) : end, end};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto count = cuts[k + 1] - cuts[k];
      const std::int32_t child = count == 0           ? -1
                                 : count <= kLeafSize ? add_leaf(cuts[k], cuts[k + 1])
                                                      : add_node(cuts[k], cuts[k + 1]);
      Node& node = tree.nodes_[static_cast<std::size_t>(index)];
      node.child[k] = child;
      set_box(node, k, cuts[k], cuts[k + 1]);
    }
    return index;
  }
};

SurfaceTree::SurfaceTree(const Points3& vertices, const Triangles& triangles) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  if (count == 0) return;
  Builder builder{*this, vertices, triangles, {}, kBoxSlack * static_cast<float>(vertices.cwiseAbs().maxCoeff())};
  builder.items.reserve(count);
  const auto corner = [&](std::size_t f, int k) -> Vec3 {
    return vertices.row(triangles(static_cast<Eigen::Index>(f), k)).transpose();
  };
  for (std::size_t f = 0; f < count; ++f) {
    const Vec3 a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
    builder.items.push_back(
        {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), (a + b + c) / 3, static_cast<std::int32_t>(f)});
  }
  nodes_.reserve(count / 3 + 4);
  slot_of_triangle_.resize(count);
  builder.add_node(builder.items.begin(), builder.items.end());
}

SurfaceTree::Corners SurfaceTree::corners(std::int32_t slot) const {
  const Leaf& leaf = leaves_[static_cast<std::size_t>(slot / kLeafSize)];
  const int k = slot % kLeafSize;
  return {Vec3(leaf.a[0][k], leaf.a[1][k], leaf.a[2][k]), Vec3(leaf.b[0][k], leaf.b[1][k], leaf.b[2][k]),
          Vec3(leaf.c[0][k], leaf.c[1][k], leaf.c[2][k])};
}

// Of the four triangles to p: the least to the three sides, or to the plane where its foot lies inside.
SurfaceTree::Lanes SurfaceTree::Leaf::distances_squared(const Vec3& p) const {
  using Vector = std::array<Lanes, 3>;
  const auto dot = [](const Vector& l, const Vector& r) -> Lanes { return l[0] * r[0] + l[1] * r[1] + l[2] * r[2]; };
  const auto minus = [](const Vector& l, const Vector& r) -> Vector { return {l[0] - r[0], l[1] - r[1], l[2] - r[2]}; };
  const auto to_side = [&](const Vector& from, const Vector& side, const Lanes& length_squared) -> Lanes {
    const Lanes t = (dot(side, from) / length_squared.max(kTiny)).max(0.0).min(1.0);
    const Vector off = {from[0] - t * side[0], from[1] - t * side[1], from[2] - t * side[2]};
    return dot(off, off);
  };
  const Vector at = {Lanes::Constant(p[0]), Lanes::Constant(p[1]), Lanes::Constant(p[2])};
  const Vector ab = minus(b, a), ac = minus(c, a), bc = minus(c, b), ap = minus(at, a);
  const Lanes bb = dot(ab, ab), cc = dot(ac, ac), bc_squared = dot(bc, bc), along = dot(ab, ac);
  const Lanes sides = to_side(ap, ab, bb).min(to_side(ap, ac, cc)).min(to_side(minus(at, b), bc, bc_squared));
  const Lanes d1 = dot(ab, ap), d2 = dot(ac, ap), determinant = bb * cc - along * along;
  const Lanes scale = 1.0 / determinant.max(kTiny), v = (cc * d1 - along * d2) * scale,
              w = (bb * d2 - along * d1) * scale;
  const Vector off = {ap[0] - v * ab[0] - w * ac[0], ap[1] - v * ab[1] - w * ac[1], ap[2] - v * ab[2] - w * ac[2]};
  const auto inside = determinant > kTiny && v >= 0.0 && w >= 0.0 && v + w <= 1.0;
  return inside.select(dot(off, off).min(sides), sides);
}

void SurfaceTree::try_slot(const Vec3& p, std::int32_t slot, SurfacePoint& best) const {
  const Corners t = corners(slot);
  const SurfacePoint candidate = closest_point_on_triangle(p, t.a, t.b, t.c);
  if (candidate.distance_squared >= best.distance_squared) return;
  best = candidate;
  best.triangle = triangle_of_slot_[static_cast<std::size_t>(slot)];
}

void SurfaceTree::try_leaf(const Vec3& p, std::int32_t leaf, SurfacePoint& best) const {
  const Lanes distances = leaves_[static_cast<std::size_t>(leaf)].distances_squared(p);
  Eigen::Index nearest = 0;
  // A little slack: the last digits are for the one triangle's own formula to say.
  if (distances.minCoeff(&nearest) < best.distance_squared * kLaneSlack)
    try_slot(p, leaf * kLeafSize + static_cast<std::int32_t>(nearest), best);
}

// `look_at(leaf, count)` of every leaf that may hold something nearer than `best`, near ones first.
template <class LookAt>
void SurfaceTree::search(const Vec3& p, SurfacePoint& best, LookAt look_at) const {
  const float q[3] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
  struct Entry {
    float bound;
    std::int32_t child;
  };
  std::array<Entry, kStackSize> stack;
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = {0.0F, 0};
  while (top > 0) {
    const Entry entry = stack[static_cast<std::size_t>(--top)];
    if (static_cast<double>(entry.bound) >= best.distance_squared) continue;
    if (entry.child < 0) {
      look_at(~entry.child / 8, ~entry.child % 8);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(entry.child)];
    using Boxes = Eigen::Array<float, 4, 1>;
    Boxes squares = Boxes::Zero();
    for (std::size_t d = 0; d < 3; ++d) {
      const Eigen::Map<const Boxes> low(node.low[d].data()), high(node.high[d].data());
      const Boxes gap = (low - q[d]).max(q[d] - high).max(0.0F);
      squares += gap * gap;
    }
    std::array<float, 4> bound;
    Eigen::Map<Boxes>(bound.data()) = squares * kDistanceSlack;
    // Pushed from far to near: the nearest child is taken first. Insertion sort of at most four entries.
    const int first = top;
    for (std::size_t k = 0; k < 4; ++k) {
      const float b = bound[k];
      if (node.child[k] == -1 || static_cast<double>(b) >= best.distance_squared) continue;
      int at = top++;
      for (; at > first && stack[static_cast<std::size_t>(at - 1)].bound < b; --at)
        stack[static_cast<std::size_t>(at)] = stack[static_cast<std::size_t>(at - 1)];
      stack[static_cast<std::size_t>(at)] = {b, node.child[k]};
    }
  }
}

SurfacePoint SurfaceTree::closest_point(const Vec3& p, double within, int start) const {
  SurfacePoint best;
  best.distance_squared = within * within;
  if (nodes_.empty()) return best;
  if (has(start)) try_slot(p, slot_of_triangle_[static_cast<std::size_t>(start)], best);
  search(p, best, [&](std::int32_t leaf, int) { try_leaf(p, leaf, best); });
  return best;
}

// Two triangles of one leaf may be as near but for rounding: the search starts with the leaf, not with the triangle.
double SurfaceTree::distance(const Vec3& p, int& start) const {
  SurfacePoint best;
  if (nodes_.empty()) return best.distance();
  if (has(start)) try_leaf(p, slot_of_triangle_[static_cast<std::size_t>(start)] / kLeafSize, best);
  search(p, best, [&](std::int32_t leaf, int) { try_leaf(p, leaf, best); });
  start = best.triangle;
  return best.distance();
}

SurfacePoint SurfaceTree::closest_point_facing(const Vec3& p, const Vec3& direction, double cosine, double within,
                                               int start) const {
  SurfacePoint best;
  best.distance_squared = within * within;
  if (nodes_.empty()) return best;
  const auto try_facing = [&](std::int32_t slot) {
    const Corners t = corners(slot);
    const Vec3 normal = (t.b - t.a).cross(t.c - t.a);
    const double along = normal.dot(direction);
    if (along > 0 && along * along > cosine * cosine * normal.squaredNorm()) try_slot(p, slot, best);
  };
  if (has(start)) try_facing(slot_of_triangle_[static_cast<std::size_t>(start)]);
  search(p, best, [&](std::int32_t leaf, int count) {
    for (int k = 0; k < count; ++k) try_facing(leaf * kLeafSize + k);
  });
  return best;
}

int SurfaceTree::winding_number(const Vec3& p) const {
  if (nodes_.empty()) return 0;
  const float q[3] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
  std::array<std::int32_t, kStackSize> stack;
  int top = 0, winding = 0;
  stack[static_cast<std::size_t>(top++)] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(--top)])];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t child = node.child[k];
      if (child == -1 || q[0] < node.low[0][k] || q[0] > node.high[0][k] || q[1] < node.low[1][k] ||
          q[1] > node.high[1][k] || q[2] > node.high[2][k])
        continue;
      if (child >= 0) {
        stack[static_cast<std::size_t>(top++)] = child;
        continue;
      }
      const std::int32_t leaf = ~child;
      for (std::int32_t slot = leaf / 8 * kLeafSize, end = slot + leaf % 8; slot < end; ++slot) {
        const Corners t = corners(slot);
        winding += ray_crossing(p, t.a, t.b, t.c);
      }
    }
  }
  return winding;
}

double SurfaceTree::signed_distance(const Vec3& p) const {
  const double distance = closest_point(p).distance();
  return winding_number(p) > 0 ? -distance : distance;
}

}  // namespace toile

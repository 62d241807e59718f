// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/independent.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/QR>

namespace toile::stress {
namespace {

// Solid angle of a triangle seen from p (van Oosterom and Strackee): summed over a closed surface and divided by 4 pi
// it is the winding number.
double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - p, v = b - p, w = c - p;
  const double lu = u.norm(), lv = v.norm(), lw = w.norm();
  return 2.0 * std::atan2(u.dot(v.cross(w)), lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double edges =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  if (n.squaredNorm() == 0) return edges;
  const Vec3 foot = p - n * (n.dot(p - a) / n.squaredNorm());
  const bool inside =
      n.dot((b - a).cross(foot - a)) >= 0 && n.dot((c - b).cross(foot - b)) >= 0 && n.dot((a - c).cross(foot - c)) >= 0;
  return inside ? (p - foot).norm() : edges;
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).dot((c - a).cross(d - a));
}

using Corners = std::array<Vec3, 3>;

constexpr double kTouch = 1e-10;  // volume, of the cube of the size, below which a sign is rounding

// Volumes count as positive above `least`: > 0 asks for a clear crossing, < 0 lets touching pass for one.
bool passes_through(const Vec3& p, const Vec3& q, const Corners& t, double least) {
  const double before = volume(t[0], t[1], t[2], p), after = volume(t[0], t[1], t[2], q);
  const double s0 = volume(p, q, t[0], t[1]), s1 = volume(p, q, t[1], t[2]), s2 = volume(p, q, t[2], t[0]);
  const bool apart = (before > least && after < -least) || (before < -least && after > least);
  return apart && ((s0 > least && s1 > least && s2 > least) || (s0 < -least && s1 < -least && s2 < -least));
}

bool cross(const Corners& s, const Corners& t, double least) {
  for (std::size_t k = 0; k < 3; ++k)
    if (passes_through(s[k], s[(k + 1) % 3], t, least) || passes_through(t[k], t[(k + 1) % 3], s, least)) return true;
  return false;
}

}  // namespace

Strains strains(const PatternMesh& mesh, const Points2& rest, const Points3& nodes) {
  Strains all;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    Vec3 along_u = Vec3::Zero(), along_v = Vec3::Zero();
    double twice_area = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec2 next = rest.row(mesh.triangles(f, (k + 1) % 3)), other = rest.row(mesh.triangles(f, (k + 2) % 3));
      const Vec3 x = nodes.row(n[k]);
      along_u += (next.y() - other.y()) * x;
      along_v += (other.x() - next.x()) * x;
      twice_area += next.x() * other.y() - next.y() * other.x();
    }
    all.weft.push_back(along_u.norm() / std::abs(twice_area) - 1.0);
    all.warp.push_back(along_v.norm() / std::abs(twice_area) - 1.0);
    all.area.push_back(0.5 * std::abs(twice_area));
  }
  return all;
}

Strains recovered(const PatternMesh& mesh, const Points2& rest, const Strains& own) {
  constexpr double kLevel = 1e-3;  // against slopes, of the root of the patch's area: where it is one line of triangles
  std::multimap<int, int> round;   // triangles at a vertex
  std::vector<Vec2> middle;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    middle.emplace_back(Vec2::Zero());
    for (int k = 0; k < 3; ++k) {
      round.emplace(mesh.triangles(f, k), f);
      middle.back() += rest.row(mesh.triangles(f, k)).transpose() / 3;
    }
  }
  Strains all = own;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    std::set<int> patch;
    for (int k = 0; k < 3; ++k)
      for (auto [at, end] = round.equal_range(mesh.triangles(f, k)); at != end; ++at) patch.insert(at->second);
    if (patch.size() < 6) continue;
    const auto count = static_cast<Eigen::Index>(patch.size());
    double area = 0;
    for (const int g : patch) area += own.area[static_cast<std::size_t>(g)];
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count + 2, 3), values = Eigen::MatrixXd::Zero(count + 2, 2);
    rows(count, 1) = rows(count + 1, 2) = kLevel * std::sqrt(area);
    Eigen::Index i = 0;
    for (const int g : patch) {
      const auto at = static_cast<std::size_t>(g);
      const Vec2 offset = (middle[at] - middle[static_cast<std::size_t>(f)]) / std::sqrt(area);
      const double weight = std::sqrt(own.area[at]);
      rows.row(i) << weight, weight * offset.x(), weight * offset.y();
      values.row(i++) << weight * own.weft[at], weight * own.warp[at];
    }
    const Eigen::RowVector2d plane = rows.colPivHouseholderQr().solve(values).row(0);
    const auto within = [&](double value, const std::vector<double>& of) {
      double least = of[static_cast<std::size_t>(f)], most = least;
      for (const int g : patch) {
        least = std::min(least, of[static_cast<std::size_t>(g)]);
        most = std::max(most, of[static_cast<std::size_t>(g)]);
      }
      return std::clamp(value, least, most);
    };
    all.weft[static_cast<std::size_t>(f)] = within(plane[0], own.weft);
    all.warp[static_cast<std::size_t>(f)] = within(plane[1], own.warp);
  }
  return all;
}

double share_within(const std::vector<double>& values, const std::vector<double>& area, double limit) {
  double within = 0.0, all = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    all += area[i];
    if (std::abs(values[i]) <= limit) within += area[i];
  }
  return all > 0 ? within / all : 1.0;
}

double rms_difference(const Strains& a, const Strains& b) {
  double squares = 0.0, area = 0.0;
  for (std::size_t f = 0; f < a.area.size(); ++f) {
    const double weft = a.weft[f] - b.weft[f], warp = a.warp[f] - b.warp[f];
    squares += a.area[f] * 0.5 * (weft * weft + warp * warp);
    area += a.area[f];
  }
  return std::sqrt(squares / area);
}

double deepest_node(const Points3& nodes, const TriangleMesh& surface, int stride) {
  double deepest = 0.0;
  const auto corner = [&](int f, int k) -> Vec3 { return surface.vertices.row(surface.triangles(f, k)); };
  for (Eigen::Index i = 0; i < nodes.rows(); i += stride) {
    const Vec3 p = nodes.row(i);
    double angle = 0.0, distance = 1e300;
    for (int f = 0; f < surface.triangle_count(); ++f) {
      angle += solid_angle(p, corner(f, 0), corner(f, 1), corner(f, 2));
      distance = std::min(distance, distance_to_triangle(p, corner(f, 0), corner(f, 1), corner(f, 2)));
    }
    if (angle > 2.0 * std::numbers::pi) deepest = std::max(deepest, distance);
  }
  return deepest;
}

CrossingPairs crossing_pairs_by_volumes(const PatternMesh& mesh, const Points3& nodes) {
  std::vector<Corners> corners;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    corners.push_back({nodes.row(n[0]), nodes.row(n[1]), nodes.row(n[2])});
    boxes.emplace_back();
    for (const Vec3& x : corners.back()) boxes.back().extend(x);
  }
  const auto share_node = [&](int f, int g) {
    const Eigen::Vector3i a = mesh.nodes_of_triangle(f), b = mesh.nodes_of_triangle(g);
    return (a.array() == b[0]).any() || (a.array() == b[1]).any() || (a.array() == b[2]).any();
  };
  CrossingPairs count;
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int g = f + 1; g < mesh.triangle_count(); ++g) {
      const auto i = static_cast<std::size_t>(f), j = static_cast<std::size_t>(g);
      if (!boxes[i].intersects(boxes[j]) || share_node(f, g)) continue;
      const double touch = kTouch * std::pow(boxes[i].merged(boxes[j]).diagonal().norm(), 3);
      count.sure += cross(corners[i], corners[j], touch);
      count.possible += cross(corners[i], corners[j], -touch);
    }
  return count;
}

int flipped_triangles(const Triangles& triangles, const Points2& rest) {
  int flipped = 0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Vec2 a = rest.row(triangles(f, 0)), b = rest.row(triangles(f, 1)), c = rest.row(triangles(f, 2));
    flipped += !((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x() > 0);
  }
  return flipped;
}

double polygon_area(const std::vector<Vec2>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

}  // namespace toile::stress

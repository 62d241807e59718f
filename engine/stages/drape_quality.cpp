// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape_quality.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/weighted_quantile.h"

namespace toile {
namespace {

constexpr double kNodeDepth = 0.001, kEdgeDepth = 0.003;  // m, beyond which a node or edge midpoint counts as inside

StrainPercentiles percentiles(WeightedValues magnitudes) {
  return {weighted_quantile(magnitudes, 0.5), weighted_quantile(magnitudes, 0.99)};
}

void measure_strain(const PatternMesh& mesh, const Drape& drape, DrapeQuality& quality) {
  WeightedValues weft, warp, shear;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    Mat2 rest;
    Mat32 draped;
    for (int k = 0; k < 2; ++k) {
      rest.col(k) = (mesh.rest.row(mesh.triangles(f, k + 1)) - mesh.rest.row(mesh.triangles(f, 0))).transpose();
      draped.col(k) = (drape.nodes.row(n[k + 1]) - drape.nodes.row(n[0])).transpose();
    }
    const Mat32 F = draped * rest.inverse();
    const double area = 0.5 * std::abs(rest.determinant()), u = F.col(0).norm(), v = F.col(1).norm();
    weft.emplace_back(std::abs(u - 1), area);
    warp.emplace_back(std::abs(v - 1), area);
    const double cosine = u * v > 0 ? F.col(0).dot(F.col(1)) / (u * v) : 0.0;
    shear.emplace_back(std::abs(std::asin(std::clamp(cosine, -1.0, 1.0))), area);
  }
  quality.weft = percentiles(std::move(weft));
  quality.warp = percentiles(std::move(warp));
  quality.shear = percentiles(std::move(shear));
}

void measure_penetration(const PatternMesh& mesh, const SurfaceTree& surface, const Drape& drape,
                         DrapeQuality& quality) {
  for (Eigen::Index i = 0; i < drape.nodes.rows(); ++i) {
    const double depth = depth_inside(surface, drape.nodes.row(i));
    quality.deepest_node = std::max(quality.deepest_node, depth);
    quality.nodes_inside += depth > kNodeDepth;
  }
  std::vector<std::pair<int, int>> edges;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(n[k], n[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) {
    const double depth = depth_inside(surface, 0.5 * (drape.nodes.row(a) + drape.nodes.row(b)).transpose());
    quality.deepest_edge = std::max(quality.deepest_edge, depth);
    quality.edges_inside += depth > kEdgeDepth;
  }
}

// Whether the segment pq crosses the inside of triangle abc (touching does not count).
bool segment_crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double dp = n.dot(p - a), dq = n.dot(q - a);
  if (!(dp * dq < 0)) return false;
  const Vec3 at = p + dp / (dp - dq) * (q - p);
  return n.dot((b - a).cross(at - a)) > 0 && n.dot((c - b).cross(at - b)) > 0 && n.dot((a - c).cross(at - c)) > 0;
}

bool triangles_cross(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
  for (std::size_t k = 0; k < 3; ++k)
    if (segment_crosses(s[k], s[(k + 1) % 3], t[0], t[1], t[2]) ||
        segment_crosses(t[k], t[(k + 1) % 3], s[0], s[1], s[2]))
      return true;
  return false;
}

}  // namespace

double depth_inside(const SurfaceTree& surface, const Vec3& p) {
  return surface.winding_number(p) > 0 ? surface.closest_point(p).distance() : 0.0;
}

std::string_view rest_name(Rest rest) {
  switch (rest) {
    case Rest::Converged: return "converged";
    case Rest::Settled: return "settled";
    case Rest::NotAtRest: return "not_at_rest";
    case Rest::AsGiven: return "as_given";
  }
  return "not_at_rest";
}

std::vector<std::pair<int, int>> crossing_pairs(const Points3& nodes, const Triangles& triangles, int most) {
  struct Box {
    Vec3 low, high;
    int triangle;
  };
  std::vector<Box> boxes;
  for (int f = 0; f < triangles.rows(); ++f) {
    const Vec3 a = nodes.row(triangles(f, 0)), b = nodes.row(triangles(f, 1)), c = nodes.row(triangles(f, 2));
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), f});
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
    return a.low.y() != b.low.y() ? a.low.y() < b.low.y() : a.triangle < b.triangle;
  });
  const auto corners = [&](int f) {
    return std::array<Vec3, 3>{nodes.row(triangles(f, 0)), nodes.row(triangles(f, 1)), nodes.row(triangles(f, 2))};
  };
  const auto share_node = [&](int f, int g) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (triangles(f, i) == triangles(g, j)) return true;
    return false;
  };
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.y() <= boxes[i].high.y(); ++j) {
      const Box &s = boxes[i], &t = boxes[j];
      if (s.high.x() < t.low.x() || t.high.x() < s.low.x() || s.high.z() < t.low.z() || t.high.z() < s.low.z())
        continue;
      if (share_node(s.triangle, t.triangle) || !triangles_cross(corners(s.triangle), corners(t.triangle))) continue;
      pairs.push_back(std::minmax(s.triangle, t.triangle));
      if (static_cast<int>(pairs.size()) >= most) break;
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

DrapeQuality measure_drape(const PatternMesh& mesh, const SurfaceTree& surface, const Drape& drape) {
  DrapeQuality quality;
  measure_strain(mesh, drape, quality);
  measure_penetration(mesh, surface, drape, quality);
  Triangles sewn(mesh.triangle_count(), 3);
  for (int f = 0; f < mesh.triangle_count(); ++f) sewn.row(f) = mesh.nodes_of_triangle(f).transpose();
  std::vector<int> crossing;
  for (const auto& [a, b] : crossing_pairs(drape.nodes, sewn)) {
    crossing.push_back(a), crossing.push_back(b);
    ++quality.crossing_pairs;
  }
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  quality.crossing_share = static_cast<double>(crossing.size()) / std::max(1, mesh.triangle_count());
  return quality;
}

}  // namespace toile

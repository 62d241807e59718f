// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth_contact.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/closest_features.h"
#include "engine/geometry/closest_point.h"

namespace toile {
namespace {

constexpr double kLeastReach = 0.3, kMostReach = 0.75;  // of the mean edge: less than a row of triangles
constexpr double kReachPerMove = 4.0;                   // reach over the largest move between two refreshes
constexpr double kLeastGap = 1e-9;                      // m: closer features have no direction between them
constexpr double kPlaneMargin = 0.2;                    // share of the gap that stays free on either side of a plane
constexpr double kFloor = 0.02;  // share of the thickness below which the repulsion grows no stiffer
// Shares of the pressure that a vertex or edge near another layer answers for: both layers have vertices, and a layer
// has three edges a vertex.
constexpr double kVertexShare = 1.0 / 4, kEdgeShare = 1.0 / 6;
constexpr int kMarkedRings = 1;

Triangles sewn_triangles(const PatternMesh& mesh) {
  std::vector<Eigen::Vector3i> kept;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    if (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]) kept.push_back(n);
  }
  Triangles triangles(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t f = 0; f < kept.size(); ++f) triangles.row(static_cast<Eigen::Index>(f)) = kept[f].transpose();
  return triangles;
}

ClothPatches patches_of(const PatternMesh& mesh, const Triangles& triangles) {
  Points2 centres(triangles.rows(), 2);
  std::vector<int> panel;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) continue;
    const auto row = static_cast<Eigen::Index>(panel.size());
    centres.row(row).setZero();
    for (int k = 0; k < 3; ++k) centres.row(row) += mesh.rest.row(mesh.triangles(f, k)) / 3;
    panel.push_back(mesh.panel_of_triangle[static_cast<std::size_t>(f)]);
  }
  return {triangles, centres, panel};
}

template <class T>
decltype(auto) at(T& list, int i) {
  return list[static_cast<std::size_t>(i)];
}

}  // namespace

ClothContact::ClothContact(const Cloth& cloth, const PatternMesh& mesh, const ClothContactOptions& options)
    : cloth_(cloth),
      options_(options),
      triangles_(sewn_triangles(mesh)),
      patches_(patches_of(mesh, triangles_)),
      reach_(kMostReach * cloth.mean_edge),
      marked_(static_cast<std::size_t>(cloth.node_count), false) {
  boxes_.resize(static_cast<std::size_t>(triangles_.rows()));
  find_edges();
}

void ClothContact::find_edges() {
  struct Side {
    std::pair<int, int> nodes;
    int triangle, corner;
  };
  std::vector<Side> sides;
  const int count = static_cast<int>(triangles_.rows());
  owner_of_node_.assign(static_cast<std::size_t>(cloth_.node_count), -1);
  for (int f = 0; f < count; ++f)
    for (int k = 0; k < 3; ++k) {
      sides.push_back({std::minmax(corner(f, k), corner(f, (k + 1) % 3)), f, k});
      if (at(owner_of_node_, corner(f, k)) < 0) at(owner_of_node_, corner(f, k)) = f;
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
  });
  owned_edges_.assign(static_cast<std::size_t>(count), {-1, -1, -1});
  edges_of_triangle_ = owned_edges_;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i == 0 || sides[i - 1].nodes != side.nodes) {
      edges_.push_back({{side.nodes.first, side.nodes.second}, {side.triangle, -1}});
      at(at(owned_edges_, side.triangle), side.corner) = static_cast<int>(edges_.size()) - 1;
    } else if (edges_.back().triangle[1] < 0) {
      edges_.back().triangle[1] = side.triangle;
    }
    at(at(edges_of_triangle_, side.triangle), side.corner) = static_cast<int>(edges_.size()) - 1;
  }
}

bool ClothContact::has_node(int triangle, int node) const {
  return corner(triangle, 0) == node || corner(triangle, 1) == node || corner(triangle, 2) == node;
}

void ClothContact::refresh(const Points3& nodes) {
  if (fresh_) {
    const double moved = std::sqrt((nodes - seen_at_).rowwise().squaredNorm().maxCoeff());
    reach_ = std::clamp(kReachPerMove * moved, std::max(kLeastReach * cloth_.mean_edge, 2 * options_.thickness),
                        kMostReach * cloth_.mean_edge);
  }
  seen_at_ = nodes;
  fresh_ = true;
  stale_ = false;
  near_.clear(), pairs_.clear(), planes_.clear();
  find_near(nodes);
  find_piercings(nodes);
  mark_around_piercings();
  nearest_.assign(static_cast<std::size_t>(cloth_.node_count), std::numeric_limits<double>::infinity());
  for (const auto& [f, g] : near_) {
    find_vertex_pairs(nodes, f, g);
    find_vertex_pairs(nodes, g, f);
    find_edge_pairs(nodes, f, g);
  }
  share_areas();
  for (const PiercedTriangle& piercing : piercings_) add_push(nodes, piercing);
  sort_planes();
}

// Triangles within reach, out of candidates that are searched for anew only when nodes have moved too far.
void ClothContact::find_near(const Points3& nodes) {
  const double most = kMostReach * cloth_.mean_edge;
  const double moved = searched_ ? std::sqrt((nodes - searched_at_).rowwise().squaredNorm().maxCoeff()) : most;
  if (reach_ + 2 * moved > most) {
    candidates_ = patches_.find_near(nodes, most);
    searched_at_ = nodes;
    searched_ = true;
  }
  for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
    const Vec3 a = nodes.row(triangles_(f, 0)), b = nodes.row(triangles_(f, 1)), c = nodes.row(triangles_(f, 2));
    boxes_[static_cast<std::size_t>(f)] = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
  }
  for (const auto& [f, g] : candidates_)
    if (at(boxes_, f).near(at(boxes_, g), reach_)) near_.emplace_back(f, g);
}

void ClothContact::find_piercings(const Points3& nodes) {
  piercings_.clear();
  const auto look = [&](int f, int g) {
    for (int e : at(owned_edges_, f)) {
      if (e < 0) continue;
      const auto [p, q] = at(edges_, e).node;
      if (has_node(g, p) || has_node(g, q)) continue;
      if (const auto found = pierce(nodes.row(p), nodes.row(q), nodes.row(corner(g, 0)), nodes.row(corner(g, 1)),
                                    nodes.row(corner(g, 2))))
        piercings_.push_back({e, g, found->s, found->barycentric});
    }
  };
  for (const auto& [f, g] : near_) look(f, g), look(g, f);
}

void ClothContact::mark_around_piercings() {
  std::fill(marked_.begin(), marked_.end(), false);
  if (piercings_.empty()) return;
  for (const PiercedTriangle& piercing : piercings_) {
    for (int n : at(edges_, piercing.edge).node) at(marked_, n) = true;
    for (int k = 0; k < 3; ++k) at(marked_, corner(piercing.triangle, k)) = true;
  }
  for (int ring = 0; ring < kMarkedRings; ++ring) {
    const std::vector<char> before = marked_;
    for (const Edge& edge : edges_)
      if (at(before, edge.node[0]) || at(before, edge.node[1]))
        at(marked_, edge.node[0]) = at(marked_, edge.node[1]) = true;
  }
}

// Vertices owned by f against triangle g.
void ClothContact::find_vertex_pairs(const Points3& nodes, int f, int g) {
  const Vec3 a = nodes.row(corner(g, 0)), b = nodes.row(corner(g, 1)), c = nodes.row(corner(g, 2));
  const bool uncertain = at(marked_, corner(g, 0)) || at(marked_, corner(g, 1)) || at(marked_, corner(g, 2));
  const Vec3 normal = (b - a).cross(c - a), low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const double steep = reach_ * reach_ * normal.squaredNorm();
  const auto near_box = [&](const Vec3& p) {
    return ((low - p).array() <= reach_).all() && ((p - high).array() <= reach_).all();
  };
  for (int k = 0; k < 3; ++k) {
    const int v = corner(f, k);
    if (at(owner_of_node_, v) != f || has_node(g, v) || (uncertain && at(marked_, v))) continue;
    const Vec3 p = nodes.row(v);
    const double height = normal.dot(p - a);
    if (height * height > steep || !near_box(p)) continue;
    const SurfacePoint nearest = closest_point_on_triangle(p, a, b, c);
    const double distance = std::sqrt(nearest.distance_squared);
    if (distance >= reach_ || distance < kLeastGap) continue;
    Pair pair;
    pair.node = {v, corner(g, 0), corner(g, 1), corner(g, 2), v};
    pair.weight = {1, -nearest.barycentric[0], -nearest.barycentric[1], -nearest.barycentric[2], 0};
    pair.normal = (p - nearest.point) / distance;
    pair.of = v;
    at(nearest_, v) = std::min(at(nearest_, v), distance);
    // The closest point of a triangle's rim belongs to a neighbour as well: only the nearest such pair repels.
    pair.pushed = nearest.feature == TriangleFeature::Face;
    add_pair(pair, distance, pair.normal.dot(nearest.point));
  }
}

void ClothContact::find_edge_pairs(const Points3& nodes, int f, int g) {
  for (int e : at(owned_edges_, f)) {
    if (e < 0) continue;
    const auto [p, q] = at(edges_, e).node;
    const Vec3 a = nodes.row(p), b = nodes.row(q), low = a.cwiseMin(b), high = a.cwiseMax(b);
    const bool uncertain = at(marked_, p) || at(marked_, q);
    for (int other : at(owned_edges_, g)) {
      if (other < 0) continue;
      const auto [r, s] = at(edges_, other).node;
      if (p == r || p == s || q == r || q == s || (uncertain && (at(marked_, r) || at(marked_, s)))) continue;
      const Vec3 c = nodes.row(r), d = nodes.row(s);
      if (((c.cwiseMin(d) - high).array() > reach_).any() || ((low - c.cwiseMax(d)).array() > reach_).any()) continue;
      const SegmentPair nearest = closest_points_of_segments(a, b, c, d);
      const double distance = nearest.apart.norm();
      if (distance >= reach_ || distance < kLeastGap) continue;
      if (nearest.s <= 0 || nearest.s >= 1 || nearest.t <= 0 || nearest.t >= 1) continue;  // a vertex pair has it
      Pair pair;
      pair.node = {p, q, r, s, p};
      pair.weight = {1 - nearest.s, nearest.s, nearest.t - 1, -nearest.t, 0};
      pair.normal = nearest.apart / distance;
      pair.of = -1 - e;
      pair.pushed = true;
      add_pair(pair, distance, pair.normal.dot(c + nearest.t * (d - c)));
    }
  }
}

// Planes half-way between the closest points, the lower of which lies at `along` of the normal; repulsion if near.
void ClothContact::add_pair(const Pair& pair, double distance, double along) {
  const double middle = along + 0.5 * distance, margin = kPlaneMargin * distance;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool above = pair.of >= 0 ? k == 0 : k < 2;
    if (above)
      planes_.push_back({pair.node[k], pair.normal, middle + margin});
    else
      planes_.push_back({pair.node[k], -pair.normal, -middle + margin});
  }
  if (distance > 2 * options_.thickness) return;
  pairs_.push_back(pair);
  pairs_.back().offset = distance;
}

// Keeps the pairs that repel and gives each its share of the area round its vertex or edge.
void ClothContact::share_areas() {
  std::erase_if(pairs_,
                [this](const Pair& pair) { return !pair.pushed && pair.offset > 1.0001 * at(nearest_, pair.of); });
  std::vector<int> on_node(static_cast<std::size_t>(cloth_.node_count), 0), on_edge(edges_.size(), 0);
  for (const Pair& pair : pairs_) ++(pair.of >= 0 ? at(on_node, pair.of) : at(on_edge, -1 - pair.of));
  for (Pair& pair : pairs_) {
    const double area = pair.of >= 0
                            ? kVertexShare * cloth_.node_area[pair.of] / at(on_node, pair.of)
                            : kEdgeShare * 0.5 * (cloth_.node_area[pair.node[0]] + cloth_.node_area[pair.node[1]]) /
                                  at(on_edge, -1 - pair.of);
    pair.stiffness = options_.stiffness * area;
    pair.offset = 0;
    pair.pushed = false;
  }
}

// Direction in which to move the edge against the triangle so that their line of intersection gets shorter.
Vec3 ClothContact::shortening(const Points3& nodes, const PiercedTriangle& piercing) const {
  const auto normal_of = [&](int f) {
    const Vec3 a = nodes.row(corner(f, 0)), b = nodes.row(corner(f, 1)), c = nodes.row(corner(f, 2));
    return Vec3((b - a).cross(c - a).normalized());
  };
  const Edge& edge = at(edges_, piercing.edge);
  const Vec3 p = nodes.row(edge.node[0]), q = nodes.row(edge.node[1]);
  const Vec3 along = (q - p).normalized(), normal = normal_of(piercing.triangle);
  Vec3 direction = Vec3::Zero();
  for (int f : edge.triangle) {
    if (f < 0) continue;
    Vec3 line = normal.cross(normal_of(f));
    if (!(line.norm() > 1e-9)) continue;
    line.normalize();
    int opposite = corner(f, 0);
    for (int k = 1; k < 3; ++k)
      if (opposite == edge.node[0] || opposite == edge.node[1]) opposite = corner(f, k);
    const Vec3 across = nodes.row(opposite).transpose() - p, inward = across - along * along.dot(across);
    if (line.dot(inward) < 0) line = -line;
    const double steep = along.dot(normal);
    direction += line - 2 * along.dot(line) * steep / std::max(steep * steep, 1e-4) * normal;
  }
  const double length = direction.norm();
  return length > 1e-9 ? Vec3(direction / length) : Vec3::Zero();
}

void ClothContact::add_push(const Points3& nodes, const PiercedTriangle& piercing) {
  const Edge& edge = at(edges_, piercing.edge);
  Pair pair;
  for (int k = 0; k < 3; ++k) {
    at(pair.node, k + 2) = corner(piercing.triangle, k);
    at(pair.weight, k + 2) = -piercing.barycentric[k];
  }
  pair.node[0] = edge.node[0], pair.node[1] = edge.node[1];
  pair.weight[0] = 1 - piercing.s, pair.weight[1] = piercing.s;
  pair.normal = shortening(nodes, piercing);
  pair.stiffness = options_.push_stiffness * 0.5 * (cloth_.node_area[edge.node[0]] + cloth_.node_area[edge.node[1]]);
  pair.offset = options_.push;
  pair.pushed = true;
  pair.of = -1 - piercing.edge;
  pairs_.push_back(pair);  // its points coincide: n . sum(weight x) is 0 here
}

void ClothContact::sort_planes() {
  std::stable_sort(planes_.begin(), planes_.end(), [](const Plane& a, const Plane& b) { return a.node < b.node; });
}

// dE/dg of the repulsion for unit stiffness, with E and the second derivative.
double ClothContact::slope(double gap, double& energy, double& curvature) const {
  const double d = options_.thickness, floor = kFloor * d, g = std::max(gap, floor);
  if (gap >= d) return energy = curvature = 0;
  const double slope_there = -d * (d - g) / g;
  curvature = d * d / (g * g);
  energy = d * (d * std::log(d / g) - (d - g)) + (gap - g) * (slope_there + 0.5 * curvature * (gap - g));
  return slope_there + curvature * (gap - g);
}

double ClothContact::gap_of(const Pair& pair, const Points3& nodes) const {
  Vec3 between = Vec3::Zero();
  for (std::size_t k = 0; k < 5; ++k) between += pair.weight[k] * nodes.row(pair.node[k]).transpose();
  return pair.normal.dot(between);
}

double ClothContact::energy_gradient(const Points3& nodes, Points3& gradient) const {
  double total = 0;
  for (const Pair& pair : pairs_) {
    const double gap = gap_of(pair, nodes);
    double energy = 0, curvature = 0, force = 0;
    if (pair.pushed) {
      force = std::min(0.0, gap - pair.offset);
      energy = 0.5 * force * force;
    } else {
      force = slope(gap, energy, curvature);
    }
    if (force == 0) continue;
    total += pair.stiffness * energy;
    for (std::size_t k = 0; k < 5; ++k)
      gradient.row(pair.node[k]) += (pair.stiffness * force * pair.weight[k] * pair.normal).transpose();
  }
  return total;
}

double ClothContact::stiffness_of(const Pair& pair, const Points3& nodes) const {
  const double gap = gap_of(pair, nodes);
  if (pair.pushed) return gap < pair.offset ? pair.stiffness : 0.0;
  double curvature = 0, ignored = 0;
  slope(gap, ignored, curvature);
  return pair.stiffness * curvature;
}

void ClothContact::add_hessian(const Points3& nodes, BlockHessian& hessian) const {
  for (const Pair& pair : pairs_) {
    const Mat3 block = stiffness_of(pair, nodes) * pair.normal * pair.normal.transpose();
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        if (const double weights = pair.weight[i] * pair.weight[j]; weights != 0)
          hessian.add(pair.node[i], pair.node[j], weights * block);
  }
}

void ClothContact::add_stiffness(const Points3& nodes, std::vector<Eigen::Triplet<double>>& entries) const {
  for (const Pair& pair : pairs_) {
    const double stiffness = stiffness_of(pair, nodes);
    if (stiffness <= 0) continue;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j)
        if (const double weights = pair.weight[i] * pair.weight[j]; pair.node[i] >= pair.node[j] && weights != 0)
          entries.emplace_back(pair.node[i], pair.node[j], stiffness * weights);
  }
}

void ClothContact::limit(const Points3& from, Points3& to) {
  const double ball = 0.49 * reach_;
  for (Eigen::Index i = 0; i < to.rows(); ++i) {
    const Vec3 seen = seen_at_.row(i), away = to.row(i).transpose() - seen;
    const double far = away.squaredNorm();
    if (far <= ball * ball) continue;
    stale_ = true;
    to.row(i) = (seen + ball / std::sqrt(far) * away).transpose();
  }
  for (std::size_t i = 0; i < planes_.size();) {
    std::size_t end = i;
    const int node = planes_[i].node;
    const Vec3 start = from.row(node);
    Vec3 p = to.row(node);
    for (; end < planes_.size() && planes_[end].node == node; ++end) {
      const double beyond = planes_[end].normal.dot(p) - planes_[end].offset;
      if (beyond < 0) p -= beyond * planes_[end].normal;
    }
    double share = 1;  // where planes meet, what is left is shortened as a whole
    for (std::size_t k = i; k < end; ++k) {
      const double ahead = planes_[k].normal.dot(p) - planes_[k].offset;
      if (ahead >= 0) continue;
      const double here = planes_[k].normal.dot(start) - planes_[k].offset;
      share = std::min(share, std::max(0.0, here / std::max(here - ahead, 1e-300)));
    }
    to.row(node) = (start + share * (p - start)).transpose();
    i = end;
  }
}

}  // namespace toile

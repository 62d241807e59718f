// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/layer_pairs.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/closest_features.h"
#include "engine/geometry/closest_point.h"

namespace toile {
namespace {

constexpr double kFloor = 0.1;         // share of the thickness below which the repulsion grows no stiffer
constexpr double kBlunt = 0.04;        // squared sine of the angle between two edges below which their pair fades
constexpr double kMostSwelling = 0.5;  // of the thickness, on either side: pairs are found from further away
constexpr double kSlack = 0.3;         // of the thickness above the floor in which swelling stays: it must come to rest
// Shares of what they lack or exceed, on either side, by which layers swell and shrink: they must carry the load within
// few rounds, and those that bounce must not lose all they had.
constexpr double kSwell = 1.0, kShrink = 0.5;
constexpr double kLeastWeight = 0.05;  // of a node in a closest point, for it to count as pressed
constexpr double kLeastGap = 1e-9;     // m: closer features have no direction between them

struct Profile {
  double energy = 0.0, slope = 0.0, curvature = 0.0;  // over k A
};

Profile repulsion(double gap, double d) {
  if (gap >= d) return {};
  const double g = std::max(gap, kFloor * d), slope = -d * (d - g) / g, curvature = d * d / (g * g), below = gap - g;
  return {d * (d * std::log(d / g) - (d - g)) + below * (slope + 0.5 * curvature * below), slope + curvature * below,
          curvature};
}

template <class Nodes, class Weights>
Vec3 difference(const Nodes& node, const Weights& weight, const Points3& nodes) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < node.size(); ++k) sum += weight[k] * nodes.row(node[k]).transpose();
  return sum;
}

template <class Nodes, class Weights>
void add_force(const Nodes& node, const Weights& weight, const Vec3& force, Points3& gradient) {
  for (std::size_t k = 0; k < node.size(); ++k) gradient.row(node[k]) += weight[k] * force.transpose();
}

std::pair<Vec3, Vec3> edges_of(const LayerPair& pair, const Points3& nodes) {
  return {nodes.row(pair.node[1]) - nodes.row(pair.node[0]), nodes.row(pair.node[3]) - nodes.row(pair.node[2])};
}

// 0 for parallel edges, 1 from `blunt` on, with the derivative by the squared area.
double fading(double squared_area, double blunt, double& slope) {
  const double x = squared_area / blunt;
  slope = x < 1 ? 2 * (1 - x) / blunt : 0.0;
  return x < 1 ? x * (2 - x) : 1.0;
}

}  // namespace

void LayerPairs::clear() {
  moving_.clear(), held_.clear(), pushes_.clear();
}

void LayerPairs::add(const LayerPair& pair, const Points3& nodes) {
  moving_.push_back({pair});
  if (pair.kind == LayerPair::Kind::VertexTriangle) return;
  const auto [u, v] = edges_of(pair, nodes);
  moving_.back().blunt = kBlunt * u.squaredNorm() * v.squaredNorm();
}

// Whether a plane across the direction found keeps the features further apart than their thickness.
bool LayerPairs::beyond(const Moving& pair, const Points3& nodes) {
  std::array<double, 4> along;
  for (std::size_t k = 0; k < 4; ++k) along[k] = nodes.row(pair.node[k]).dot(pair.normal);
  if (pair.kind == LayerPair::Kind::VertexTriangle)
    return along[0] - std::max({along[1], along[2], along[3]}) >= pair.thickness + pair.taken_up;
  return std::min(along[0], along[1]) - std::max(along[2], along[3]) >= pair.thickness + pair.taken_up;
}

LayerPairs::Closest LayerPairs::closest(const Moving& pair, const Points3& nodes) {
  const Vec3 a = nodes.row(pair.node[0]), b = nodes.row(pair.node[1]), c = nodes.row(pair.node[2]),
             d = nodes.row(pair.node[3]);
  Closest found;
  Vec3 apart;
  if (pair.kind == LayerPair::Kind::VertexTriangle) {
    const SurfacePoint nearest = closest_point_on_triangle(a, b, c, d);
    found.weight = {1, -nearest.barycentric[0], -nearest.barycentric[1], -nearest.barycentric[2]};
    apart = a - nearest.point;
  } else {
    const SegmentPair nearest = closest_points_of_segments(a, b, c, d);
    found.weight = {1 - nearest.s, nearest.s, nearest.t - 1, -nearest.t};
    apart = nearest.apart;
  }
  found.gap = apart.norm();
  found.normal = found.gap > kLeastGap ? Vec3(apart / found.gap) : pair.normal;
  return found;
}

double LayerPairs::share(const Moving& pair, const Points3& nodes) {
  if (pair.kind == LayerPair::Kind::VertexTriangle) return 1;
  const auto [u, v] = edges_of(pair, nodes);
  double ignored = 0;
  return fading(u.cross(v).squaredNorm(), pair.blunt, ignored);
}

void LayerPairs::hold(const Points3& nodes) {
  for (const Moving& pair : moving_) {
    const Closest c = closest(pair, nodes);
    held_.push_back(
        {pair.node, c.weight, c.normal, share(pair, nodes) * pair.stiffness, pair.thickness, pair.taken_up});
  }
  moving_.clear();
}

double LayerPairs::energy_gradient(const Points3& nodes, Points3& gradient) const {
  double total = 0;
  for (const Moving& pair : moving_)
    if (!beyond(pair, nodes)) total += add_moving(pair, nodes, gradient);
  for (const Held& pair : held_) {
    const Profile p =
        repulsion(pair.normal.dot(difference(pair.node, pair.weight, nodes)) - pair.taken_up, pair.thickness);
    total += pair.stiffness * p.energy;
    add_force(pair.node, pair.weight, pair.stiffness * p.slope * pair.normal, gradient);
  }
  for (const LayerPush& push : pushes_) {
    const double lack = std::min(0.0, push.normal.dot(difference(push.node, push.weight, nodes)) - push.offset);
    total += 0.5 * push.stiffness * lack * lack;
    add_force(push.node, push.weight, push.stiffness * lack * push.normal, gradient);
  }
  return total;
}

void LayerPairs::swell(const Points3& nodes, const std::vector<int>& image, Points3& swelling) const {
  struct Narrowest {
    double lack = 0, most = 0;  // m
    Vec3 side = Vec3::Zero();
    bool narrower(const Narrowest& other) const { return most > 0 && (other.most <= 0 || lack > other.lack); }
  };
  std::vector<Narrowest> narrowest(static_cast<std::size_t>(nodes.rows()));
  for (const Moving& pair : moving_) {
    if (beyond(pair, nodes)) continue;
    const Closest c = closest(pair, nodes);
    double lack = kFloor * pair.thickness - c.gap;
    if (lack < 0) lack = std::min(0.0, lack + kSlack * pair.thickness);
    for (std::size_t k = 0; k < 4; ++k) {
      Narrowest& at = narrowest[static_cast<std::size_t>(pair.node[k])];
      const Narrowest here = {lack, kMostSwelling * pair.thickness, c.weight[k] > 0 ? c.normal : Vec3(-c.normal)};
      if (std::abs(c.weight[k]) >= kLeastWeight && here.narrower(at)) at = here;
    }
  }
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Narrowest& there = narrowest[static_cast<std::size_t>(image[i])];
    if (there.narrower(narrowest[i]))
      narrowest[i] = {there.lack, there.most, {-there.side.x(), there.side.y(), there.side.z()}};
  }
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const Narrowest& at = narrowest[static_cast<std::size_t>(i)];
    const double so_far = std::max(0.0, swelling.row(i).dot(at.side));
    swelling.row(i) =
        std::clamp(so_far + (at.lack > 0 ? kSwell : kShrink) * at.lack, 0.0, at.most) * at.side.transpose();
  }
}

double LayerPairs::add_moving(const Moving& pair, const Points3& nodes, Points3& gradient) {
  const Closest c = closest(pair, nodes);
  const Profile p = repulsion(c.gap - pair.taken_up, pair.thickness);
  if (p.slope == 0) return 0;
  double kept = 1;
  if (pair.kind == LayerPair::Kind::EdgeEdge) {
    const auto [u, v] = edges_of(pair, nodes);
    const Vec3 across = u.cross(v);
    double slope = 0;
    kept = fading(across.squaredNorm(), pair.blunt, slope);
    if (slope > 0) {
      const double pull = 2 * slope * pair.stiffness * p.energy;
      const Vec3 by_u = pull * v.cross(across), by_v = pull * across.cross(u);
      gradient.row(pair.node[0]) -= by_u.transpose(), gradient.row(pair.node[1]) += by_u.transpose();
      gradient.row(pair.node[2]) -= by_v.transpose(), gradient.row(pair.node[3]) += by_v.transpose();
    }
  }
  add_force(pair.node, c.weight, kept * pair.stiffness * p.slope * c.normal, gradient);
  return kept * pair.stiffness * p.energy;
}

// visit(node, weight, normal, stiffness) for all that resist at `nodes`.
template <class Visit>
void LayerPairs::visit_stiff(const Points3& nodes, Visit visit) const {
  for (const Moving& pair : moving_) {
    if (beyond(pair, nodes)) continue;
    const Closest c = closest(pair, nodes);
    visit(pair.node, c.weight, c.normal,
          share(pair, nodes) * pair.stiffness * repulsion(c.gap - pair.taken_up, pair.thickness).curvature);
  }
  for (const Held& pair : held_)
    visit(pair.node, pair.weight, pair.normal,
          pair.stiffness *
              repulsion(pair.normal.dot(difference(pair.node, pair.weight, nodes)) - pair.taken_up, pair.thickness)
                  .curvature);
  for (const LayerPush& push : pushes_)
    if (push.normal.dot(difference(push.node, push.weight, nodes)) < push.offset)
      visit(push.node, push.weight, push.normal, push.stiffness);
}

void LayerPairs::add_hessian(const Points3& nodes, BlockHessian& hessian) const {
  visit_stiff(nodes, [&](const auto& node, const auto& weight, const Vec3& normal, double stiffness) {
    const Mat3 block = stiffness * normal * normal.transpose();
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        if (const double weights = weight[i] * weight[j]; weights != 0) hessian.add(node[i], node[j], weights * block);
  });
}

void LayerPairs::add_stiffness(const Points3& nodes, std::vector<Eigen::Triplet<double>>& entries) const {
  visit_stiff(nodes, [&](const auto& node, const auto& weight, const Vec3&, double stiffness) {
    if (stiffness <= 0) return;
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t j = 0; j < node.size(); ++j)
        if (const double weights = weight[i] * weight[j]; node[i] >= node[j] && weights != 0)
          entries.emplace_back(node[i], node[j], stiffness * weights);
  });
}

}  // namespace toile

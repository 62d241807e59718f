// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/edge_contact.h"

#include <algorithm>

namespace toile {
namespace {

constexpr double kSeen = 0.001;  // m the middle of an edge may lie inside unnoticed: the field is as good as that
constexpr double kSure = 0.5;    // of the way to there: as far a middle cannot have come, however steep the field

std::vector<std::pair<int, int>> edges_of(const Cloth& cloth) {
  std::vector<std::pair<int, int>> edges;
  for (const TriangleBlock& block : cloth.blocks)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (block.area[static_cast<Eigen::Index>(lane)] == 0) continue;
      for (std::size_t k = 0; k < 3; ++k)
        edges.push_back(std::minmax<int>(block.node[k][lane], block.node[(k + 1) % 3][lane]));
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

EdgeContact::EdgeContact(const Cloth& cloth, SignedField& field, const ContactOptions& options)
    : field_(field), options_(options) {
  Eigen::VectorXd area = cloth.node_area;
  for (const int n : cloth.middle) area[n] *= 2;
  const auto on_cut = [&](int n) { return std::binary_search(cloth.middle.begin(), cloth.middle.end(), n); };
  for (const auto& [a, b] : edges_of(cloth))  // of an edge along the cut one side counts
    edges_.push_back({a, b, (on_cut(a) && on_cut(b) ? 0.25 : 0.5) * (area[a] + area[b])});
}

Vec3 EdgeContact::middle(const Edge& edge, const Points3& nodes) {
  return 0.5 * (nodes.row(edge.a) + nodes.row(edge.b)).transpose();
}

double EdgeContact::depth(Edge& edge, const Points3& nodes, Vec3& normal) {
  return -field_.evaluate_again(middle(edge, nodes), 0.0, normal, edge.hint);
}

bool EdgeContact::look(const Points3& nodes) {
  const int before = count();
  Vec3 normal;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    Edge& e = edges_[k];
    if (e.kept || (middle(e, nodes) - e.looked_at).squaredNorm() < e.clear * e.clear) continue;
    const double inside = depth(e, nodes, normal);
    if (inside < kSeen) {
      e.looked_at = middle(e, nodes);
      e.clear = kSure * (kSeen - inside);
      continue;
    }
    e.kept = true;
    kept_.push_back(static_cast<int>(k));
  }
  return count() > before;
}

std::vector<Vec3> EdgeContact::inside(const Points3& nodes) {
  std::vector<Vec3> middles;
  Vec3 normal;
  for (int k : kept_)
    if (depth(edge(k), nodes, normal) > 0) middles.push_back(middle(edge(k), nodes));
  return middles;
}

double EdgeContact::energy_gradient(const Points3& nodes, Points3& gradient) {
  double energy = 0;
  Vec3 normal;
  for (int k : kept_) {
    Edge& e = edge(k);
    const double inside = depth(e, nodes, normal);
    if (inside <= 0) continue;
    double slope = 0;
    energy += stiffness(e) * contact_profile(inside, options_.linear_beyond, slope);
    const Vec3 force = 0.5 * stiffness(e) * slope * normal;
    gradient.row(e.a) -= force.transpose();
    gradient.row(e.b) -= force.transpose();
  }
  return energy;
}

void EdgeContact::add_hessian(const Points3& nodes, Curvature curvature, BlockHessian& hessian) {
  Vec3 normal;
  for (int k : kept_) {
    Edge& e = edge(k);
    const double inside = depth(e, nodes, normal);
    if (inside <= 0) continue;
    const Mat3 quarter = 0.25 * contact_hessian(stiffness(e), inside, options_.linear_beyond, normal,
                                                field_.hessian(middle(e, nodes)), curvature);
    hessian.add(e.a, e.a, quarter);
    hessian.add(e.b, e.b, quarter);
    hessian.add(e.b, e.a, quarter);
  }
}

void EdgeContact::add_stiffness(Eigen::VectorXd& diagonal) const {
  for (int k : kept_) {
    const Edge& e = edges_[static_cast<std::size_t>(k)];
    diagonal[e.a] += 0.5 * stiffness(e);
    diagonal[e.b] += 0.5 * stiffness(e);
  }
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/node_mirror.h"

#include "engine/sim/membrane.h"

namespace toile {
namespace {

constexpr double kEnlarged = 1.1;
constexpr double kAlike = 0.01;  // of the forces: rest shapes agree within micrometres, edges are millimetres long

}  // namespace

void symmetrise(const NodeMirror& mirror, Points3& rows) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::Index j = mirror.image[static_cast<std::size_t>(i)];
    if (j < i) continue;
    const Vec3 mean(0.5 * (rows(i, 0) - rows(j, 0)), 0.5 * (rows(i, 1) + rows(j, 1)), 0.5 * (rows(i, 2) + rows(j, 2)));
    rows.row(j) << -mean.x(), mean.y(), mean.z();
    rows.row(i) = mean.transpose();
  }
}

bool pulls_alike(const Cloth& cloth, const NodeMirror& mirror, const Points3& nodes) {
  Points3 pull = Points3::Zero(nodes.rows(), 3);
  membrane_energy_gradient(cloth, kEnlarged * nodes, pull);
  Points3 alike = pull;
  symmetrise(mirror, alike);
  return (pull - alike).norm() <= kAlike * pull.norm();
}

}  // namespace toile

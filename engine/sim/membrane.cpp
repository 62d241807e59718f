// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/membrane.h"

namespace toile {
namespace {

// Everything here is inlined, so that a block stays in registers from its corners to its forces.
struct Vector3Lanes {
  Lanes x, y, z;
};

[[gnu::always_inline]] inline Vector3Lanes corner(const TriangleBlock& block, std::size_t k, const double* nodes) {
  Vector3Lanes v;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double* p = nodes + 3 * static_cast<std::ptrdiff_t>(block.node[k][l]);
    const auto i = static_cast<Eigen::Index>(l);
    v.x[i] = p[0], v.y[i] = p[1], v.z[i] = p[2];
  }
  return v;
}

[[gnu::always_inline]] inline Vector3Lanes operator-(const Vector3Lanes& a, const Vector3Lanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Vector3Lanes combine(const Lanes& s, const Vector3Lanes& a, const Lanes& t,
                                                   const Vector3Lanes& b) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}
[[gnu::always_inline]] inline Lanes dot(const Vector3Lanes& a, const Vector3Lanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

[[gnu::always_inline]] inline void scatter(const TriangleBlock& block, std::size_t k, const Vector3Lanes& force,
                                           double* gradient) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    double* g = gradient + 3 * static_cast<std::ptrdiff_t>(block.node[k][l]);
    const auto i = static_cast<Eigen::Index>(l);
    g[0] += force.x[i], g[1] += force.y[i], g[2] += force.z[i];
  }
}

// Energy per area of one block and dE/dF per area, in place of (fu, fv).
[[gnu::always_inline]] inline Lanes stress(const Fabric& fabric, Vector3Lanes& fu, Vector3Lanes& fv) {
  const double ku = fabric.weft_stiffness, kv = fabric.warp_stiffness, ks = fabric.shear_stiffness;
  const Lanes uu = dot(fu, fu), vv = dot(fv, fv), uv = dot(fu, fv);
  const Lanes lu = (uu + kMembraneLeastLengthSquared).sqrt(), lv = (vv + kMembraneLeastLengthSquared).sqrt();
  const Lanes d = ((uu * vv - uv * uv).max(0.0) + kMembraneCollapse).sqrt();
  const Lanes trace = (uu + vv + 2 * d).sqrt();  // of the stretch tensor of the polar decomposition
  const Lanes s = ks / trace, s_by_d = s / d, cross = s_by_d * uv;
  const Lanes pu = ku * (1 - 1 / lu) + ks - s - s_by_d * vv, pv = kv * (1 - 1 / lv) + ks - s - s_by_d * uu;
  const Vector3Lanes stress_u = combine(pu, fu, cross, fv), stress_v = combine(pv, fv, cross, fu);
  fu = stress_u, fv = stress_v;
  return 0.5 * (ku * (lu - 1).square() + kv * (lv - 1).square() + ks * (uu + vv + 2 - 2 * trace));
}

}  // namespace

double membrane_energy_gradient(const Cloth& cloth, const Points3& nodes, Points3& gradient) {
  Lanes energy = Lanes::Zero();
  const double* x = nodes.data();
  double* g = gradient.data();
  for (const TriangleBlock& block : cloth.blocks) {
    const Vector3Lanes a = corner(block, 0, x), e1 = corner(block, 1, x) - a, e2 = corner(block, 2, x) - a;
    Vector3Lanes fu = combine(block.u1, e1, block.u2, e2), fv = combine(block.v1, e1, block.v2, e2);
    energy += block.area * stress(cloth.fabric, fu, fv);
    const Vector3Lanes g1 = combine(block.area * block.u1, fu, block.area * block.v1, fv);
    const Vector3Lanes g2 = combine(block.area * block.u2, fu, block.area * block.v2, fv);
    scatter(block, 0, {-g1.x - g2.x, -g1.y - g2.y, -g1.z - g2.z}, g);
    scatter(block, 1, g1, g);
    scatter(block, 2, g2, g);
  }
  return energy.sum();
}

SparseMatrix membrane_bound(const Cloth& cloth) {
  const double ku = cloth.fabric.weft_stiffness + cloth.fabric.shear_stiffness;
  const double kv = cloth.fabric.warp_stiffness + cloth.fabric.shear_stiffness;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(cloth.blocks.size() * kLanes * 6 + static_cast<std::size_t>(cloth.node_count));
  for (int i = 0; i < cloth.node_count; ++i) entries.emplace_back(i, i, 0.0);
  for (const TriangleBlock& block : cloth.blocks)
    for (Eigen::Index l = 0; l < kLanes; ++l) {
      if (block.area[l] == 0) continue;
      const double u[3] = {-block.u1[l] - block.u2[l], block.u1[l], block.u2[l]};
      const double v[3] = {-block.v1[l] - block.v2[l], block.v1[l], block.v2[l]};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          const int row = block.node[i][static_cast<std::size_t>(l)], col = block.node[j][static_cast<std::size_t>(l)];
          if (row >= col) entries.emplace_back(row, col, block.area[l] * (ku * u[i] * u[j] + kv * v[i] * v[j]));
        }
    }
  SparseMatrix matrix(cloth.node_count, cloth.node_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace toile

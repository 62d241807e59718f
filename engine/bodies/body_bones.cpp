// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_bones.h"

#include <algorithm>
#include <cassert>

#include "engine/bodies/find_arm.h"
#include "engine/geometry/surface_operators.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {
namespace {

constexpr double kSmoothing = 8.0;  // of the graph Laplacian: about three edges wide

// 0 below 0, 1 above 1, smooth between.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
// 0 well below `level`, 1 well above; `half` is half the width of the change.
double above(double y, double level, double half) {
  return smooth_step((y - level + half) / (2.0 * half));
}

struct ArmShare {
  double arm = 0.0, hand = 0.0, forearm = 0.0;  // shares of the whole; hand and forearm of the arm
};

// `q`: distance from the finger tip over the arm's length.
ArmShare arm_share(double q) {
  ArmShare s;
  s.arm = 1.0 - smooth_step((q - 0.88) / 0.36);
  s.hand = 1.0 - smooth_step((q - 0.26) / 0.10);
  s.forearm = 1.0 - smooth_step((q - 0.57) / 0.16) - s.hand;
  return s;
}

void add_leg(Eigen::Ref<Eigen::RowVectorXd> row, double y, double share, double h, double crotch, Side side) {
  const double foot = 1.0 - above(y, 0.09 * crotch, 0.02 * h);
  const double thigh = above(y, 0.60 * crotch, 0.05 * h);
  row[bone_of(Foot, side)] += share * foot;
  row[bone_of(Thigh, side)] += share * (1.0 - foot) * thigh;
  row[bone_of(Shin, side)] += share * (1.0 - foot) * (1.0 - thigh);
}

void add_trunk(Eigen::Ref<Eigen::RowVectorXd> row, double y, double share, const Skeleton& s) {
  const double over_waist = above(y, s.waist_y, 0.06 * s.height), over_armpit = above(y, s.armpit_y, 0.05 * s.height);
  const double head = above(y, s.neck_y, 0.02 * s.height);
  row[Pelvis] += share * (1.0 - over_waist);
  row[Abdomen] += share * over_waist * (1.0 - over_armpit);
  row[Chest] += share * over_waist * over_armpit * (1.0 - head);
  row[Head] += share * over_waist * over_armpit * head;
}

void normalise_rows(Eigen::MatrixXd& weights) {
  weights = weights.cwiseMax(0.0);
  for (Eigen::Index v = 0; v < weights.rows(); ++v) weights.row(v) /= weights.row(v).sum();
}

}  // namespace

Eigen::MatrixXd bone_weights(const TriangleMesh& body, const Skeleton& s) {
  const double h = s.height;
  const auto rings = find_arm_rings(body, h, s.armpit_y);
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(body.vertex_count(), kBoneCount);
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    auto row = weights.row(v);
    const double x = body.vertices(v, 0), y = body.vertices(v, 1);
    double rest = 1.0;
    for (const Side side : {Left, Right}) {
      const ArmShare arm = arm_share(std::min(rings[side].distance[v], 1e3) / s.arms[side].length);
      row[bone_of(Hand, side)] += arm.arm * arm.hand;
      row[bone_of(Forearm, side)] += arm.arm * arm.forearm;
      row[bone_of(UpperArm, side)] += arm.arm * (1.0 - arm.hand - arm.forearm);
      rest -= arm.arm;
    }
    rest = std::max(rest, 0.0);
    const double leg = rest * (1.0 - smooth_step((y - s.crotch_y + 0.05 * h) / (0.13 * h)));
    const double left = smooth_step((x / h + 0.012) / 0.024);
    Eigen::RowVectorXd mixed = row;
    add_leg(mixed, y, leg * left, h, s.crotch_y, Left);
    add_leg(mixed, y, leg * (1.0 - left), h, s.crotch_y, Right);
    add_trunk(mixed, y, rest - leg, s);
    row = mixed;
  }
  SparseMatrix system = kSmoothing * graph_laplacian(body);
  for (int i = 0; i < body.vertex_count(); ++i) system.coeffRef(i, i) += 1.0;
  SparseSolver solver;
  const bool solved = solver.factor(system);
  assert(solved);
  if (solved) weights = solver.solve(weights);
  normalise_rows(weights);
  return weights;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/trunk_sides.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/make_mannequin.h"

namespace toile {
namespace {

const TriangleMesh& man() {
  static const TriangleMesh surface = make_mannequin({{"height", 1.78}}, {.figure = Figure::Man}).body.surface;
  return surface;
}

const Skeleton& bones() {
  static const Skeleton skeleton = find_skeleton(man()).skeleton;
  return skeleton;
}

double step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double side_z() {
  return 0.5 * (bones().legs[Left].hip.z() + bones().arms[Left].centre_line.bottomRows(1)(0, 2));
}

// The same man with a belly: what lies in front of his sides, between pelvis and chest, further in front.
TriangleMesh with_belly(TriangleMesh body) {
  const double low = bones().pelvis.y(), high = bones().chest.y(), side = side_z();
  for (Eigen::Index v = 0; v < body.vertices.rows(); ++v) {
    const double up = (body.vertices(v, 1) - low) / (high - low), off = body.vertices(v, 2) - side;
    if (up <= 0.0 || up >= 1.0 || off <= 0.0 || std::abs(body.vertices(v, 0)) > 0.2) continue;
    body.vertices(v, 2) += 0.8 * off * step(4.0 * up * (1.0 - up));
  }
  return body;
}

// The same man leaning forward from the hips up.
TriangleMesh leaning(TriangleMesh body, double by) {
  const Vec3 hip = bones().legs[Left].hip;
  for (Eigen::Index v = 0; v < body.vertices.rows(); ++v) {
    const Vec3 off = body.vertices.row(v).transpose() - hip;
    const double a = by * step((off.y() + 0.05) / 0.10), c = std::cos(a), s = std::sin(a);
    body.vertices.row(v) = hip + Vec3(off.x(), c * off.y() - s * off.z(), s * off.y() + c * off.z());
  }
  return body;
}

Points3 fitted(const TriangleMesh& target) {
  return coarse_fit(man().vertices, bone_weights(man(), bones()), find_proportions(man(), bones()),
                    find_proportions(target, find_skeleton(target).skeleton));
}

// Mean error of one coordinate over the trunk's skin that `take` picks.
template <class Take>
double mean_error(const Points3& found, const TriangleMesh& truth, int coordinate, const Take& take) {
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index v = 0; v < found.rows(); ++v) {
    const Vec3 p = man().vertices.row(v);
    if (!take(p)) continue;
    sum += found(v, coordinate) - truth.vertices(v, coordinate), ++count;
  }
  EXPECT_GT(count, 20);
  return sum / count;
}

TEST(TrunkSides, DoNotSlideOnTheBodyItself) {
  const BodyProportions own = find_proportions(man(), bones());
  const TrunkSides sides(own, own);
  for (Eigen::Index v = 0; v < man().vertices.rows(); v += 50) {
    const Vec3 p = man().vertices.row(v);
    EXPECT_LT(sides.slide(p, sides.beside(p)).norm(), 1e-12);
  }
}

TEST(TrunkSides, StayWhereTheyAreBesideABelly) {
  const TriangleMesh stout = with_belly(man());
  const double waist = bones().waist.y(), side = side_z();
  const auto beside = [&](const Vec3& p) {
    return std::abs(p.y() - waist) < 0.06 && std::abs(p.z() - side) < 0.02 && std::abs(p.x()) < 0.2;
  };
  EXPECT_NEAR(mean_error(fitted(stout), stout, 2, beside), 0.0, 0.004);
}

TEST(TrunkSides, LeanAsTheTrunkDoes) {
  const TriangleMesh bent = leaning(man(), 0.15);
  const double chest = bones().chest.y(), side = side_z();
  const auto part = [&](double sign) {
    return [=](const Vec3& p) {
      return std::abs(p.y() - chest + 0.05) < 0.06 && sign * (p.z() - side) > 0.05 && std::abs(p.x()) < 0.06;
    };
  };
  const Points3 found = fitted(bent);
  EXPECT_NEAR(mean_error(found, bent, 1, part(1.0)) - mean_error(found, bent, 1, part(-1.0)), 0.0, 0.008);
}

}  // namespace
}  // namespace toile

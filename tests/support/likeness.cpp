// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/likeness.h"

#include <Eigen/SVD>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/measure_body.h"
#include "engine/geometry/closest_point.h"
#include "tests/support/shared_body.h"

namespace toile::test {
namespace {

// What a tailor can tell of the true body.
Measurements tape_of(const Body& body) {
  const Skeleton skeleton = find_skeleton(body.surface).skeleton;
  const Measurements all = measure_body(body.surface, skeleton).measurements;
  Measurements tape;
  for (const char* name :
       {"height", "chest_girth", "waist_girth", "belly_girth", "hip_girth", "thigh_girth", "inside_leg_length"})
    tape[name] = all.at(name);
  return tape;
}

// Vertices of trunk and legs: no head, arms or feet.
Points3 trunk_and_legs(const Body& body, double height) {
  std::vector<int> chosen;
  for (int v = 0; v < body.surface.vertex_count(); ++v) {
    const double y = body.surface.vertices(v, 1) / height, x = std::abs(body.surface.vertices(v, 0)) / height;
    if (y > 0.05 && y < 0.82 && x < 0.105 + 0.5 * std::max(0.0, 0.76 - y)) chosen.push_back(v);
  }
  return body.surface.vertices(chosen, Eigen::all);
}

// The rigid motion of `from` that brings its points nearest to `to`, row by row.
void move_onto(Points3& from, const Points3& to) {
  const Eigen::RowVector3d a = from.colwise().mean(), b = to.colwise().mean();
  const Mat3 cross = (from.rowwise() - a).transpose() * (to.rowwise() - b);
  const Eigen::JacobiSVD<Mat3> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 flip = Mat3::Identity();
  flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  from = ((from.rowwise() - a) * (svd.matrixU() * flip * svd.matrixV().transpose())).rowwise() + b;
}

// Mean distance of the points to the surface after the best rigid motion, by iterated closest points.
double mean_distance(Points3 points, const TriangleMesh& mesh) {
  constexpr int kRounds = 20;
  const SurfaceTree tree(mesh.vertices, mesh.triangles);
  Points3 nearest(points.rows(), 3);
  std::vector<int> start(static_cast<std::size_t>(points.rows()), -1);
  double sum = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    sum = 0.0;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      int& near = start[static_cast<std::size_t>(i)];
      const SurfacePoint found =
          tree.closest_point(points.row(i).transpose(), std::numeric_limits<double>::infinity(), near);
      near = found.triangle;
      nearest.row(i) = found.point.transpose();
      sum += found.distance();
    }
    move_onto(points, nearest);
  }
  return sum / static_cast<double>(points.rows());
}

}  // namespace

Likeness mannequin_of(const SharedPerson& person) {
  Likeness likeness;
  likeness.person = load_shared_body(person.name);
  const Measurements tape = tape_of(likeness.person);
  likeness.mannequin = make_mannequin(tape, {.figure = person.figure}).body;
  likeness.mean = mean_distance(trunk_and_legs(likeness.person, tape.at("height")), likeness.mannequin.surface);
  return likeness;
}

}  // namespace toile::test

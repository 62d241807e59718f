// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/position_based.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile {
namespace {

constexpr double kLeastLength = 1e-9;

struct Face {
  Eigen::Vector3i nodes;
  Mat2 inverse;                // Dm^-1 in the grain's frame
  std::array<Vec2, 3> corner;  // rest, from the centroid
};

struct Fold {
  int left, right;  // nodes opposite the shared edge
  double least;     // their distance at the fold limit, m
};

Vec2 turned(const Vec2& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

class PositionBased {
 public:
  PositionBased(const DrapeEnergy& garment, SignedField& field, double thickness, const Points3& start,
                const PositionBasedOptions& options)
      : garment_(garment),
        field_(field),
        thickness_(thickness),
        options_(options),
        x_(start),
        sum_(start),
        count_(Eigen::VectorXd::Zero(start.rows())) {
    for (const TriangleBlock& block : garment.cloth().blocks)
      for (Eigen::Index l = 0; l < kLanes; ++l)
        if (block.area[l] > 0) add_face(block, l);
    find_folds();
  }

  void iterate() {
    sum_.setZero();
    count_.setZero();
    for (const Face& face : faces_) add_targets(face);
    for (Eigen::Index i = 0; i < x_.rows(); ++i)
      if (count_[i] > 0) x_.row(i) = sum_.row(i) / count_[i];
    for (const Fold& fold : folds_) open_fold(fold);
    x_.col(1).array() -= options_.gravity * options_.time_step * options_.time_step;
    for (const Hold& hold : garment_.holds) x_(hold.node, 1) = std::max(x_(hold.node, 1), hold.height);
    for (const Pin& pin : garment_.pins) x_.row(pin.node) = pin.at.transpose();
    for (Eigen::Index i = 0; i < x_.rows(); ++i) push_out(i);
  }

  const Points3& nodes() const { return x_; }

 private:
  void add_face(const TriangleBlock& block, Eigen::Index l) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k)
      face.nodes[static_cast<Eigen::Index>(k)] = block.node[k][static_cast<std::size_t>(l)];
    face.inverse << block.u1[l], block.v1[l], block.u2[l], block.v2[l];
    const Mat2 edges = face.inverse.inverse();
    const Vec2 centre = (edges.col(0) + edges.col(1)) / 3;
    face.corner = {Vec2(-centre), Vec2(edges.col(0) - centre), Vec2(edges.col(1) - centre)};
    faces_.push_back(face);
  }

  // Distance of the wing tips when the two rest triangles are folded to the limit about their edge.
  void find_folds() {
    struct Half {
      std::pair<int, int> edge;
      int opposite;
      double height, along;  // of the opposite corner above the edge, and along it from the edge's first node
    };
    std::vector<Half> halves;
    for (const Face& face : faces_)
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>((k + 1) % 3), j = static_cast<std::size_t>((k + 2) % 3);
        const int a = face.nodes[static_cast<int>(i)], b = face.nodes[static_cast<int>(j)];
        const Vec2 first = a < b ? face.corner[i] : face.corner[j], last = a < b ? face.corner[j] : face.corner[i];
        const Vec2 d = (last - first).normalized(), p = face.corner[static_cast<std::size_t>(k)] - first;
        halves.push_back({std::minmax({a, b}), face.nodes[k], std::abs(d.x() * p.y() - d.y() * p.x()), d.dot(p)});
      }
    std::stable_sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) { return a.edge < b.edge; });
    for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
      const Half &l = halves[i], &r = halves[i + 1];
      if (l.edge != r.edge || l.opposite == r.opposite) continue;
      const double across = std::sqrt(l.height * l.height + r.height * r.height +
                                      2 * l.height * r.height * std::cos(options_.fold_limit));
      folds_.push_back({l.opposite, r.opposite, std::hypot(across, l.along - r.along)});
    }
  }

  // The corrected Jacobian of [Eggler2024, Sec. 7]: lengths within delta of 1, angle within rho of a right one.
  Mat2 corrected(const Mat2& j) const {
    const double low = 1 - options_.fibre_slack, high = 1 + options_.fibre_slack;
    const Vec2 u = j.col(0) / std::max(j.col(0).norm(), kLeastLength),
               v = j.col(1) / std::max(j.col(1).norm(), kLeastLength);
    const double right_angle = std::numbers::pi / 2;
    const double angle = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
    const double wanted = std::clamp(angle, right_angle - options_.shear_limit, right_angle + options_.shear_limit);
    const double half = 0.5 * (wanted - angle);  // both fibres turn by the same amount
    Mat2 result;
    result.col(0) = std::clamp(j.col(0).norm(), low, high) * turned(u, -half);
    result.col(1) = std::clamp(j.col(1).norm(), low, high) * turned(v, half);
    return result;
  }

  void add_targets(const Face& face) {
    const Vec3 a = x_.row(face.nodes[0]), e1 = x_.row(face.nodes[1]).transpose() - a,
               e2 = x_.row(face.nodes[2]).transpose() - a;
    const Vec3 normal = e1.cross(e2);
    if (normal.norm() < kLeastLength * kLeastLength) return;
    Eigen::Matrix<double, 3, 2> frame;
    frame.col(0) = e1.normalized();
    frame.col(1) = normal.normalized().cross(frame.col(0));
    Mat2 edges;
    edges << frame.transpose() * e1, frame.transpose() * e2;
    const Mat2 jacobian = corrected(edges * face.inverse);
    const Vec2 middle = (edges.col(0) + edges.col(1)) / 3;
    const std::array<Vec2, 3> now = {Vec2(-middle), Vec2(edges.col(0) - middle), Vec2(edges.col(1) - middle)};
    double cosine = 0, sine = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 q = jacobian * face.corner[k];
      cosine += q.dot(now[k]), sine += q.x() * now[k].y() - q.y() * now[k].x();
    }
    const double angle = std::atan2(sine, cosine);
    const Vec3 centre = a + (e1 + e2) / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const int node = face.nodes[static_cast<int>(k)];
      sum_.row(node) += (centre + frame * turned(jacobian * face.corner[k], angle)).transpose();
      count_[node] += 1;
    }
  }

  void open_fold(const Fold& fold) {
    const Vec3 gap = (x_.row(fold.right) - x_.row(fold.left)).transpose();
    const double length = gap.norm();
    if (length >= fold.least || length < kLeastLength) return;
    const Vec3 move = 0.25 * (fold.least - length) / length * gap;
    x_.row(fold.left) -= move.transpose();
    x_.row(fold.right) += move.transpose();
  }

  void push_out(Eigen::Index i) {
    Vec3 gradient;
    const double depth = thickness_ - field_.evaluate(x_.row(i), thickness_, gradient);
    if (depth > 0) x_.row(i) += (depth / std::max(gradient.norm(), 0.1) * gradient.normalized()).transpose();
  }

  const DrapeEnergy& garment_;
  SignedField& field_;
  double thickness_;
  const PositionBasedOptions& options_;
  std::vector<Face> faces_;
  std::vector<Fold> folds_;
  Points3 x_, sum_;
  Eigen::VectorXd count_;
};

}  // namespace

Points3 position_based(const DrapeEnergy& garment, SignedField& field, double thickness, const Points3& start,
                       const PositionBasedOptions& options, Progress* progress) {
  PositionBased solver(garment, field, thickness, start, options);
  for (int i = 0; i < options.iterations; ++i) {
    check_cancelled(progress);
    solver.iterate();
  }
  return solver.nodes();
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/unfold_triangles.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace toile {
namespace {

constexpr int kMemory = 8;  // pairs of L-BFGS
constexpr int kInnerSteps = 60, kOuterRounds = 40;
constexpr int kMostRings = 64;  // of triangles round the inverted ones; all of a panel

// Least margin: the barrier is driven until determinants are this many times the least that is asked for.
constexpr double kMargin = 2.0;

class Unfolder {
 public:
  Unfolder(const TriangleGradients& undeformed, std::vector<int> faces, std::vector<int> free, Points2& positions)
      : mesh_(undeformed), faces_(std::move(faces)), free_(std::move(free)), positions_(positions) {}

  // True when every determinant has reached `least`.
  bool run(double least) {
    double epsilon = 1.0;
    Eigen::VectorXd x = gathered();
    double energy = evaluate(x, epsilon, nullptr);
    for (int round = 0; round < kOuterRounds; ++round) {
      const double before = energy;
      minimise(x, epsilon);
      const double worst = least_determinant(x);
      if (worst >= kMargin * least) break;
      const double gained = std::max(0.1, 1.0 - evaluate(x, epsilon, nullptr) / before);
      const double root = std::hypot(worst, epsilon);
      epsilon *=
          worst >= 0.0 ? 1.0 - std::min(gained, 0.9) : 1.0 - std::min(gained, 0.9) * root / (std::abs(worst) + root);
      energy = evaluate(x, epsilon, nullptr);
    }
    scatter(x);
    return least_determinant(x) >= least;
  }

 private:
  Eigen::VectorXd gathered() const {
    Eigen::VectorXd x(2 * static_cast<Eigen::Index>(free_.size()));
    for (std::size_t i = 0; i < free_.size(); ++i)
      x.segment<2>(2 * static_cast<Eigen::Index>(i)) = positions_.row(free_[i]).transpose();
    return x;
  }
  void scatter(const Eigen::VectorXd& x) {
    for (std::size_t i = 0; i < free_.size(); ++i)
      positions_.row(free_[i]) = x.segment<2>(2 * static_cast<Eigen::Index>(i)).transpose();
  }

  double least_determinant(const Eigen::VectorXd& x) {
    scatter(x);
    double least = std::numeric_limits<double>::infinity();
    for (const int f : faces_) least = std::min(least, mesh_.of(positions_, f).determinant());
    return least;
  }

  double evaluate(const Eigen::VectorXd& x, double epsilon, Eigen::VectorXd* gradient) {
    scatter(x);
    if (gradient) forces_.setZero(positions_.rows(), 2);
    double energy = 0.0;
    for (const int f : faces_) {
      const Mat2 g = mesh_.of(positions_, f);
      const double det = g.determinant(), root = std::hypot(det, epsilon), chi = 0.5 * (det + root);
      if (!(chi > 0.0)) return std::numeric_limits<double>::infinity();
      const double area = mesh_.area[f], top = g.squaredNorm() + det * det + 1.0;
      energy += area * top / chi;
      if (!gradient) continue;
      const Mat2 cofactor = (Mat2() << g(1, 1), -g(1, 0), -g(0, 1), g(0, 0)).finished();
      const Mat2 slope = area * ((2.0 * g + 2.0 * det * cofactor) / chi - top / (chi * root) * cofactor);
      const Eigen::Matrix<double, 3, 2> weights = mesh_.corner_weights(f);
      for (int k = 0; k < 3; ++k)
        forces_.row(mesh_.triangles(f, k)) += (slope * weights.row(k).transpose()).transpose();
    }
    if (gradient)
      for (std::size_t i = 0; i < free_.size(); ++i)
        gradient->segment<2>(2 * static_cast<Eigen::Index>(i)) = forces_.row(free_[i]).transpose();
    return energy;
  }

  void minimise(Eigen::VectorXd& x, double epsilon) {
    std::deque<std::pair<Eigen::VectorXd, Eigen::VectorXd>> pairs;  // steps and changes of the gradient
    Eigen::VectorXd gradient(x.size()), next_gradient(x.size());
    double energy = evaluate(x, epsilon, &gradient);
    for (int step = 0; step < kInnerSteps && gradient.norm() > 0.0; ++step) {
      const Eigen::VectorXd direction = -two_loop(pairs, gradient);
      double length = pairs.empty() ? first_length(direction) : 1.0;
      Eigen::VectorXd next = x;
      double next_energy = std::numeric_limits<double>::infinity();
      for (int halving = 0; halving < 30; ++halving, length *= 0.5) {
        next = x + length * direction;
        next_energy = evaluate(next, epsilon, &next_gradient);
        if (next_energy <= energy + 1e-4 * length * gradient.dot(direction)) break;
      }
      if (!(next_energy < energy)) break;
      const Eigen::VectorXd moved = next - x, change = next_gradient - gradient;
      if (moved.dot(change) > 0.0) pairs.emplace_back(moved, change);
      if (pairs.size() > kMemory) pairs.pop_front();
      const bool done = energy - next_energy < 1e-9 * energy;
      x = next;
      energy = next_energy;
      gradient = next_gradient;
      if (done) break;
    }
  }

  // The first step moves no vertex farther than a small share of a triangle.
  double first_length(const Eigen::VectorXd& direction) const {
    double area = 0.0;
    for (const int f : faces_) area += mesh_.area[f];
    const double edge = std::sqrt(area / static_cast<double>(faces_.size()));
    return 0.1 * edge / std::max(direction.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  }

  static Eigen::VectorXd two_loop(const std::deque<std::pair<Eigen::VectorXd, Eigen::VectorXd>>& pairs,
                                  const Eigen::VectorXd& gradient) {
    Eigen::VectorXd q = gradient;
    std::vector<double> along(pairs.size());
    for (std::size_t i = pairs.size(); i-- > 0;) {
      along[i] = pairs[i].first.dot(q) / pairs[i].first.dot(pairs[i].second);
      q -= along[i] * pairs[i].second;
    }
    if (!pairs.empty()) q *= pairs.back().first.dot(pairs.back().second) / pairs.back().second.squaredNorm();
    for (std::size_t i = 0; i < pairs.size(); ++i)
      q += (along[i] - pairs[i].second.dot(q) / pairs[i].first.dot(pairs[i].second)) * pairs[i].first;
    return q;
  }

  const TriangleGradients& mesh_;
  std::vector<int> faces_, free_;
  Points2& positions_;
  Points2 forces_;
};

std::vector<bool> inverted(const TriangleGradients& mesh, const Points2& positions, double least) {
  std::vector<bool> bad(static_cast<std::size_t>(mesh.triangle_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f)
    bad[static_cast<std::size_t>(f)] = mesh.of(positions, f).determinant() < least;
  return bad;
}

int count(const std::vector<bool>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

// Triangles that share a vertex with one of `faces`, those included.
std::vector<bool> grown(const TriangleGradients& mesh, const std::vector<bool>& faces, std::size_t vertices) {
  std::vector<bool> touched(vertices);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3 && faces[f]; ++k)
      touched[static_cast<std::size_t>(mesh.triangles(static_cast<Eigen::Index>(f), k))] = true;
  std::vector<bool> result = faces;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      result[f] = result[f] || touched[static_cast<std::size_t>(mesh.triangles(static_cast<Eigen::Index>(f), k))];
  return result;
}

}  // namespace

UnfoldResult unfold_triangles(const TriangleGradients& undeformed, const std::vector<bool>& held, double least,
                              Points2& positions) {
  UnfoldResult result;
  const std::vector<bool> bad = inverted(undeformed, positions, least);
  result.inverted_before = result.inverted_after = count(bad);
  if (result.inverted_before == 0) return result;
  const Points2 start = positions;
  std::vector<bool> region = bad;
  for (int rings = 1; rings <= kMostRings && result.inverted_after > 0; rings *= 2) {
    for (int ring = rings / 2; ring < rings; ++ring) region = grown(undeformed, region, held.size());
    std::vector<int> faces, free;
    std::vector<bool> is_free(held.size());
    for (std::size_t f = 0; f < region.size(); ++f)
      for (int k = 0; k < 3 && region[f]; ++k)
        is_free[static_cast<std::size_t>(undeformed.triangles(static_cast<Eigen::Index>(f), k))] = true;
    for (std::size_t v = 0; v < held.size(); ++v)
      if (is_free[v] && !held[v]) free.push_back(static_cast<int>(v));
    const std::vector<bool> around = grown(undeformed, region, held.size());
    for (std::size_t f = 0; f < around.size(); ++f)
      if (around[f]) faces.push_back(static_cast<int>(f));
    if (free.empty()) continue;
    positions = start;
    Unfolder(undeformed, std::move(faces), free, positions).run(least);
    result.inverted_after = count(inverted(undeformed, positions, least));
    result.moved_vertices = static_cast<int>(free.size());
  }
  return result;
}

}  // namespace toile

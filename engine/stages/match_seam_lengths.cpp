// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/match_seam_lengths.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "engine/geometry/curve.h"

namespace toile {

namespace {

constexpr int kNewtonSteps = 6;
constexpr double kGoodEnough = 1e-7;      // m
constexpr double kDifference = 1e-6;      // m; step of the central differences
constexpr double kRegularisation = 1e-9;  // keeps seams between locked edges solvable
constexpr double kLongestStep = 2e-3;     // m; what is off by more is not a rounding of the fit

// Every coordinate that may move, as a pointer into the pattern.
class Unknowns {
 public:
  Unknowns(Pattern& pattern, const SideRules& rules) {
    for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
      Panel& panel = pattern.panels[p];
      const std::size_t n = panel.edges.size();
      std::vector<int> corner(n, -1);
      for (std::size_t c = 0; c < n; ++c) {
        if (!rules[p][c].locked && !rules[p][(c + n - 1) % n].locked) corner[c] = add(panel.corners[c]);
      }
      corners_.push_back(std::move(corner));
      shapes_.emplace_back();
      for (std::size_t e = 0; e < n; ++e) shapes_.back().push_back(rules[p][e].locked ? -1 : add(panel.edges[e].curve));
    }
  }

  int size() const { return static_cast<int>(values_.size()); }
  double& value(int i) { return *values_[static_cast<std::size_t>(i)]; }

  // Numbers of the unknowns that the length of an edge depends on.
  std::vector<int> of_edge(const Pattern& pattern, const SeamSide& side) const {
    const auto p = static_cast<std::size_t>(side.panel.value), e = static_cast<std::size_t>(side.edge);
    std::vector<int> numbers;
    for (const int first : {corners_[p][e], corners_[p][(e + 1) % corners_[p].size()]})
      if (first >= 0) numbers.insert(numbers.end(), {first, first + 1});
    if (shapes_[p][e] < 0) return numbers;
    for (int k = 0; k < shape_size(pattern.edge(side).curve.kind); ++k) numbers.push_back(shapes_[p][e] + k);
    return numbers;
  }

 private:
  static int shape_size(CurveKind kind) {
    switch (kind) {
      case CurveKind::QuadraticBezier: return 2;
      case CurveKind::CubicBezier: return 4;
      case CurveKind::Arc: return 1;
      default: return 0;
    }
  }
  int add(Vec2& point) {
    values_.insert(values_.end(), {&point.x(), &point.y()});
    return size() - 2;
  }
  int add(EdgeCurve& curve) {
    const int first = size();
    if (curve.kind == CurveKind::Arc) values_.push_back(&curve.radius);
    for (int k = 0; k < shape_size(curve.kind) / 2; ++k) add(curve.control[static_cast<std::size_t>(k)]);
    return first;
  }

  std::vector<double*> values_;
  std::vector<std::vector<int>> corners_, shapes_;  // per panel and corner or edge; -1: held
};

double length_of(const Pattern& pattern, const SeamSide& side) {
  return edge_length(pattern.panel(side.panel), side.edge);
}

Eigen::VectorXd mismatches(const Pattern& pattern, const std::vector<double>& ratios) {
  Eigen::VectorXd c(static_cast<Eigen::Index>(ratios.size()));
  for (std::size_t s = 0; s < ratios.size(); ++s) {
    const Seam& seam = pattern.seams[s];
    c[static_cast<Eigen::Index>(s)] = length_of(pattern, seam.a) - ratios[s] * length_of(pattern, seam.b);
  }
  return c;
}

Eigen::SparseMatrix<double> jacobian(Pattern& pattern, Unknowns& unknowns, const std::vector<double>& ratios) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int s = 0; s < static_cast<int>(ratios.size()); ++s) {
    const Seam& seam = pattern.seams[static_cast<std::size_t>(s)];
    const auto differentiate = [&](const SeamSide& side, double factor) {
      for (const int i : unknowns.of_edge(pattern, side)) {
        const double before = unknowns.value(i);
        unknowns.value(i) = before + kDifference;
        const double above = length_of(pattern, side);
        unknowns.value(i) = before - kDifference;
        const double below = length_of(pattern, side);
        unknowns.value(i) = before;
        entries.emplace_back(s, i, factor * (above - below) / (2.0 * kDifference));
      }
    };
    differentiate(seam.a, 1.0);
    differentiate(seam.b, -ratios[static_cast<std::size_t>(s)]);
  }
  Eigen::SparseMatrix<double> j(static_cast<Eigen::Index>(ratios.size()), unknowns.size());
  j.setFromTriplets(entries.begin(), entries.end());
  return j;
}

}  // namespace

double match_seam_lengths(Pattern& pattern, const std::vector<double>& ratios, const SideRules& rules) {
  if (ratios.empty()) return 0.0;
  Unknowns unknowns(pattern, rules);
  Eigen::VectorXd c = mismatches(pattern, ratios);
  for (int step = 0; step < kNewtonSteps && c.cwiseAbs().maxCoeff() > kGoodEnough; ++step) {
    const Eigen::SparseMatrix<double> j = jacobian(pattern, unknowns, ratios);
    Eigen::SparseMatrix<double> normal = j * j.transpose();
    for (int s = 0; s < normal.rows(); ++s) normal.coeffRef(s, s) += kRegularisation;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
    const Eigen::VectorXd limited = c.cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
    const Eigen::VectorXd move = -(j.transpose() * factor.solve(limited));
    for (int i = 0; i < unknowns.size(); ++i) unknowns.value(i) += move[i];
    c = mismatches(pattern, ratios);
  }
  return c.cwiseAbs().maxCoeff();
}

}  // namespace toile

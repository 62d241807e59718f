// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/edge_terms.h"

#include <algorithm>

namespace toile {
namespace {

// Mesh edges shorter than this carry no direction worth keeping, m.
constexpr double kLeastLength = 1e-6;

Vec2 vector_of(const Points2& rest, const EdgeTerm& term) {
  return rest.row(term.to) - rest.row(term.from);
}

bool sewn(const Pattern& pattern, const SeamSide& side) {
  return std::any_of(pattern.seams.begin(), pattern.seams.end(),
                     [&](const Seam& seam) { return seam.a == side || seam.b == side; });
}

bool locked(const Pattern& pattern, const SeamSide& side) {
  const PanelEdge& edge = pattern.edge(side);
  return pattern.panel(side.panel).locked || edge.locked || edge.zip;
}

bool stays_straight(const Pattern& pattern, const SeamSide& side, bool detect) {
  const PanelEdge& edge = pattern.edge(side);
  if (edge.straight) return *edge.straight;
  return edge.on_fold || (detect && edge.curve.kind == CurveKind::Line && !sewn(pattern, side));
}

}  // namespace

EdgeTerms::EdgeTerms(const Pattern& pattern, const PatternMesh& mesh, bool keep_straight) {
  add_seams(pattern, mesh);
  for (std::size_t p = 0; p < mesh.edge_vertices.size(); ++p)
    for (std::size_t k = 0; k < mesh.edge_vertices[p].size(); ++k) {
      const SeamSide side{PanelId(static_cast<int>(p)), static_cast<int>(k)};
      if (pattern.panel(side.panel).locked) continue;  // its vertices are held
      const bool rigid = locked(pattern, side);
      if (rigid || stays_straight(pattern, side, keep_straight)) add_run(mesh.edge_vertices[p][k], mesh.rest, rigid);
    }
}

void EdgeTerms::add_seams(const Pattern& pattern, const PatternMesh& mesh) {
  seam_ratio_.assign(mesh.seam_vertices.size(), 0.0);
  for (std::size_t s = 0; s < mesh.seam_vertices.size(); ++s) {
    const auto& seam = mesh.seam_vertices[s];
    const bool fixed_a = locked(pattern, pattern.seams[s].a), fixed_b = locked(pattern, pattern.seams[s].b);
    double length_a = 0.0, length_b = 0.0;
    for (std::size_t i = 1; i < seam.size(); ++i) {
      const EdgeTerm a{seam[i - 1].first, seam[i].first}, b{seam[i - 1].second, seam[i].second};
      const double la = vector_of(mesh.rest, a).norm(), lb = vector_of(mesh.rest, b).norm();
      if (la < kLeastLength || lb < kLeastLength) continue;
      length_a += la;
      length_b += lb;
      pairs_.push_back({static_cast<int>(terms_.size()), static_cast<int>(terms_.size()) + 1, la / lb,
                        fixed_a ? la : 0.0, fixed_b ? lb : 0.0, static_cast<int>(s)});
      terms_.push_back(a);
      terms_.push_back(b);
    }
    if (length_b > 0.0) seam_ratio_[s] = length_a / length_b;
  }
}

void EdgeTerms::add_run(const std::vector<int>& vertices, const Points2& rest, bool rigid) {
  Run run{static_cast<int>(terms_.size()), 0, rigid, {}};
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const EdgeTerm term{vertices[i - 1], vertices[i]};
    terms_.push_back(term);
    run.shape.push_back(vector_of(rest, term));
  }
  run.end = static_cast<int>(terms_.size());
  if (run.end > run.begin) runs_.push_back(std::move(run));
}

void EdgeTerms::update(const Points2& rest) {
  for (const Pair& pair : pairs_) update_pair(rest, pair);
  for (const Run& run : runs_) update_run(rest, run);
}

// Nearest lengths (la*, lb*) with la* = r lb*, each along its present direction; a locked ply keeps its length.
void EdgeTerms::update_pair(const Points2& rest, const Pair& pair) {
  EdgeTerm &a = terms_[static_cast<std::size_t>(pair.a)], &b = terms_[static_cast<std::size_t>(pair.b)];
  const Vec2 ea = vector_of(rest, a), eb = vector_of(rest, b);
  const double la = ea.norm(), lb = eb.norm(), r = pair.ratio;
  if (la < kLeastLength || lb < kLeastLength) return;  // keep the last wanted vectors
  double best_b = (r * la + lb) / (1.0 + r * r);
  if (pair.fixed_a > 0.0) best_b = pair.fixed_a / r;
  if (pair.fixed_b > 0.0) best_b = pair.fixed_b;
  a.wanted = ea * (r * best_b / la);
  b.wanted = eb * (best_b / lb);
}

void EdgeTerms::update_run(const Points2& rest, const Run& run) {
  const auto begin = static_cast<std::size_t>(run.begin), end = static_cast<std::size_t>(run.end);
  if (run.rigid) {  // the one rotation that carries the reference vectors nearest to the present ones
    double c = 0.0, s = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 now = vector_of(rest, terms_[i]), shape = run.shape[i - begin];
      c += shape.dot(now);
      s += shape.x() * now.y() - shape.y() * now.x();
    }
    const double length = std::hypot(c, s);
    if (!(length > 0.0)) return;
    const Mat2 turn = (Mat2() << c, -s, s, c).finished() / length;
    for (std::size_t i = begin; i < end; ++i) terms_[i].wanted = turn * run.shape[i - begin];
    return;
  }
  Mat2 moment = Mat2::Zero();  // the common direction that keeps most of every vector: largest eigenvector
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 now = vector_of(rest, terms_[i]);
    moment += now * now.transpose();
  }
  const Vec2 direction = Eigen::SelfAdjointEigenSolver<Mat2>(moment).eigenvectors().col(1);
  for (std::size_t i = begin; i < end; ++i) terms_[i].wanted = direction * direction.dot(vector_of(rest, terms_[i]));
}

double EdgeTerms::energy(const Points2& rest) const {
  double sum = 0.0;
  for (const EdgeTerm& term : terms_) sum += (vector_of(rest, term) - term.wanted).squaredNorm();
  return sum;
}

double EdgeTerms::pair_residual(const Points2& rest) const {
  double worst = 0.0;
  for (const Pair& pair : pairs_) {
    const double la = vector_of(rest, terms_[static_cast<std::size_t>(pair.a)]).norm();
    const double lb = vector_of(rest, terms_[static_cast<std::size_t>(pair.b)]).norm();
    worst = std::max(worst, std::abs(la - pair.ratio * lb));
  }
  return worst;
}

double EdgeTerms::side_residual(const Points2& rest) const {
  std::vector<double> difference(seam_ratio_.size(), 0.0);
  for (const Pair& pair : pairs_) {
    const auto seam = static_cast<std::size_t>(pair.seam);
    difference[seam] += vector_of(rest, terms_[static_cast<std::size_t>(pair.a)]).norm() -
                        seam_ratio_[seam] * vector_of(rest, terms_[static_cast<std::size_t>(pair.b)]).norm();
  }
  double worst = 0.0;
  for (const double d : difference) worst = std::max(worst, std::abs(d));
  return worst;
}

}  // namespace toile

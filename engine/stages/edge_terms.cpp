// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/edge_terms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile {
namespace {

// Mesh edges shorter than this carry no direction worth keeping, m.
constexpr double kLeastLength = 1e-6;

Vec2 vector_of(const Points2& rest, const EdgeTerm& term) {
  return rest.row(term.to) - rest.row(term.from);
}

constexpr double kRigid = 100.0;  // stiffness of a locked side: it yields to no seam
constexpr double kLeastOpening = 0.005;  // rad between the legs of a dart: 1 mm at 20 cm

}  // namespace

EdgeTerms::EdgeTerms(const Pattern& pattern, const PatternMesh& mesh, const SideRules& rules) {
  add_seams(pattern, mesh, rules);
  for (int p = 0; p < static_cast<int>(mesh.edge_vertices.size()); ++p) add_runs(mesh, rules, p);
}

void EdgeTerms::add_seams(const Pattern& pattern, const PatternMesh& mesh, const SideRules& rules) {
  const auto locked = [&](const SeamSide& side) {
    return rules[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)].locked;
  };
  seam_ratio_.assign(mesh.seam_vertices.size(), 0.0);
  for (std::size_t s = 0; s < mesh.seam_vertices.size(); ++s) {
    const auto& seam = mesh.seam_vertices[s];
    const bool fixed_a = locked(pattern.seams[s].a), fixed_b = locked(pattern.seams[s].b);
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

void EdgeTerms::add_runs(const PatternMesh& mesh, const SideRules& rules, int panel) {
  const auto& sides = rules[static_cast<std::size_t>(panel)];
  const auto& edges = mesh.edge_vertices[static_cast<std::size_t>(panel)];
  std::vector<int> run_of(sides.size(), -1);
  for (std::size_t e = 0; e < sides.size(); ++e)
    if (sides[e].locked || sides[e].straight) run_of[e] = add_run(edges[e], mesh.rest, sides[e].locked);
  for (std::size_t e = 0; e < sides.size(); ++e) {
    const std::size_t next = (e + 1) % sides.size();
    if (sides[e].dart_tip != static_cast<int>(next) || run_of[e] < 0 || run_of[next] < 0) continue;
    if (sides[e].locked || sides[next].locked) continue;
    darts_.push_back({run_of[e], run_of[next], mesh.panel_reversed[static_cast<std::size_t>(panel)] ? -1.0 : 1.0});
  }
}

int EdgeTerms::add_run(const std::vector<int>& vertices, const Points2& rest, bool rigid) {
  if (vertices.size() < 2) return -1;
  Run run{static_cast<int>(terms_.size()), 0, rigid, {}};
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const EdgeTerm term{vertices[i - 1], vertices[i], rigid ? kRigid : 1.0};
    terms_.push_back(term);
    run.shape.push_back(vector_of(rest, term));
  }
  run.end = static_cast<int>(terms_.size());
  runs_.push_back(std::move(run));
  return static_cast<int>(runs_.size()) - 1;
}

void EdgeTerms::update(const Points2& rest) {
  for (const Pair& pair : pairs_) update_pair(rest, pair);
  for (const Run& run : runs_)
    if (run.rigid)
      turn_rigid(rest, run);
    else
      straighten(rest, run, line_through(rest, run).angle);
  for (const Dart& dart : darts_) open_dart(rest, dart);
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

// The one rotation that carries the reference vectors nearest to the present ones.
void EdgeTerms::turn_rigid(const Points2& rest, const Run& run) {
  const auto begin = static_cast<std::size_t>(run.begin), end = static_cast<std::size_t>(run.end);
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
}

// The vectors' moment has its largest eigenvalue along the line; as a function of the line's angle, what it keeps is
// constant + sharpness * cos 2 (angle - best).
EdgeTerms::Line EdgeTerms::line_through(const Points2& rest, const Run& run) const {
  double c = 0.0, s = 0.0;
  Vec2 whole = Vec2::Zero();
  for (int i = run.begin; i < run.end; ++i) {
    const Vec2 now = vector_of(rest, terms_[static_cast<std::size_t>(i)]);
    c += now.x() * now.x() - now.y() * now.y();
    s += 2.0 * now.x() * now.y();
    whole += now;
  }
  double angle = 0.5 * std::atan2(s, c);
  if (whole.dot(Vec2(std::cos(angle), std::sin(angle))) < 0.0) angle += std::numbers::pi;
  return {angle, 0.5 * std::hypot(c, s)};
}

void EdgeTerms::straighten(const Points2& rest, const Run& run, double angle) {
  const Vec2 direction(std::cos(angle), std::sin(angle));
  for (int i = run.begin; i < run.end; ++i) {
    EdgeTerm& term = terms_[static_cast<std::size_t>(i)];
    term.wanted = direction * direction.dot(vector_of(rest, term));
  }
}

// Legs that would cross are spread to the least opening, each turned so that both together lose least.
void EdgeTerms::open_dart(const Points2& rest, const Dart& dart) {
  const Run &a = runs_[static_cast<std::size_t>(dart.to_tip)], &b = runs_[static_cast<std::size_t>(dart.from_tip)];
  const Line first = line_through(rest, a), second = line_through(rest, b);
  const double opening =
      dart.side * std::remainder(second.angle - first.angle - std::numbers::pi, 2 * std::numbers::pi);
  const double gap = kLeastOpening - opening;
  if (gap <= 0.0 || gap >= 0.5 * std::numbers::pi) return;
  const double turn = 0.5 * std::atan2(second.sharpness * std::sin(2.0 * gap),
                                       first.sharpness + second.sharpness * std::cos(2.0 * gap));
  straighten(rest, a, first.angle - dart.side * turn);
  straighten(rest, b, second.angle + dart.side * (gap - turn));
}

double EdgeTerms::energy(const Points2& rest) const {
  double sum = 0.0;
  for (const EdgeTerm& term : terms_) sum += term.stiffness * (vector_of(rest, term) - term.wanted).squaredNorm();
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/trued_piece.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/flat_locator.h"
#include "engine/geometry/mesh_polygon.h"
#include "engine/geometry/polygon_boolean.h"

namespace toile {
namespace {

constexpr double kLengthWeight = 1e3;  // w, m
constexpr double kHold = 25.0;         // h, 1/m^2: what is moved dies out over 20 cm ...
constexpr double kHoldNew = 2.0;       // ... in new cloth, which is not cut yet and may bend, over 70 cm
constexpr double kCoarse = 0.025;      // m: edge length of the mesh, at least
constexpr double kSettled = 1e-6;      // m
constexpr double kFarthest = 0.05;     // m a point may be moved: more is no truing ...
constexpr double kFarthestNew = 0.3;   // ... but a long narrow strip of new cloth that bends a little
constexpr int kSteps = 10;

Points2 rows_of(const std::vector<Vec2>& points) {
  Points2 rows(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = points[i];
  return rows;
}

}  // namespace

TruedPiece::TruedPiece(const PieceBorder& border, const PieceMap& map, const Vec2& scale, bool is_new,
                       double edge_length)
    : hold_(is_new ? kHoldNew : kHold), farthest_(is_new ? kFarthestNew : kFarthest) {
  std::vector<Vec2> outline;
  const double coarse = std::max(kCoarse, edge_length);
  const std::size_t count = border.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const BorderVertex &a = border.vertices[i], &b = border.vertices[(i + 1) % count];
    first_.push_back(static_cast<int>(outline.size()));
    const int steps = std::max(1, static_cast<int>(std::ceil((b.target - a.target).norm() / coarse)));
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      outline.emplace_back((1 - t) * a.target + t * b.target);
      start_.emplace_back((1 - t) * a.rest + t * b.rest);
    }
  }
  if (!is_simple_polygon(outline)) return;
  border_count_ = static_cast<int>(outline.size());
  PolygonMesh mesh = mesh_polygon(outline, coarse);
  target_ = rows_of(mesh.points);
  triangles_ = std::move(mesh.triangles);
  const FlatLocator locator(map.target, map.triangles);
  for (std::size_t v = outline.size(); v < mesh.points.size(); ++v)
    start_.emplace_back(locator.closest(mesh.points[v]).of(map.rest, map.triangles).transpose());
  for (const Vec2& p : start_) before_.emplace_back(scale.cwiseProduct(p));
  area_.assign(start_.size(), 0.0);
  for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
    const Vec2 a = before(triangles_(f, 1)) - before(triangles_(f, 0)),
               b = before(triangles_(f, 2)) - before(triangles_(f, 0));
    for (int k = 0; k < 3; ++k)
      area_[static_cast<std::size_t>(triangles_(f, k))] += std::abs(a.x() * b.y() - a.y() * b.x()) / 6.0;
  }
}

void TruedPiece::want(const BorderChain& chain, double length) {
  if (border_count_ == 0) return;
  const std::size_t begin = edges_.size();
  double own = 0.0;
  for (std::size_t k = 1; k < chain.vertices.size(); ++k) {
    int v = first_[static_cast<std::size_t>(chain.vertices[k - 1])];
    const int last = first_[static_cast<std::size_t>(chain.vertices[k])];
    do {
      const int next = (v + 1) % border_count_;
      edges_.push_back({v, next, std::max(1e-5, (before(next) - before(v)).norm())});
      own += edges_.back().length;
      v = next;
    } while (v != last);
  }
  for (std::size_t e = begin; e < edges_.size(); ++e) edges_[e].length *= length / own;
}

bool TruedPiece::give(PieceBorder& border, PieceMap& map) {
  if (border_count_ == 0 || !fit()) return false;
  for (std::size_t i = 0; i < border.vertices.size(); ++i)
    border.vertices[i].rest = now_[static_cast<std::size_t>(first_[i])];
  border.trued = true;
  std::vector<Vec2> moved;
  for (std::size_t v = 0; v < now_.size(); ++v) moved.push_back(now_[v] - start_[v]);
  const Points2 ways = rows_of(moved);
  const FlatLocator locator(target_, triangles_);
  for (Eigen::Index v = 0; v < map.rest.rows(); ++v)
    map.rest.row(v) += locator.closest(map.target.row(v).transpose()).of(ways, triangles_);
  return true;
}

bool TruedPiece::fit() {
  now_ = before_;
  for (int i = 0; i < kSteps && step() > kSettled; ++i) {
  }
  for (std::size_t v = 0; v < now_.size(); ++v)
    if (!((now_[v] - before_[v]).norm() < farthest_)) return false;
  return is_simple_polygon({now_.begin(), now_.begin() + border_count_});
}

void TruedPiece::add_row(std::initializer_list<std::pair<int, Vec2>> row, double residual) {
  for (const auto& [v, slope] : row)
    for (int k = 0; k < 2; ++k) {
      right_(2 * v + k) -= slope[k] * residual;
      for (const auto& [w, other] : row)
        for (int l = 0; l < 2; ++l)
          if (2 * v + k >= 2 * w + l) entries_.emplace_back(2 * v + k, 2 * w + l, slope[k] * other[l]);
    }
}

// The metric of a triangle against that before: three residuals.
void TruedPiece::add_metric(Eigen::Index f) {
  const int a = triangles_(f, 0), b = triangles_(f, 1), c = triangles_(f, 2);
  Mat2 flat, now;
  flat << before(b) - before(a), before(c) - before(a);
  now << now_[static_cast<std::size_t>(b)] - now_[static_cast<std::size_t>(a)],
      now_[static_cast<std::size_t>(c)] - now_[static_cast<std::size_t>(a)];
  const double area = 0.5 * flat.determinant();
  if (area < 1e-12) return;  // cloth that the tears have turned over has no metric to keep
  const Mat2 inverse = flat.inverse(), gradient = now * inverse;
  const Mat2 off = gradient.transpose() * gradient - Mat2::Identity();
  for (const auto& [i, j] : {std::pair{0, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
    const double weight = 0.5 * std::sqrt(i == j ? area : 2.0 * area);
    // d(g_i . g_j) by the corners b and c; a takes the rest.
    const Vec2 of_b = weight * (inverse(0, i) * gradient.col(j) + inverse(0, j) * gradient.col(i));
    const Vec2 of_c = weight * (inverse(1, i) * gradient.col(j) + inverse(1, j) * gradient.col(i));
    add_row({{a, -(of_b + of_c)}, {b, of_b}, {c, of_c}}, weight * off(i, j));
  }
}

// A Gauss-Newton step; returns the farthest a point moves.
double TruedPiece::step() {
  const auto count = static_cast<int>(now_.size());
  entries_.clear();
  right_.setZero(2 * count);
  for (Eigen::Index f = 0; f < triangles_.rows(); ++f) add_metric(f);
  for (const Edge& edge : edges_) {
    const Vec2 way = now_[static_cast<std::size_t>(edge.to)] - now_[static_cast<std::size_t>(edge.from)];
    const double weight = std::sqrt(kLengthWeight / edge.length);
    const Vec2 slope = weight * way.normalized();
    add_row({{edge.from, -slope}, {edge.to, slope}}, weight * (way.norm() - edge.length));
  }
  for (int v = 0; v < count; ++v) {
    const auto i = static_cast<std::size_t>(v);
    const double hold = hold_ * std::max(1e-9, area_[i]);
    for (int k = 0; k < 2; ++k) {
      entries_.emplace_back(2 * v + k, 2 * v + k, hold);
      right_(2 * v + k) -= hold * (now_[i][k] - before_[i][k]);
    }
  }
  SparseMatrix matrix(2 * count, 2 * count);
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  if (!solver_.factor(matrix)) return 0.0;
  const Eigen::MatrixXd moved = solver_.solve(right_);
  for (int v = 0; v < count; ++v) now_[static_cast<std::size_t>(v)] += Vec2(moved(2 * v), moved(2 * v + 1));
  return moved.cwiseAbs().maxCoeff();
}

}  // namespace toile

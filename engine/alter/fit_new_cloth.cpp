// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/fit_new_cloth.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/geometry/mesh_polygon.h"
#include "engine/geometry/polygon_boolean.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {
namespace {

constexpr double kLeastOff = 1e-4;     // m: less is left as it is
constexpr double kMostOff = 0.1;       // of a chain's length: what differs by more is gathered, not cut to length
constexpr double kUnstrained = 0.02;   // of the lengths sewn: how much cloth without strain counts beside them
constexpr double kLengthWeight = 1e3;  // w, m
constexpr double kDamping = 1e-6;      // of the mean diagonal: holds the piece where it is
constexpr double kLongest = 1.3;       // of the edge length: longer borders are divided for the mesh
constexpr double kSettled = 1e-6;      // m
constexpr int kSteps = 12;

struct Wanted {
  double place = 0.0;  // length in the wanted panel, m
  double sewn = 0.0;   // length of what it is sewn to, m; 0: nothing is wanted of it
};

double target_length(const PieceBorder& piece, const BorderChain& chain) {
  double length = 0.0;
  for (std::size_t k = 1; k < chain.vertices.size(); ++k)
    length += (piece.vertices[static_cast<std::size_t>(chain.vertices[k])].target -
               piece.vertices[static_cast<std::size_t>(chain.vertices[k - 1])].target)
                  .norm();
  return length;
}

// One new piece on its way to be cut.
class NewPiece {
 public:
  NewPiece(const PieceBorder& border, double edge_length) {
    std::vector<Vec2> outline;
    const std::size_t count = border.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 &a = border.vertices[i].target, &b = border.vertices[(i + 1) % count].target;
      first_.push_back(static_cast<int>(outline.size()));
      const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (kLongest * edge_length))));
      for (int k = 0; k < steps; ++k) outline.emplace_back(a + (static_cast<double>(k) / steps) * (b - a));
    }
    if (!is_simple_polygon(outline)) return;
    border_count_ = static_cast<int>(outline.size());
    PolygonMesh mesh = mesh_polygon(outline, edge_length);
    place_ = std::move(mesh.points);
    triangles_ = std::move(mesh.triangles);
  }

  bool meshed() const { return !place_.empty(); }

  // Mean warp and weft stretch of the cloth along the chains, as scales of the wanted panel's axes.
  void take_strain(const PieceBorder& border, const std::vector<std::pair<const BorderChain*, Wanted>>& chains) {
    Mat2 normal = Mat2::Zero();
    Vec2 right = Vec2::Zero();
    double length = 0.0;
    for (const auto& [chain, wanted] : chains)
      for (std::size_t k = 1; k < chain->vertices.size(); ++k) {
        const Vec2 edge = border.vertices[static_cast<std::size_t>(chain->vertices[k])].target -
                          border.vertices[static_cast<std::size_t>(chain->vertices[k - 1])].target;
        if (edge.norm() < 1e-9) continue;
        const Vec2 share = edge.cwiseAbs2() / edge.squaredNorm();
        const double ratio = wanted.sewn / wanted.place;
        normal += edge.norm() * share * share.transpose();
        right += edge.norm() * ratio * ratio * share;
        length += edge.norm();
      }
    normal.diagonal().array() += kUnstrained * length;
    right.array() += kUnstrained * length;
    if (length > 0.0) scale_ = normal.inverse() * right;
    scale_ = scale_.cwiseMax(0.81).cwiseMin(1.21).cwiseSqrt();
  }

  double scaled_length(const PieceBorder& border, const BorderChain& chain) const {
    double length = 0.0;
    for (std::size_t k = 1; k < chain.vertices.size(); ++k)
      length += scale_
                    .cwiseProduct(border.vertices[static_cast<std::size_t>(chain.vertices[k])].target -
                                  border.vertices[static_cast<std::size_t>(chain.vertices[k - 1])].target)
                    .norm();
    return length;
  }

  void want(const BorderChain& chain, double ratio) {
    for (std::size_t k = 1; k < chain.vertices.size(); ++k) {
      int v = first_[static_cast<std::size_t>(chain.vertices[k - 1])];
      const int last = first_[static_cast<std::size_t>(chain.vertices[k])];
      do {
        const int next = (v + 1) % border_count_;
        edges_.push_back({v, next, ratio * (at(next) - at(v)).norm()});
        v = next;
      } while (v != last);
    }
  }

  // False, when its outline would cross itself.
  bool fit() {
    now_.resize(place_.size());
    for (std::size_t v = 0; v < place_.size(); ++v) now_[v] = scale_.cwiseProduct(place_[v]);
    for (int i = 0; i < kSteps && step() > kSettled; ++i) {
    }
    return is_simple_polygon({now_.begin(), now_.begin() + border_count_});
  }

  void give(PieceBorder& border, PieceMap& map) const {
    for (std::size_t i = 0; i < border.vertices.size(); ++i)
      border.vertices[i].rest = now_[static_cast<std::size_t>(first_[i])];
    map.rest.resize(static_cast<Eigen::Index>(now_.size()), 2);
    map.target.resize(static_cast<Eigen::Index>(now_.size()), 2);
    for (std::size_t v = 0; v < now_.size(); ++v) {
      map.rest.row(static_cast<Eigen::Index>(v)) = now_[v];
      map.target.row(static_cast<Eigen::Index>(v)) = place_[v];
    }
    map.triangles = triangles_;
    map.border_count = border_count_;
  }

 private:
  struct Edge {
    int from, to;
    double length;
  };
  const Vec2& at(int v) const { return place_[static_cast<std::size_t>(v)]; }
  double step();
  void add_row(const std::vector<std::pair<int, Vec2>>& row, double residual);
  void add_metric(Eigen::Index f);

  std::vector<Vec2> place_, now_;
  Triangles triangles_;
  std::vector<int> first_;  // per vertex of the border: of the mesh
  int border_count_ = 0;
  Vec2 scale_ = Vec2::Ones();
  std::vector<Edge> edges_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_;
};

void NewPiece::add_row(const std::vector<std::pair<int, Vec2>>& row, double residual) {
  for (const auto& [v, slope] : row)
    for (int k = 0; k < 2; ++k) {
      right_(2 * v + k) -= slope[k] * residual;
      for (const auto& [w, other] : row)
        for (int l = 0; l < 2; ++l)
          if (2 * v + k >= 2 * w + l) entries_.emplace_back(2 * v + k, 2 * w + l, slope[k] * other[l]);
    }
}

// The metric of a triangle against the scaled one: three residuals.
void NewPiece::add_metric(Eigen::Index f) {
  const int a = triangles_(f, 0), b = triangles_(f, 1), c = triangles_(f, 2);
  Mat2 flat, now;
  flat << scale_.cwiseProduct(at(b) - at(a)), scale_.cwiseProduct(at(c) - at(a));
  now << now_[static_cast<std::size_t>(b)] - now_[static_cast<std::size_t>(a)],
      now_[static_cast<std::size_t>(c)] - now_[static_cast<std::size_t>(a)];
  const Mat2 inverse = flat.inverse(), gradient = now * inverse;
  const double weight = 0.5 * std::sqrt(std::max(0.0, 0.5 * flat.determinant()));
  const Mat2 metric = gradient.transpose() * gradient - Mat2::Identity();
  for (const auto& [i, j] : {std::pair{0, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
    const double own = i == j ? weight : weight * std::sqrt(2.0);
    // d(g_i . g_j) by the corners b and c; a takes the rest.
    const Vec2 of_b = own * (inverse(0, i) * gradient.col(j) + inverse(0, j) * gradient.col(i));
    const Vec2 of_c = own * (inverse(1, i) * gradient.col(j) + inverse(1, j) * gradient.col(i));
    add_row({{a, -(of_b + of_c)}, {b, of_b}, {c, of_c}}, own * metric(i, j));
  }
}

// A Gauss-Newton step; returns the farthest a point moves.
double NewPiece::step() {
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
  double diagonal = 0.0;
  for (const auto& entry : entries_)
    if (entry.row() == entry.col()) diagonal += entry.value();
  for (int i = 0; i < 2 * count; ++i) entries_.emplace_back(i, i, kDamping * diagonal / (2 * count));
  SparseMatrix matrix(2 * count, 2 * count);
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  SparseSolver solver;
  if (!solver.factor(matrix)) return 0.0;
  const Eigen::MatrixXd moved = solver.solve(right_);
  for (int v = 0; v < count; ++v) now_[static_cast<std::size_t>(v)] += Vec2(moved(2 * v), moved(2 * v + 1));
  return moved.cwiseAbs().maxCoeff();
}

class Fitting {
 public:
  Fitting(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams,
          std::vector<PieceBorder>& borders, std::vector<SewnPiece>& pieces)
      : chains_(chains), seams_(seams), borders_(borders), pieces_(pieces) {}

  void run(double edge_length) {
    want_lengths_of_kept_cloth();
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (worth_it(i)) {
        NewPiece piece(borders_[i], edge_length);
        if (!piece.meshed()) continue;
        piece.take_strain(borders_[i], wanted_of(i));
        fitted_.emplace(i, std::move(piece));
      }
    want_lengths_of_new_cloth();
    for (auto& [i, piece] : fitted_) {
      for (const auto& [chain, wanted] : wanted_of(i)) piece.want(*chain, wanted.sewn / wanted.place);
      if (piece.fit()) piece.give(borders_[i], pieces_[i].map);
    }
  }

 private:
  std::size_t piece_of(int chain) const {
    return static_cast<std::size_t>(chains_[static_cast<std::size_t>(chain)].piece);
  }
  bool is_new(std::size_t piece) const {
    return pieces_[piece].insertion >= 0 || (pieces_[piece].recut && !pieces_[piece].own_cloth);
  }

  void want_lengths_of_kept_cloth() {
    wanted_.resize(chains_.size());
    for (const ChainSeam& seam : seams_)
      for (const bool turned : {false, true}) {
        const int own = turned ? seam.b : seam.a, other = turned ? seam.a : seam.b;
        if (!is_new(piece_of(own)) || is_new(piece_of(other))) continue;
        const BorderChain& chain = chains_[static_cast<std::size_t>(own)];
        const double place = target_length(borders_[piece_of(own)], chain);
        const double sewn = chain_length(borders_[piece_of(other)], chains_[static_cast<std::size_t>(other)]) +
                            (turned ? -seam.eased : seam.eased);
        if (std::abs(sewn - place) < kMostOff * place) wanted_[static_cast<std::size_t>(own)] = {place, sewn};
      }
  }

  // Both plies meet in the middle of what their pieces would have.
  void want_lengths_of_new_cloth() {
    for (const ChainSeam& seam : seams_) {
      const std::size_t a = piece_of(seam.a), b = piece_of(seam.b);
      if (!is_new(a) || !is_new(b) || (!fitted_.contains(a) && !fitted_.contains(b))) continue;
      const auto length = [&](std::size_t piece, int chain) {
        const BorderChain& own = chains_[static_cast<std::size_t>(chain)];
        return fitted_.contains(piece) ? fitted_.at(piece).scaled_length(borders_[piece], own)
                                       : target_length(borders_[piece], own);
      };
      const double of_a = length(a, seam.a), of_b = length(b, seam.b) + seam.eased;
      const double both = !fitted_.contains(a) ? of_a : !fitted_.contains(b) ? of_b : 0.5 * (of_a + of_b);
      wanted_[static_cast<std::size_t>(seam.a)] = {
          target_length(borders_[a], chains_[static_cast<std::size_t>(seam.a)]), both};
      wanted_[static_cast<std::size_t>(seam.b)] = {
          target_length(borders_[b], chains_[static_cast<std::size_t>(seam.b)]), both - seam.eased};
    }
  }

  std::vector<std::pair<const BorderChain*, Wanted>> wanted_of(std::size_t piece) const {
    std::vector<std::pair<const BorderChain*, Wanted>> chains;
    for (std::size_t c = 0; c < chains_.size(); ++c)
      if (static_cast<std::size_t>(chains_[c].piece) == piece && wanted_[c].sewn > 0.0)
        chains.emplace_back(&chains_[c], wanted_[c]);
    return chains;
  }

  bool worth_it(std::size_t piece) const {
    if (!is_new(piece)) return false;
    const auto chains = wanted_of(piece);
    return std::any_of(chains.begin(), chains.end(),
                       [](const auto& chain) { return std::abs(chain.second.sewn - chain.second.place) > kLeastOff; });
  }

  const std::vector<BorderChain>& chains_;
  const std::vector<ChainSeam>& seams_;
  std::vector<PieceBorder>& borders_;
  std::vector<SewnPiece>& pieces_;
  std::vector<Wanted> wanted_;  // per chain
  std::map<std::size_t, NewPiece> fitted_;
};

}  // namespace

void fit_new_cloth(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams, double edge_length,
                   std::vector<PieceBorder>& borders, std::vector<SewnPiece>& pieces) {
  Fitting(chains, seams, borders, pieces).run(edge_length);
}

}  // namespace toile

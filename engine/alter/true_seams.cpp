// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/true_seams.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/alter/trued_piece.h"

namespace toile {
namespace {

constexpr double kLeastOff = 1.5e-4;    // m: less is left as it is
constexpr double kMostOff = 0.15;       // of a chain's length: what differs by more is eased
constexpr double kMostFollowed = 0.25;  // of a chain's length: new cloth takes another length than its place has
constexpr double kShortOff = 0.013;     // m: or by less than this, of short chains
constexpr double kUnstrained = 0.02;    // of the lengths sewn: how much cloth without strain counts beside them

class Truing {
 public:
  Truing(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams, const std::vector<bool>& fixed,
         std::vector<PieceBorder>& borders, std::vector<SewnPiece>& pieces, std::list<KnownTruing>* known)
      : chains_(chains), seams_(seams), fixed_(fixed), borders_(borders), pieces_(pieces), known_(known) {
    for (const BorderChain& chain : chains)
      length_.push_back(chain_length(borders[static_cast<std::size_t>(chain.piece)], chain));
    wanted_ = length_;
    sewn_.assign(chains.size(), false);
    scale_.assign(pieces.size(), Vec2::Ones());
  }

  std::vector<bool> run(double edge_length) {
    for (const ChainSeam& seam : seams_)
      if (!is_new(seam.a) && !is_new(seam.b)) meet_in_the_middle(seam);
    for (const ChainSeam& seam : seams_)
      if (is_new(seam.a) != is_new(seam.b)) follow(seam);
    for (std::size_t i = 0; i < pieces_.size(); ++i) take_strain(i);
    for (const ChainSeam& seam : seams_)
      if (is_new(seam.a) && is_new(seam.b)) meet_in_the_middle(seam);
    std::vector<bool> failed(pieces_.size(), false);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (worth_it(i)) failed[i] = !true_piece(i, edge_length);
    return failed;
  }

 private:
  std::size_t piece_of(int chain) const {
    return static_cast<std::size_t>(chains_[static_cast<std::size_t>(chain)].piece);
  }
  bool is_fixed(int chain) const { return fixed_[piece_of(chain)]; }
  bool is_new_piece(std::size_t i) const { return !fixed_[i] && (pieces_[i].insertion >= 0 || pieces_[i].recut); }
  bool is_new(int chain) const { return is_new_piece(piece_of(chain)); }
  double& wanted(int chain) { return wanted_[static_cast<std::size_t>(chain)]; }

  static bool near(double a, double b, double most) {
    return std::abs(a - b) < std::max(kShortOff, most * std::max(a, b));
  }

  void meet_in_the_middle(const ChainSeam& seam) {
    const double a = wanted(seam.a), b = wanted(seam.b) + seam.eased;
    if (!near(a, b, kMostOff)) return;
    const double both = is_fixed(seam.a) ? a : is_fixed(seam.b) ? b : 0.5 * (a + b);
    set(seam, both);
  }

  // New cloth takes the length of kept cloth; where it is far off, in a corner, both give way.
  void follow(const ChainSeam& seam) {
    const double a = wanted(seam.a), b = wanted(seam.b) + seam.eased;
    if (!near(a, b, kMostFollowed)) return;
    const int kept = is_new(seam.a) ? seam.b : seam.a;
    const bool little = std::abs(a - b) < kMostFollowed * std::max(a, b) || is_fixed(kept);
    set(seam, !little ? 0.5 * (a + b) : is_new(seam.a) ? b : a);
  }

  void set(const ChainSeam& seam, double both) {
    if (!is_fixed(seam.a)) wanted(seam.a) = both;
    if (!is_fixed(seam.b)) wanted(seam.b) = both - seam.eased;
    sewn_[static_cast<std::size_t>(seam.a)] = sewn_[static_cast<std::size_t>(seam.b)] = true;
  }

  // Mean warp and weft stretch that a new piece needs for the lengths wanted of it; what else is wanted of its other
  // chains begins from there.
  void take_strain(std::size_t i) {
    if (!is_new_piece(i)) return;
    Mat2 normal = Mat2::Zero();
    Vec2 right = Vec2::Zero();
    double length = 0.0;
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (static_cast<std::size_t>(chains_[c].piece) != i || !sewn_[c]) continue;
      const double ratio = wanted_[c] / length_[c];
      each_edge(chains_[c], [&](const Vec2& edge) {
        const Vec2 share = edge.cwiseAbs2() / edge.squaredNorm();
        normal += edge.norm() * share * share.transpose();
        right += edge.norm() * ratio * ratio * share;
        length += edge.norm();
      });
    }
    if (length <= 0.0) return;
    normal.diagonal().array() += kUnstrained * length;
    right.array() += kUnstrained * length;
    scale_[i] = (normal.inverse() * right).cwiseMax(0.81).cwiseMin(1.21).cwiseSqrt();
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (static_cast<std::size_t>(chains_[c].piece) != i || sewn_[c]) continue;
      wanted_[c] = 0.0;
      each_edge(chains_[c], [&](const Vec2& edge) { wanted_[c] += scale_[i].cwiseProduct(edge).norm(); });
    }
  }

  void each_edge(const BorderChain& chain, const std::function<void(const Vec2&)>& visit) const {
    const auto& vertices = borders_[static_cast<std::size_t>(chain.piece)].vertices;
    for (std::size_t k = 1; k < chain.vertices.size(); ++k) {
      const Vec2 edge = vertices[static_cast<std::size_t>(chain.vertices[k])].rest -
                        vertices[static_cast<std::size_t>(chain.vertices[k - 1])].rest;
      if (edge.norm() > 1e-9) visit(edge);
    }
  }

  bool worth_it(std::size_t piece) const {
    for (std::size_t c = 0; c < chains_.size(); ++c)
      if (static_cast<std::size_t>(chains_[c].piece) == piece && sewn_[c] &&
          std::abs(wanted_[c] - length_[c]) > kLeastOff)
        return !fixed_[piece];
    return false;
  }

  bool true_piece(std::size_t i, double edge_length) {
    PieceMap& map = pieces_[i].map;
    KnownTruing piece{borders_[i], map.rest, map.target, scale_[i], is_new_piece(i), {}, false, {}, {}};
    std::vector<const BorderChain*> wanted;
    for (std::size_t c = 0; c < chains_.size(); ++c)
      if (static_cast<std::size_t>(chains_[c].piece) == i && sewn_[c]) {
        wanted.push_back(&chains_[c]);
        piece.wanted.emplace_back(chains_[c].vertices, wanted_[c]);
      }
    if (const KnownTruing* known = find(piece)) {
      borders_[i] = known->border_after;
      map.rest = known->rest_after;
      return known->given;
    }
    TruedPiece trued(borders_[i], map, scale_[i], piece.is_new, edge_length);
    for (std::size_t k = 0; k < wanted.size(); ++k) trued.want(*wanted[k], piece.wanted[k].second);
    const bool given = piece.given = trued.give(borders_[i], map);
    piece.border_after = borders_[i];
    piece.rest_after = map.rest;
    if (known_) known_->push_back(std::move(piece));
    return given;
  }

  const KnownTruing* find(const KnownTruing& piece) const {
    if (!known_) return nullptr;
    const auto same = [](const Points2& a, const Points2& b) { return a.rows() == b.rows() && a == b; };
    for (const KnownTruing& known : *known_)
      if (known.is_new == piece.is_new && known.scale == piece.scale && known.wanted == piece.wanted &&
          known.border == piece.border && same(known.rest, piece.rest) && same(known.target, piece.target))
        return &known;
    return nullptr;
  }

  const std::vector<BorderChain>& chains_;
  const std::vector<ChainSeam>& seams_;
  const std::vector<bool>& fixed_;
  std::vector<PieceBorder>& borders_;
  std::vector<SewnPiece>& pieces_;
  std::list<KnownTruing>* known_;
  std::vector<double> length_, wanted_;  // per chain
  std::vector<bool> sewn_;               // per chain: a length is wanted of it
  std::vector<Vec2> scale_;              // per piece
};

}  // namespace

std::vector<bool> true_seams(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams,
                             const std::vector<bool>& fixed, double edge_length, std::vector<PieceBorder>& borders,
                             std::vector<SewnPiece>& pieces, std::list<KnownTruing>* known) {
  return Truing(chains, seams, fixed, borders, pieces, known).run(edge_length);
}

}  // namespace toile

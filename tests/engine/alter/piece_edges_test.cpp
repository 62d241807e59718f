// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/piece_edges.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/geometry/curve.h"

namespace toile {
namespace {

constexpr double kWidth = 0.3, kHeight = 0.5;      // m
constexpr double kRise = 1.5e-4;                   // m: near enough to the original's corners to be taken for them
constexpr double kSameLength = 1e-4, kGap = 1e-2;  // m

Panel rectangle() {
  Panel panel;
  panel.name = "front";
  panel.corners = {{0, 0}, {kWidth, 0}, {kWidth, kHeight}, {0, kHeight}};
  panel.edges.resize(4);
  return panel;
}

// The rectangle with its lower and upper edges so far outside those of the original.
struct Border {
  PieceBorder piece;
  std::vector<BorderChain> chains;

  Border(double rise, bool trued) {
    piece.trued = trued;
    const std::vector<Vec2> corners = {{0, -rise}, {kWidth, -rise}, {kWidth, kHeight + rise}, {0, kHeight + rise}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 from = corners[k], way = corners[(k + 1) % 4] - from;
      const int count = static_cast<int>(way.norm() / kGap);
      BorderChain chain;
      chain.along.track.edge = static_cast<int>(k);
      for (int i = 0; i < count; ++i) {
        chain.vertices.push_back(static_cast<int>(piece.vertices.size()));
        piece.vertices.push_back({-1, from, from + way * i / count, i == 0});
      }
      chains.push_back(chain);
    }
    for (std::size_t k = 0; k < 4; ++k) chains[k].vertices.push_back(chains[(k + 1) % 4].vertices.front());
  }

  PieceEdges drawn(const Panel& original) const {
    std::vector<const BorderChain*> all;
    for (const BorderChain& chain : chains) all.push_back(&chain);
    return draw_piece_edges(piece, all, &original);
  }
};

double drawn_length(const PieceEdges& edges, std::size_t k) {
  return curve_length({edges.corners[k], edges.corners[(k + 1) % 4], edges.curves[k]});
}

TEST(PieceEdges, AreThoseOfTheOriginalWhereThePieceLiesOnThem) {
  const Panel original = rectangle();
  const PieceEdges edges = Border(0.0, false).drawn(original);
  EXPECT_TRUE(edges.sound);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(edges.corners[k], original.corners[k]);
    EXPECT_EQ(edges.of_edge[k], static_cast<int>(k));
  }
}

// Corners taken for those of the original would shorten its sides by twice the rise, and the seams along them.
TEST(PieceEdges, OfATruedPieceKeepTheirLengths) {
  const PieceEdges edges = Border(kRise, true).drawn(rectangle());
  EXPECT_TRUE(edges.sound);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(drawn_length(edges, k), edges.lengths[k], kSameLength) << k;
  EXPECT_NEAR(edges.lengths[1], kHeight + 2 * kRise, 1e-9);
}

}  // namespace
}  // namespace toile

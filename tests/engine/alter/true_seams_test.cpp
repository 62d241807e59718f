// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of rectangles whose sewn edges differ in length.
#include "engine/alter/true_seams.h"

#include <gtest/gtest.h>

#include "engine/geometry/mesh_polygon.h"

namespace toile {
namespace {

constexpr double kExact = 1e-4;  // m

// Two pieces of 200 mm width, sewn along a's right and b's left edge; chain k is edge k from the lower one on.
struct Pair {
  std::vector<PieceBorder> borders;
  std::vector<SewnPiece> pieces;
  std::vector<BorderChain> chains;
  std::vector<ChainSeam> seams = {{1, 7, false, false, 0.0}};

  Pair(double height_a, double height_b) {
    add(height_a);
    add(height_b);
  }
  void add(double height) {
    const std::vector<Vec2> corners = {{0, 0}, {0.2, 0}, {0.2, height}, {0, height}};
    const auto number = static_cast<int>(borders.size());
    const PolygonMesh mesh = mesh_polygon(corners, 0.05);
    SewnPiece piece;
    piece.panel = number;
    piece.map.rest.resize(static_cast<Eigen::Index>(mesh.points.size()), 2);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      piece.map.rest.row(static_cast<Eigen::Index>(i)) = mesh.points[i];
    piece.map.target = piece.map.rest;
    piece.map.triangles = mesh.triangles;
    piece.map.border_count = 4;
    pieces.push_back(piece);
    PieceBorder border{number, 0, {}, {}};
    for (int k = 0; k < 4; ++k) {
      border.vertices.push_back({k, corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>(k)], true});
      border.borders.push_back({k, (k + 1) % 4, -1, {k, -1, false}, 0.0, 1.0});
      chains.push_back({number, {k, (k + 1) % 4}, border.borders.back()});
    }
    borders.push_back(border);
  }
  void run(const std::vector<bool>& fixed = {false, false}) { true_seams(chains, seams, fixed, 0.05, borders, pieces); }
  double length(std::size_t chain) const {
    return chain_length(borders[static_cast<std::size_t>(chains[chain].piece)], chains[chain]);
  }
};

TEST(TrueSeams, KeptClothMeetsInTheMiddle) {
  Pair pair(0.300, 0.306);
  pair.run();
  EXPECT_NEAR(pair.length(1), 0.303, kExact);
  EXPECT_NEAR(pair.length(7), 0.303, kExact);
  EXPECT_NEAR(pair.pieces[0].map.rest.col(1).maxCoeff(), 0.3015, 5e-4);  // its map moves with it
}

TEST(TrueSeams, WhatTheWantedPatternEasesStaysEased) {
  Pair pair(0.300, 0.306);
  pair.seams[0].eased = -0.006;
  pair.run();
  EXPECT_EQ(pair.length(1), 0.300);
  EXPECT_EQ(pair.length(7), 0.306);
  EXPECT_FALSE(pair.borders[0].trued);
}

TEST(TrueSeams, NewClothGivesWay) {
  Pair pair(0.300, 0.306);
  pair.pieces[1].insertion = 0;
  pair.run();
  EXPECT_EQ(pair.length(1), 0.300);
  EXPECT_NEAR(pair.length(7), 0.300, kExact);
  EXPECT_NEAR(pair.length(5), 0.300, 1e-3);  // as a whole: it does not become a wedge
}

TEST(TrueSeams, FixedClothIsFollowed) {
  Pair pair(0.300, 0.306);
  pair.run({true, false});
  EXPECT_EQ(pair.length(1), 0.300);
  EXPECT_NEAR(pair.length(7), 0.300, kExact);
}

TEST(TrueSeams, WhatIsFarOffIsLeftToBeEased) {
  Pair pair(0.300, 0.400);
  pair.run();
  EXPECT_EQ(pair.length(1), 0.300);
  EXPECT_EQ(pair.length(7), 0.400);
}

}  // namespace
}  // namespace toile

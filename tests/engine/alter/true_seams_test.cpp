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
  // Both upright edges with `steps` points.
  void add(double height, double width = 0.2, int steps = 1) {
    std::vector<Vec2> outline = {{0, 0}};
    std::vector<std::vector<int>> edges(4, {0});
    const auto walk_to = [&](std::size_t edge, const Vec2& to, int parts) {
      const Vec2 from = outline.back();
      for (int i = 1; i <= parts; ++i) {
        edges[edge].push_back(static_cast<int>(outline.size()));
        outline.emplace_back(from + (to - from) * i / parts);
      }
      if (edge < 3) edges[edge + 1] = {edges[edge].back()};
    };
    walk_to(0, {width, 0}, 1);
    walk_to(1, {width, height}, steps);
    walk_to(2, {0, height}, 1);
    walk_to(3, {0, 0}, steps);
    outline.pop_back();
    edges[3].back() = 0;
    add(outline, edges);
  }
  void add(const std::vector<Vec2>& outline, const std::vector<std::vector<int>>& edges) {
    const auto number = static_cast<int>(borders.size()), count = static_cast<int>(outline.size());
    const PolygonMesh mesh = mesh_polygon(outline, 0.05);
    SewnPiece piece;
    piece.panel = number;
    piece.map.rest.resize(static_cast<Eigen::Index>(mesh.points.size()), 2);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      piece.map.rest.row(static_cast<Eigen::Index>(i)) = mesh.points[i];
    piece.map.target = piece.map.rest;
    piece.map.triangles = mesh.triangles;
    piece.map.border_count = count;
    pieces.push_back(piece);
    PieceBorder border{number, 0, {}, {}};
    for (std::size_t k = 0; k < edges.size(); ++k) {
      for (std::size_t i = 0; i + 1 < edges[k].size(); ++i) {
        const int v = edges[k][i];
        const Vec2& place = outline[static_cast<std::size_t>(v)];
        border.vertices.push_back({v, place, place, i == 0});
        border.borders.push_back({v, (v + 1) % count, -1, {static_cast<int>(k), -1, false}, 0.0, 1.0});
      }
      chains.push_back({number, edges[k], border.borders.back()});
    }
    borders.push_back(border);
  }
  void run(const std::vector<bool>& fixed = {false, false}) { true_seams(chains, seams, fixed, 0.05, borders, pieces); }
  void run_free() { run(std::vector<bool>(pieces.size(), false)); }
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

Pair trued(double height_b, std::list<KnownTruing>& known) {
  Pair pair(0.300, height_b);
  true_seams(pair.chains, pair.seams, {false, false}, 0.05, pair.borders, pair.pieces, &known);
  return pair;
}

TEST(TrueSeams, WhatIsKnownComesOutAsItDid) {
  std::list<KnownTruing> known;
  const Pair first = trued(0.306, known);
  ASSERT_EQ(known.size(), 2u);
  const Pair again = trued(0.306, known);
  EXPECT_EQ(known.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(again.borders[i] == first.borders[i]) << i;
    EXPECT_TRUE(again.pieces[i].map.rest == first.pieces[i].map.rest) << i;
  }
  const Pair other = trued(0.304, known);
  EXPECT_EQ(known.size(), 4u);
  EXPECT_NEAR(other.length(1), 0.302, kExact);
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

TEST(TrueSeams, ALongNarrowStripBendsBetweenClothOfTwoLengths) {
  Pair pair(1.000, 1.004);
  pair.add(1.0, 0.015, 20);
  pair.pieces[2].insertion = 0;
  pair.seams = {{1, 11, false, false, 0.0}, {9, 7, false, false, 0.0}};
  pair.run_free();
  EXPECT_NEAR(pair.length(11), 1.000, 5e-4);
  EXPECT_NEAR(pair.length(9), 1.004, 5e-4);
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth_patches.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace toile {
namespace {

constexpr int kCells = 10;
constexpr double kCell = 0.01;

// Two square panels sewn along a side of both, the second one's triangles facing as the first one's or the other way.
struct TwoPanels {
  explicit TwoPanels(bool turned) : triangles(4 * kCells * kCells, 3), rest(triangles.rows(), 2) {
    const auto node = [](int i, int j) { return i * (kCells + 1) + j; };
    int f = 0;
    for (int i = 0; i < 2 * kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        triangles.row(f) << node(i, j), node(i + 1, j), node(i, j + 1);
        triangles.row(f + 1) << node(i + 1, j), node(i + 1, j + 1), node(i, j + 1);
        for (int k = 0; k < 2; ++k, ++f) {
          if (turned && i >= kCells) std::swap(triangles(f, 0), triangles(f, 1));
          rest.row(f) << kCell * (i % kCells + k / 3.0), kCell * (j + k / 3.0);
          panel.push_back(i / kCells);
        }
      }
  }

  // Level, or folded over at the seam so that the second panel lies 1 mm above the first.
  Points3 nodes(bool folded) const {
    Points3 nodes((2 * kCells + 1) * (kCells + 1), 3);
    for (int i = 0, n = 0; i <= 2 * kCells; ++i)
      for (int j = 0; j <= kCells; ++j, ++n) {
        const bool over = folded && i > kCells;
        nodes.row(n) << kCell * (over ? 2 * kCells - i : i), kCell * j, over ? 0.001 : 0.0;
      }
    return nodes;
  }

  // Pairs of triangles of different panels found near each other.
  long found(bool folded) const {
    ClothPatches patches(triangles, rest, panel);
    EXPECT_TRUE(patches.update(nodes(folded), 0.001, 0.002));
    const auto& near = patches.near();
    return std::count_if(near.begin(), near.end(), [&](const auto& pair) {
      return panel[static_cast<std::size_t>(pair.first)] != panel[static_cast<std::size_t>(pair.second)];
    });
  }

  Triangles triangles;
  Points2 rest;
  std::vector<int> panel;
};

TEST(ClothPatches, FindsPanelsFoldedOntoEachOtherAtTheirSeamWhicheverWayTheyFace) {
  EXPECT_GE(TwoPanels(false).found(true), 2 * kCells * kCells);
  EXPECT_EQ(TwoPanels(true).found(true), TwoPanels(false).found(true));
}

// But for a few triangles in the corners of patches, whose boxes touch.
TEST(ClothPatches, SmoothClothAcrossASeamIsHardlySearchedWhicheverWayItsPanelsFace) {
  EXPECT_LE(TwoPanels(false).found(false), kCells);
  EXPECT_EQ(TwoPanels(true).found(false), TwoPanels(false).found(false));
}

// Bent, but everywhere as good as flat: patches that are near each other with one between them lie in smooth cloth,
// too.
TEST(ClothPatches, PatchesOneApartInSmoothClothAreNotSearched) {
  const TwoPanels panels(false);
  ClothPatches patches(panels.triangles, panels.rest, panels.panel);
  patches.update(panels.nodes(false), 0.01, 0.02);  // as wide as a patch
  EXPECT_LE(patches.near().size(), 4 * kCells * kCells);  // a few at corners
}

TEST(ClothPatches, WhatLiesStillIsKeptWhileTheRestIsSearchedAnew) {
  const TwoPanels panels(false);
  constexpr double kReach = 0.001, kWider = 0.003;
  ClothPatches patches(panels.triangles, panels.rest, panels.panel), anew = patches;
  Points3 nodes = panels.nodes(true);
  ASSERT_TRUE(patches.update(nodes, kReach, kWider));
  EXPECT_FALSE(patches.update(nodes, kReach, kWider));
  nodes.array() += 0.0005;
  EXPECT_FALSE(patches.update(nodes, kReach, kWider));  // by less than half of kWider - kReach
  for (int i = kCells + 6; i <= 2 * kCells; ++i)        // the end of the upper panel is lifted
    for (int j = 0; j <= kCells; ++j) nodes(i * (kCells + 1) + j, 2) += 0.02;
  ASSERT_TRUE(patches.update(nodes, kReach, kWider));
  ASSERT_TRUE(anew.update(nodes, kReach, kWider));
  const auto sorted = [](std::vector<std::pair<int, int>> pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  };
  const auto kept = sorted(patches.near()), found = sorted(anew.near());
  ASSERT_GT(found.size(), 100U);
  EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
  const auto near = [&](const std::pair<int, int>& pair) {
    const auto box = [&](int f) {
      TriangleBox b;
      for (int k = 0; k < 3; ++k) {
        b.low = b.low.cwiseMin(nodes.row(panels.triangles(f, k)).transpose());
        b.high = b.high.cwiseMax(nodes.row(panels.triangles(f, k)).transpose());
      }
      return b;
    };
    return box(pair.first).near(box(pair.second), kReach);
  };
  long missing = 0;
  for (const auto& pair : found) missing += near(pair) && !std::binary_search(kept.begin(), kept.end(), pair);
  EXPECT_EQ(missing, 0);
}

}  // namespace
}  // namespace toile

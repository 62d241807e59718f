// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/smooth_sides.h"

#include <cmath>

#include <gtest/gtest.h>

namespace toile {
namespace {

constexpr int kPerEdge = 12;
constexpr double kStep = 0.01;  // m between vertices

// One panel of two edges that meet in a turn of `turn`: along x first, then on.
PatternMesh two_edges(double turn) {
  PatternMesh mesh;
  mesh.rest.resize(2 * kPerEdge + 1, 2);
  mesh.edge_vertices = {{{}, {}}};
  for (int i = 0; i <= 2 * kPerEdge; ++i) {
    const double beyond = std::max(0, i - kPerEdge) * kStep;
    mesh.rest.row(i) << std::min(i, kPerEdge) * kStep + beyond * std::cos(turn), beyond * std::sin(turn);
    if (i <= kPerEdge) mesh.edge_vertices[0][0].push_back(i);
    if (i >= kPerEdge) mesh.edge_vertices[0][1].push_back(i);
  }
  return mesh;
}

double energy_of(const PatternMesh& mesh, const Points2& rest) {
  double sum = 0.0;
  for (const SmoothSide& side : smooth_sides(mesh)) sum += side.energy(rest);
  return sum;
}

// Of `height` at the joint, falling to nothing within a third of either edge.
Points2 with_bump(const PatternMesh& mesh, double height) {
  Points2 rest = mesh.rest;
  for (int i = -kPerEdge / 3; i <= kPerEdge / 3; ++i)
    rest(kPerEdge + i, 1) += height * (1.0 - 3.0 * std::abs(i) / kPerEdge);
  return rest;
}

TEST(SmoothSides, ABumpWhereOneEdgeRunsOnIntoTheNextCostsEnergyAndACornerThereDoesNot) {
  constexpr double kHeight = 5e-3, kCorner = 0.5;  // m, rad
  const PatternMesh straight = two_edges(0.0), corner = two_edges(kCorner);
  ASSERT_EQ(smooth_sides(straight).size(), 1u);
  ASSERT_EQ(smooth_sides(corner).size(), 2u);
  EXPECT_GT(energy_of(straight, with_bump(straight, kHeight)), 4.0 * energy_of(corner, with_bump(corner, kHeight)));
}

TEST(SmoothSides, WhatIsStretchedShearedTurnedOrGentlyBentCostsNothing) {
  const PatternMesh mesh = two_edges(0.05);
  Mat2 linear;
  linear << 1.1, 0.2, -0.3, 0.9;
  Points2 moved = mesh.rest * linear.transpose();
  const double length = 2.0 * kPerEdge * kStep;
  for (int i = 0; i <= 2 * kPerEdge; ++i) moved(i, 1) += 0.02 * std::pow(i * kStep / length, 3);
  EXPECT_GT((moved - mesh.rest).norm(), 0.01);
  EXPECT_LT(energy_of(mesh, moved), 1e-20);
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices, edges and triangles of a sewn garment as self-contact pairs them: each belongs to one triangle, so that
// pairs of triangles give every pair of features once. SI units.
#pragma once

#include "engine/core/pattern_mesh.h"

namespace toile {

struct ClothFeatures {
  struct Edge {
    std::array<int, 2> node;      // ascending
    std::array<int, 2> triangle;  // -1: none; further triangles are left out
  };

  // Triangles two of whose nodes coincide are left out.
  explicit ClothFeatures(const PatternMesh& mesh);

  Triangles triangles;     // #T x 3, of nodes
  std::vector<Mat3> rest;  // #T, corners as rows, in the panel's plane, m
  std::vector<int> panel;  // #T, ascending
  std::vector<Edge> edges;
  std::vector<std::array<int, 3>> owned_edges;  // #T, from corner k to the next; -1: owned by another
  std::vector<int> owner_of_node;               // #N, -1: no triangle

  int triangle_count() const { return static_cast<int>(triangles.rows()); }
  Points2 centres() const;  // #T x 2, at rest, m
  bool has_node(int f, int node) const {
    return triangles(f, 0) == node || triangles(f, 1) == node || triangles(f, 2) == node;
  }

 private:
  void find_owners(int node_count);
};

}  // namespace toile

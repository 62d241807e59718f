// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a garment may be near each other although the cloth between them is long: the broad phase of
// self-contact. Triangles lie in small patches of one panel with a box and a cone of normals each; two patches that
// are the same or hang together and are as good as flat cannot touch [Volino1994]. What was found is kept until a
// patch has moved: patches that lie still are not searched while others fall. SI units.
#pragma once

#include "engine/core/types.h"

namespace toile {

struct TriangleBox {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  // Closer than `reach` in every coordinate.
  bool near(const TriangleBox& other, double reach) const {
    return ((low - other.high).array() <= reach).all() && ((other.low - high).array() <= reach).all();
  }
};

class ClothPatches {
 public:
  // `triangles`: nodes of every triangle, none with two equal ones; `rest`: one point per triangle, in its panel's
  // plane; `panel`: of every triangle, ascending.
  ClothPatches(const Triangles& triangles, const Points2& rest, const std::vector<int>& panel);

  // Pairs of two of these triangles are of no interest.
  void leave_out(const std::vector<char>& triangles);

  // Takes in where the nodes are now. Afterwards near() has every pair of triangles whose boxes are closer than
  // `reach`, but for those that lie in smooth cloth together. Patches are searched within `wider` (> reach), anew only
  // when a node of theirs has moved by half the difference. False: near() is as it was.
  bool update(const Points3& nodes, double reach, double wider);
  // Each once, in an order that depends on the nodes of the updates alone.
  const std::vector<std::pair<int, int>>& near() const { return near_; }

 private:
  struct Patch {
    int begin, end;            // of order_
    int panel;                 // in the order of `triangles`
    int first_node, end_node;  // of nodes_
    TriangleBox box;
    Vec3 axis;
    double cosine, sine;  // of the largest angle of a normal from the axis
  };
  struct PatchPair {
    int a, b;   // a <= b
    int count;  // of pairs of triangles in near_; -1: to be looked at
  };

  void divide(const Points2& rest, int begin, int end, int panel);
  void find_sides(const std::vector<int>& panel);
  void find_nodes();
  void find_neighbours();
  void find_moved(const Points3& nodes, double most);
  void measure(Patch& patch, const Points3& nodes);
  bool smooth(const Patch& a, const Patch& b) const;
  bool together(int a, int b) const;
  // Pairs with a moved patch that come within `reach`, same and neighbouring ones only where not smooth, ascending.
  void find_pairs(double reach);
  void add_pair(int a, int b, double reach);
  // Those of patches that lie still, and the new ones.
  void renew_near(double reach);
  void add_near(const PatchPair& pair, double reach);
  const Patch& patch(int p) const { return patches_[static_cast<std::size_t>(p)]; }

  const Triangles triangles_;
  std::vector<int> order_;                   // triangles, patch by patch
  std::vector<std::array<int, 3>> corners_;  // of the triangles in that order: places in nodes_
  std::vector<int> nodes_;                   // of every patch
  Points3 seen_;                             // where those were when the patch was last measured, m
  std::vector<Patch> patches_;
  std::vector<double> side_;                  // per panel: 1, or -1 where its triangles face the other way
  std::vector<std::pair<int, int>> twisted_;  // panels, ascending, sewn so that no side suits them both
  std::vector<std::vector<int>> neighbours_;  // per patch, ascending: patches with a common node
  std::vector<TriangleBox> boxes_;            // of the triangles in order_
  std::vector<int> by_height_;                // patches
  std::vector<char> moved_;                   // per patch
  std::vector<char> out_, all_out_;           // per triangle, and per patch all of them; empty: none
  int moved_count_ = 0;
  bool measured_ = false;
  std::vector<PatchPair> pairs_, found_, merged_;
  std::vector<std::pair<int, int>> near_, renewed_;
  std::vector<int> near_a_, near_b_;
};

}  // namespace toile

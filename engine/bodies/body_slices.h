// SPDX-License-Identifier: GPL-3.0-or-later
// Horizontal slices of a standing body, and which of their pieces are trunk, legs and arms.
#pragma once

#include "engine/geometry/mesh_slicer.h"

namespace toile {

class BodySlices {
 public:
  // `broken` outlines (scans with holes): pieces whose boxes nearly touch are taken as one.
  explicit BodySlices(const TriangleMesh& body, bool broken = true);

  double height() const { return height_; }  // m, top of the body over the floor

  std::vector<SliceComponent> pieces(double y) const;
  // The pieces that span the mid-plane, as one: trunk, neck or head (holes under the armpits part front and back).
  std::optional<SliceComponent> middle(double y) const;
  // Hull girth of the middle piece, 0 where there is none.
  double middle_girth(double y) const;
  // Points of the legs at one side of the mid-plane (touching legs are parted at x = 0). Below the crotch only.
  std::vector<Vec2> leg(double y, Side side) const;
  // Front-to-back thickness of all pieces at the mid-plane, 0 where they leave it open.
  double middle_thickness(double y) const;
  // Whether a piece, however small, lies on the mid-plane, or those of both sides overlap there.
  bool middle_closed(double y) const;
  // How far an arm is from the trunk, to the side; none where it is no piece of its own.
  std::optional<double> arm_gap(double y, Side side) const;
  // Whether an arm is a piece of its own at this side.
  bool arm_apart(double y, Side side) const;

 private:
  MeshSlicer slicer_;
  double height_;
  double merge_within_;
};

// The level at which both arms would meet the trunk, mean of both, if the gaps between them went on closing upwards as
// they do between two widths (fractions of the height), the uppermost places of which are sought under `armpit`. m.
// None where a gap does not open so far.
std::optional<double> arms_meet(const BodySlices& slices, double armpit, double narrow, double wide);

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Where the sides of a trunk are and how it leans: what carries its skin round it and up and down front and back.
//
// The sides lie on the line from the hip joints to the armpits, as a tailor's side seam. The middle between back and
// front is no such line: it goes forward with a belly and back with a hunch, and the skin of the sides does not. Bones
// carry the trunk by that middle; here its skin slides round it until the sides lie where the target has them, most at
// the sides and not at all in the middle of front and back.
// Bones keep levels level. Here they lean as the side line does, and up to the chest also half as the middle of the
// chest does: both tell of it, neither surely. Metres, normalised frame.
#pragma once

#include "engine/bodies/coarse_fit.h"

namespace toile {

class TrunkSides {
 public:
  TrunkSides(const BodyProportions& reference, const BodyProportions& target);

  // The point of the reference at the level of `point` that lies as far back as its sides.
  Vec3 beside(const Vec3& point) const;
  // By how much a point of the reference's trunk slides on the target, where bones carry the point beside it to
  // `carried`.
  Vec3 slide(const Vec3& point, const Vec3& carried) const;

 private:
  // z of the sides.
  class Line {
   public:
    explicit Line(const Skeleton& skeleton);
    double at(double y) const;
    double lean() const;  // rad, forward

   private:
    Vec3 hip_, armpit_;
  };

  double sideways(const Vec3& point, double up) const;

  const BodyProportions& reference_;
  Line line_, target_line_;
  double lean_, chest_lean_;  // rad, forward, of the target against the reference
};

}  // namespace toile

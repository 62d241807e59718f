// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/find_shoulder.h"

#include <algorithm>

#include "engine/geometry/mesh_slicer.h"

namespace toile {
namespace {

// Fractions of the height.
constexpr double kInner = 0.065, kOuter = 0.175;  // of the two stations, from the mid-plane
constexpr int kStations = 45;
constexpr double kUsualTurn = 0.120;    // where arms are held so high that nothing bulges
constexpr double kLeastBulge = 0.0005;  // mean bulge that outweighs the usual place
constexpr double kInside = 0.0136;      // shoulder point to turn, mean of the 15 bodies of shared/data
constexpr double kCrest = 0.0025;       // skin this near under the top of a section is its crest

// Sections of one side, square to the way from the mid-plane out; slice points are (height, depth).
class SideSections {
 public:
  SideSections(const TriangleMesh& body, Side side, double below)
      : sign_(side == Left ? 1.0 : -1.0), below_(below), turned_(turn(body)), slicer_(turned_) {}

  // The highest point of the section at a distance from the mid-plane, under the head; in body coordinates.
  std::optional<double> top(double x) const {
    std::optional<double> highest;
    for (const SliceComponent& piece : slicer_.slice(x))
      for (const auto& segment : piece.segments)
        for (const Vec2& p : segment)
          if (p.x() < below_ && (!highest || p.x() > *highest)) highest = p.x();
    return highest;
  }

  // The middle of the crest, by length and height over its foot.
  Vec3 crest(double x, double y, double depth) const {
    double sum = 0.0, weight = 0.0;
    for (const SliceComponent& piece : slicer_.slice(x))
      for (const auto& [a, b] : piece.segments) {
        const Vec2 middle = 0.5 * (a + b);
        const double w = (b - a).norm() * std::clamp(middle.x() - (y - depth), 0.0, depth);
        if (middle.x() < below_) sum += w * middle.y(), weight += w;
      }
    return {sign_ * x, y, weight > 0 ? sum / weight : 0.0};
  }

 private:
  TriangleMesh turn(const TriangleMesh& body) const {
    TriangleMesh turned = body;
    turned.vertices.col(0) = body.vertices.col(1);
    turned.vertices.col(1) = sign_ * body.vertices.col(0);
    return turned;
  }

  double sign_, below_;
  TriangleMesh turned_;
  MeshSlicer slicer_;
};

}  // namespace

Vec3 find_shoulder_point(const TriangleMesh& body, const Skeleton& skeleton, Side side) {
  const double h = skeleton.height;
  const SideSections sections(body, side, skeleton.neck_y);
  std::vector<Vec2> outline;  // distance from the mid-plane, height
  for (int i = 0; i < kStations; ++i) {
    const double x = (kInner + (kOuter - kInner) * i / (kStations - 1)) * h;
    if (const auto y = sections.top(x)) outline.emplace_back(x, *y);
  }
  double weight = kStations * kLeastBulge * h, sum = weight * kUsualTurn * h;
  for (const Vec2& p : outline) {
    const double along = (p.x() - outline.front().x()) / (outline.back().x() - outline.front().x());
    const double chord = outline.front().y() + along * (outline.back().y() - outline.front().y());
    const double bulge = std::max(0.0, p.y() - chord);
    weight += bulge, sum += bulge * p.x();
  }
  const double x = sum / weight - kInside * h;
  return sections.crest(x, sections.top(x).value_or(skeleton.arms[side].shoulder.y()), kCrest * h);
}

}  // namespace toile

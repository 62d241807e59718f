// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/crotch_profile.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "engine/geometry/disjoint_sets.h"

namespace toile {
namespace {

// Fractions of the height, from the bridged crotch: where skin may be its underside, and how far up it must lead so
// that it is no remnant between the thighs.
constexpr double kUnder = 0.03, kOver = 0.05, kCentral = 0.012, kLeadsUp = 0.03;
constexpr double kEnd = 0.012;      // what lies this near to the end tells its slope
constexpr double kWall = 0.7;       // cosine to the side over which skin is an inner thigh
constexpr std::size_t kLowest = 3;  // segments whose mean is the end
constexpr double kSteepest = 2.0;

struct Segment {
  Vec3 middle, normal;  // of the skin; its length is the segment's
};

class MiddleSkin {
 public:
  MiddleSkin(const TriangleMesh& seen, const Vec3& bridged, double height)
      : seen_(seen), bridged_(bridged), height_(height), sets_(seen.vertex_count()) {
    for (int f = 0; f < seen.triangle_count(); ++f)
      if (is_underside(f)) {
        underside_.push_back(f);
        for (int k = 1; k < 3; ++k) sets_.join(seen.triangles(f, 0), seen.triangles(f, k));
      }
    std::vector<bool> leads(static_cast<std::size_t>(seen.vertex_count()), false);
    for (const int f : underside_)
      if (middle(f).y() > bridged.y() + kLeadsUp * height) leads[set_of(f)] = true;
    std::erase_if(underside_, [&](int f) { return !leads[set_of(f)]; });
  }

  // Where the mid-plane cuts the underside behind (sign -1) or in front of (1) the bridged crotch, lowest first.
  std::vector<Segment> profile(double sign) {
    std::vector<Segment> found;
    for (const int f : underside_)
      if (const auto segment = cut(f))
        if (sign * (segment->middle.z() - bridged_.z()) >= 0 && segment->middle.y() < bridged_.y() + kOver * height_)
          found.push_back(*segment);
    std::sort(found.begin(), found.end(),
              [](const Segment& a, const Segment& b) { return a.middle.y() < b.middle.y(); });
    return found;
  }

 private:
  Vec3 corner(int f, int k) const { return seen_.vertices.row(seen_.triangles(f, k % 3)); }
  Vec3 middle(int f) const { return (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3.0; }
  Vec3 normal(int f) const { return (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).normalized(); }
  std::size_t set_of(int f) { return static_cast<std::size_t>(sets_.find(seen_.triangles(f, 0))); }

  bool is_underside(int f) const {
    const Vec3 off = middle(f) - bridged_;
    return std::abs(off.x()) < kCentral * height_ && off.y() > -kUnder * height_ &&
           off.y() < (kOver + kUnder) * height_ && std::abs(normal(f).x()) < kWall;
  }

  std::optional<Segment> cut(int f) const {
    std::vector<Vec3> ends;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = corner(f, k), b = corner(f, k + 1);
      if ((a.x() > 0) != (b.x() > 0)) ends.push_back(a + (b - a) * a.x() / (a.x() - b.x()));
    }
    if (ends.size() < 2) return std::nullopt;
    return Segment{0.5 * (ends[0] + ends[1]), normal(f) * (ends[0] - ends[1]).norm()};
  }

  const TriangleMesh& seen_;
  const Vec3& bridged_;
  double height_;
  DisjointSets sets_;
  std::vector<int> underside_;
};

// Where a parabola that starts at the end of the profile with its slope levels out.
std::optional<double> levelled_out(const std::vector<Segment>& profile, double height, double reach) {
  if (profile.size() < kLowest) return std::nullopt;
  Vec3 end = Vec3::Zero(), normal = Vec3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < kLowest; ++i) {
    end += profile[i].normal.norm() * profile[i].middle;
    weight += profile[i].normal.norm();
  }
  if (weight <= 0) return std::nullopt;
  end /= weight;
  for (const Segment& s : profile)
    if ((s.middle - end).norm() < kEnd * height) normal += s.normal;
  const double slope = std::min(kSteepest, std::abs(normal.z()) / std::max(std::abs(normal.y()), 1e-9));
  return end.y() - 0.5 * slope * reach;
}

}  // namespace

std::optional<double> crotch_by_profile(const TriangleMesh& seen, const Vec3& bridged, double height, double reach) {
  MiddleSkin skin(seen, bridged, height);
  const auto behind = levelled_out(skin.profile(-1.0), height, reach);
  const auto front = levelled_out(skin.profile(1.0), height, reach);
  if (behind && front) return std::min(*behind, *front);
  return behind ? behind : front;
}

}  // namespace toile

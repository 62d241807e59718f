// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/crotch_profile.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

constexpr double kHeight = 1.7;  // m

// The underside of a trunk, y = depth(z) over -0.12 < z < 0.12, facing down, without what lies between two z.
class Underside {
 public:
  template <class Depth>
  void add(double from, double to, Depth depth) {
    constexpr double kStep = 0.002, kHalfWidth = 0.009;  // no vertex lies on the mid-plane
    for (double z = from; z < to - 1e-9; z += kStep)
      for (double x = -kHalfWidth; x < kHalfWidth - 1e-9; x += 2 * kHalfWidth / 3)
        add_quad({x, depth(z), z}, {x + 2 * kHalfWidth / 3, depth(z + kStep), z + kStep});
  }

  TriangleMesh mesh() const {
    TriangleMesh out;
    out.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i) out.vertices.row(static_cast<Eigen::Index>(i)) = points_[i];
    out.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t i = 0; i < triangles_.size(); ++i) out.triangles.row(static_cast<Eigen::Index>(i)) = triangles_[i];
    return out;
  }

 private:
  int point(const Vec3& p) {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if ((points_[i] - p).norm() < 1e-6) return static_cast<int>(i);
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }
  void add_quad(const Vec3& low, const Vec3& high) {
    const int a = point(low), b = point({high.x(), low.y(), low.z()}), c = point(high),
              d = point({low.x(), high.y(), high.z()});
    triangles_.emplace_back(a, b, c), triangles_.emplace_back(a, c, d);
  }

  std::vector<Vec3> points_;
  std::vector<Eigen::Vector3i> triangles_;
};

constexpr double kBottom = 0.8, kCurve = 10.0, kHole = 0.03;  // m, 1/m, m
double parabola(double z) {
  return kBottom + kCurve * z * z;
}
constexpr double kNearBottom =
    2e-3;  // m: the slope is that of the last 2 cm, which carries a curved end on a little too far
const Vec3 kBridged(0.0, kBottom + 0.005, 0.0);

TEST(CrotchProfile, AParabolaThatIsCutOffGoesOnToItsBottom) {
  Underside skin;
  skin.add(-0.12, -kHole, parabola);
  skin.add(kHole, 0.12, parabola);
  const auto found = crotch_by_profile(skin.mesh(), kBridged, kHeight, kHole);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, kBottom, kNearBottom);
}

TEST(CrotchProfile, TheLowerOfBothEndsTells) {
  constexpr double kLower = 0.004;
  Underside skin;
  skin.add(-0.12, -kHole, [](double z) { return parabola(z) - kLower; });
  skin.add(kHole, 0.12, parabola);
  EXPECT_NEAR(crotch_by_profile(skin.mesh(), kBridged, kHeight, kHole).value(), kBottom - kLower, kNearBottom);
}

TEST(CrotchProfile, OneEndIsEnough) {
  Underside skin;
  skin.add(kHole, 0.12, parabola);
  EXPECT_NEAR(crotch_by_profile(skin.mesh(), kBridged, kHeight, kHole).value(), kBottom, kNearBottom);
}

// What is left of a web between the thighs lies lower than the trunk and leads nowhere.
TEST(CrotchProfile, RemnantsThatLeadNowhereAreNotTheTrunk) {
  Underside skin;
  skin.add(-0.12, -kHole, parabola);
  skin.add(-0.01, 0.01, [](double) { return kBottom - 0.03; });
  EXPECT_NEAR(crotch_by_profile(skin.mesh(), kBridged, kHeight, kHole).value(), kBottom, kNearBottom);
}

TEST(CrotchProfile, NothingIsToldWhereNoSkinLeadsThere) {
  Underside skin;
  skin.add(-0.01, 0.01, [](double) { return kBottom - 0.03; });
  EXPECT_FALSE(crotch_by_profile(skin.mesh(), kBridged, kHeight, kHole).has_value());
}

}  // namespace
}  // namespace toile

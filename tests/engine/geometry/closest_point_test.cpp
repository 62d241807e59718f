// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/closest_point.h"

#include <random>

#include <gtest/gtest.h>

namespace toile {
namespace {

struct Surface {
  Points3 vertices;
  Triangles triangles;
};

// A sphere of `rings` x 2 `rings` cells about `centre`, outward.
Surface sphere(int rings, double radius, const Vec3& centre) {
  const int around = 2 * rings;
  Surface s;
  s.vertices.resize((rings - 1) * around + 2, 3);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double theta = M_PI * i / rings, phi = 2 * M_PI * j / around;
      s.vertices.row((i - 1) * around + j) =
          (centre + radius * Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)))
              .transpose();
    }
  const int north = static_cast<int>(s.vertices.rows()) - 2, south = north + 1;
  s.vertices.row(north) = (centre + Vec3(0, radius, 0)).transpose();
  s.vertices.row(south) = (centre - Vec3(0, radius, 0)).transpose();
  std::vector<Eigen::Vector3i> t;
  for (int j = 0; j < around; ++j) {
    const int k = (j + 1) % around, last = (rings - 2) * around;
    t.push_back({north, j, k});
    t.push_back({south, last + k, last + j});
    for (int i = 0; i + 2 < rings; ++i) {
      t.push_back({i * around + j, (i + 1) * around + j, (i + 1) * around + k});
      t.push_back({i * around + j, (i + 1) * around + k, i * around + k});
    }
  }
  s.triangles.resize(static_cast<Eigen::Index>(t.size()), 3);
  for (std::size_t f = 0; f < t.size(); ++f) s.triangles.row(static_cast<Eigen::Index>(f)) = t[f].transpose();
  return s;
}

Surface joined(const Surface& a, const Surface& b) {
  Surface s;
  s.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
  s.vertices << a.vertices, b.vertices;
  s.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  s.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.vertices.rows())).matrix();
  return s;
}

SurfacePoint brute_force(const Surface& s, const Vec3& p) {
  SurfacePoint best;
  for (int f = 0; f < s.triangles.rows(); ++f) {
    SurfacePoint c = closest_point_on_triangle(p, s.vertices.row(s.triangles(f, 0)), s.vertices.row(s.triangles(f, 1)),
                                               s.vertices.row(s.triangles(f, 2)));
    c.triangle = f;
    if (c.distance_squared < best.distance_squared) best = c;
  }
  return best;
}

Vec3 random_point(std::mt19937& random, double range) {
  std::uniform_real_distribution<double> u(-range, range);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

TEST(ClosestPoint, TriangleFeatureIsFaceEdgeOrCorner) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto face = closest_point_on_triangle({0.25, 0.25, 2}, a, b, c);
  EXPECT_EQ(face.feature, TriangleFeature::Face);
  EXPECT_DOUBLE_EQ(face.distance(), 2);
  const auto edge = closest_point_on_triangle({1, 1, 0}, a, b, c);
  EXPECT_EQ(edge.feature, TriangleFeature::Edge);
  EXPECT_EQ(edge.feature_index, 1);
  EXPECT_NEAR(edge.distance(), std::sqrt(0.5), 1e-15);
  const auto corner = closest_point_on_triangle({-1, -1, 1}, a, b, c);
  EXPECT_EQ(corner.feature, TriangleFeature::Corner);
  EXPECT_EQ(corner.feature_index, 0);
  EXPECT_NEAR(corner.distance_squared, 3, 1e-15);
  for (const auto& r : {face, edge, corner}) {
    EXPECT_NEAR(r.barycentric.sum(), 1, 1e-15);
    EXPECT_LT((r.barycentric[0] * a + r.barycentric[1] * b + r.barycentric[2] * c - r.point).norm(), 1e-15);
  }
}

TEST(ClosestPoint, DegenerateTriangleIsItsLongestEdge) {
  const auto flat = closest_point_on_triangle({0.5, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0.5, 0, 0});
  EXPECT_NEAR(flat.distance(), 1, 1e-12);
  const auto dot = closest_point_on_triangle({0, 2, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(dot.distance(), 2, 1e-12);
}

TEST(ClosestPoint, TreeAgreesWithBruteForceWithAndWithoutAStart) {
  const Surface s = joined(sphere(12, 0.7, {0.1, 0, 0}), sphere(7, 0.2, {-1, 0.3, 0.2}));
  const SurfaceTree tree(s.vertices, s.triangles);
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, 1.5);
    const SurfacePoint expected = brute_force(s, p);
    const SurfacePoint found = tree.closest_point(p);
    ASSERT_NEAR(found.distance(), expected.distance(), 1e-13);
    const SurfacePoint warm = tree.closest_point(p, 100, i % tree.triangle_count());
    ASSERT_NEAR(warm.distance(), expected.distance(), 1e-13);
    const Vec3 b = found.barycentric;
    const auto t = s.triangles.row(found.triangle);
    const Vec3 at = b[0] * s.vertices.row(t[0]) + b[1] * s.vertices.row(t[1]) + b[2] * s.vertices.row(t[2]);
    ASSERT_LT((at - found.point).norm(), 1e-12);
  }
}

// Lattice nodes in planes of symmetry and beyond edges and corners lie equally near to several triangles.
TEST(ClosestPoint, TheDistanceHasTheSameBitsWhateverTheSearchStartsWith) {
  const Surface s = sphere(12, 0.7, {0.1, 0, 0});
  const SurfaceTree tree(s.vertices, s.triangles);
  std::mt19937 random(8);
  int other_triangle = 0;
  for (int i = 0; i < 300; ++i) {
    Vec3 p = random_point(random, 1.5);
    if (i % 2 == 0) p = 1.7 * s.vertices.row(i % s.vertices.rows()).transpose();
    int alone = -1;
    const double distance = tree.distance(p, alone);
    ASSERT_NEAR(distance, brute_force(s, p).distance(), 1e-13);
    for (int start = 0; start < tree.triangle_count(); ++start) {
      int from = start;
      ASSERT_EQ(tree.distance(p, from), distance);
      other_triangle += from != alone;
    }
  }
  EXPECT_GT(other_triangle, 0);
}

TEST(ClosestPoint, NothingIsFoundBeyondTheGivenDistance) {
  const Surface s = sphere(6, 0.5, {0, 0, 0});
  const SurfaceTree tree(s.vertices, s.triangles);
  EXPECT_FALSE(tree.closest_point({0, 2, 0}, 1.4).found());
  EXPECT_TRUE(tree.closest_point({0, 2, 0}, 1.6).found());
  EXPECT_FALSE(SurfaceTree().closest_point({0, 0, 0}).found());
}

TEST(ClosestPoint, WindingNumberCountsOverlappingPartsAndIgnoresTouchingCorners) {
  const Surface s = joined(sphere(8, 0.5, {0, 0, 0}), sphere(8, 0.5, {0.4, 0, 0}));
  const SurfaceTree tree(s.vertices, s.triangles);
  EXPECT_EQ(tree.winding_number({-0.3, 0.01, 0}), 1);
  EXPECT_EQ(tree.winding_number({0.2, 0.01, 0}), 2);
  EXPECT_EQ(tree.winding_number({0.7, 0.01, 0}), 1);
  EXPECT_EQ(tree.winding_number({1.2, 0.01, 0}), 0);
  // Rays through vertices and along edges of the lattice: each crossing counts once.
  for (int v = 0; v < s.vertices.rows(); ++v) {
    const Vec3 beside = Vec3(s.vertices.row(v)) - Vec3(0, 0, 5);
    ASSERT_EQ(tree.winding_number(beside), 0) << v;
  }
}

TEST(ClosestPoint, SignedDistanceOfASphereIsRightOnBothSides) {
  const Surface s = sphere(96, 0.5, {0, 1, 0});
  const SurfaceTree tree(s.vertices, s.triangles);
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(random, 0.8) + Vec3(0, 1, 0);
    const double exact = (p - Vec3(0, 1, 0)).norm() - 0.5;
    ASSERT_NEAR(tree.signed_distance(p), exact, 4e-4);  // chord sag of the sphere's facets
  }
}

}  // namespace
}  // namespace toile

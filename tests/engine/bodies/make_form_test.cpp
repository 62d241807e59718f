// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/make_form.h"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace toile {
namespace {

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.triangles(f, 0)), b = mesh.vertices.row(mesh.triangles(f, 1)),
               c = mesh.vertices.row(mesh.triangles(f, 2));
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

TEST(MakeForm, IsClosedAndOutwardOriented) {
  const TriangleMesh mesh = make_builtin_form("tube-14-100").surface;
  std::map<std::pair<int, int>, int> halves;
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) ++halves[{mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)}];
  for (const auto& [edge, count] : halves) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(halves.count({edge.second, edge.first}), 1u);
  }
  // A prism over the regular 96-gon.
  const double exact = 0.5 * 96 * 0.14 * 0.14 * std::sin(2 * std::numbers::pi / 96) * 1.0;
  EXPECT_NEAR(signed_volume(mesh), exact, 1e-12);
}

TEST(MakeForm, SharesOneTopologyBetweenTubes) {
  const Body narrow = make_builtin_form("tube-14-100"), wide = make_builtin_form("tube-18-125");
  EXPECT_EQ(narrow.surface.triangles, wide.surface.triangles);
  EXPECT_NE(narrow.surface.vertices, wide.surface.vertices);
  EXPECT_EQ(wide.surface.vertices.col(1).maxCoeff(), 1.25);
}

TEST(MakeForm, RefusesWhatIsNoForm) {
  EXPECT_THROW(make_builtin_form("tube-14"), Error);
  EXPECT_THROW(make_builtin_form("tube--3-100"), Error);
  EXPECT_THROW(make_builtin_form("tube-14-1000"), Error);
  EXPECT_THROW(make_form({.profile = {{0.0, 0.1}}}), Error);
}

}  // namespace
}  // namespace toile

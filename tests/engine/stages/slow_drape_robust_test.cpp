// SPDX-License-Identifier: GPL-3.0-or-later
// Drapes under disturbance: bad starts, odd fabrics, coarse, huge and wrong-sized bodies, mirrored and moved scenes.
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/import_body.h"
#include "engine/core/error.h"
#include "engine/geometry/decimate.h"
#include "engine/stages/arrange_panels.h"
#include "tests/support/dice.h"
#include "tests/support/dressed.h"
#include "tests/support/shared_data.h"
#include "tests/support/symmetric_body.h"

namespace toile {
namespace {

constexpr int kTriangles = 2000;

DrapeResult drape_of(const test::Dressing& d) {
  return drape(d.pattern, d.mesh, d.body, d.options, nullptr);
}

void expect_settled(const DrapeResult& result) {
  EXPECT_NE(result.quality.rest, Rest::NotAtRest) << result.quality.residual << ", " << result.quality.settling_move;
  EXPECT_TRUE(result.drape.nodes.allFinite());
  EXPECT_EQ(result.quality.nodes_inside, 0) << result.quality.deepest_node;
  EXPECT_EQ(result.quality.edges_inside, 0) << result.quality.deepest_edge;
}

// At rest or refused for a reason; never nonsense.
void expect_settled_or_classified(const test::Dressing& d) {
  try {
    expect_settled(drape_of(d));
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::DrapeFailed);
    EXPECT_FALSE(error.message.empty());
  }
}

class SlowDisturbedDrape : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    TOILE_REQUIRE_SHARED_DATA();
    dressed_ = test::dress(GetParam(), kTriangles);
  }
  test::Dressing dressed_;
};

TEST_P(SlowDisturbedDrape, GarmentTurnedInsideOutComesToRest) {
  Drape inside_out = drape_of(dressed_).drape;
  inside_out.nodes.col(0) *= -1;
  expect_settled(drape_from(dressed_.pattern, dressed_.mesh, dressed_.body, inside_out, dressed_.options, nullptr));
}

TEST_P(SlowDisturbedDrape, NoiseOfFiveCentimetresSettlesWithoutKnots) {
  Drape noisy = drape_of(dressed_).drape;
  test::Dice dice(7);
  for (Eigen::Index i = 0; i < noisy.nodes.size(); ++i) noisy.nodes.data()[i] += dice.between(-0.05, 0.05);
  const DrapeResult result =
      drape_from(dressed_.pattern, dressed_.mesh, dressed_.body, noisy, dressed_.options, nullptr);
  expect_settled(result);
  EXPECT_LE(result.quality.crossing_pairs, 2);
}

// Worn, then suddenly cut from a smaller size.
TEST_P(SlowDisturbedDrape, GarmentAThirdTooSmallSettlesOutsideTheBody) {
  const Drape worn = drape_of(dressed_).drape;
  PatternMesh small = dressed_.mesh;
  small.rest *= 0.7;
  expect_settled(drape_from(dressed_.pattern, small, dressed_.body, worn, dressed_.options, nullptr));
}

// Worn, then suddenly cut from a larger size: it slides down until it is caught, and hangs in folds.
TEST_P(SlowDisturbedDrape, GarmentHalfAgainAsLargeSettles) {
  const Drape worn = drape_of(dressed_).drape;
  PatternMesh large = dressed_.mesh;
  large.rest *= 1.5;
  const DrapeResult result = drape_from(dressed_.pattern, large, dressed_.body, worn, dressed_.options, nullptr);
  expect_settled(result);
  EXPECT_EQ(result.quality.crossing_pairs, 0);
}

TEST_P(SlowDisturbedDrape, ClothTenTimesStifferOrSofterSettles) {
  for (double factor : {10.0, 0.1}) {
    test::Dressing d = dressed_;
    d.pattern.fabric.weft_stiffness *= factor;
    d.pattern.fabric.warp_stiffness *= factor;
    d.pattern.fabric.shear_stiffness *= factor;
    SCOPED_TRACE(factor);
    expect_settled(drape_of(d));
  }
}

TEST_P(SlowDisturbedDrape, BoardStiffClothAndNoGravityEndInRestOrAReason) {
  test::Dressing d = dressed_;
  d.pattern.fabric.bending_stiffness *= 1000;
  expect_settled_or_classified(d);
  d = dressed_;
  d.options.gravity = 0;
  expect_settled_or_classified(d);
}

// Every triangle in four.
TriangleMesh split(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Vec3> vertices;
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) vertices.emplace_back(mesh.vertices.row(i));
  TriangleMesh fine;
  fine.triangles.resize(4 * mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    std::array<int, 3> corner, middle;
    for (int k = 0; k < 3; ++k) {
      corner[static_cast<std::size_t>(k)] = mesh.triangles(f, k);
      const std::pair<int, int> ends = std::minmax(mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3));
      const auto [found, added] = middles.try_emplace(ends, static_cast<int>(vertices.size()));
      if (added) vertices.emplace_back(0.5 * (mesh.vertices.row(ends.first) + mesh.vertices.row(ends.second)));
      middle[static_cast<std::size_t>(k)] = found->second;
    }
    for (int k = 0; k < 3; ++k)
      fine.triangles.row(4 * f + k) << corner[static_cast<std::size_t>(k)], middle[static_cast<std::size_t>(k)],
          middle[static_cast<std::size_t>((k + 2) % 3)];
    fine.triangles.row(4 * f + 3) << middle[0], middle[1], middle[2];
  }
  fine.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    fine.vertices.row(static_cast<Eigen::Index>(i)) = vertices[i].transpose();
  return fine;
}

TEST_P(SlowDisturbedDrape, CoarseAndHugeBodiesAreDressed) {
  test::Dressing d = dressed_;
  d.body.surface = decimate(dressed_.body.surface, 1000);
  ASSERT_LT(d.body.surface.triangle_count(), 2010);
  expect_settled(drape_of(d));
  d.body.surface = split(split(dressed_.body.surface));
  ASSERT_GT(d.body.surface.triangle_count(), 500000);
  expect_settled(drape_of(d));
}

INSTANTIATE_TEST_SUITE_P(SlowThree, SlowDisturbedDrape,
                         testing::Values("tshirt_fitted", "pants_straight", "dress_sleeveless"),
                         [](const auto& garment) { return garment.param; });

TEST(SlowDrapeScene, SymmetricBodyIsDressedSymmetrically) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* garment : {"tshirt_fitted", "pants_straight", "skirt_pencil"}) {
    SCOPED_TRACE(garment);
    test::Dressing d = test::dress(garment, 4300);
    d.body.surface = test::mirrored_half(d.body.surface);
    d.body.skeleton = find_skeleton(d.body.surface).skeleton;
    const DrapeResult result = drape_of(d);
    expect_settled(result);
    Triangles sewn(d.mesh.triangle_count(), 3);
    for (int f = 0; f < d.mesh.triangle_count(); ++f) sewn.row(f) = d.mesh.nodes_of_triangle(f).transpose();
    const SurfaceTree cloth(result.drape.nodes, sewn);
    double most = 0;
    for (Eigen::Index i = 0; i < result.drape.nodes.rows(); ++i) {
      Vec3 mirrored = result.drape.nodes.row(i);
      mirrored.x() *= -1;
      most = std::max(most, cloth.closest_point(mirrored).distance());
    }
    EXPECT_LT(most, 1e-6);
  }
}

TEST(SlowDrapeScene, BodyTurnedMovedAndScaledInItsFileIsDressedTheSame) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing dressed = test::dress("tshirt_fitted", kTriangles);
  const auto drape_on_moved = [&](double yaw, const Vec3& shift, double scale) {
    test::Dressing d = dressed;
    TriangleMesh in_file = d.body.surface;
    const Mat3 turn = Eigen::AngleAxisd(yaw, Vec3::UnitY()).toRotationMatrix();
    in_file.vertices = scale * ((in_file.vertices * turn.transpose()).rowwise() + shift.transpose());
    const ImportBodyResult imported = import_body(in_file, "body", {}, nullptr);
    EXPECT_FALSE(imported.normalisation.kept_coordinates);
    d.body = imported.body;
    return drape_of(d).drape.nodes;
  };
  const Points3 one = drape_on_moved(0.5, Vec3(0.6, 0.13, 0.3), 1),
                other = drape_on_moved(3.5, Vec3(-0.2, 1.1, 2.2), 100);
  EXPECT_LT((one - other).rowwise().norm().maxCoeff(), 1e-4);
}

TEST(SlowDrapeScene, TwoThreadsGiveTheBytesOfOne) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing tshirt = test::dress("tshirt_fitted", kTriangles),
                       skirt = test::dress("skirt_circle", kTriangles);
  const Points3 alone[2] = {drape_of(tshirt).drape.nodes, drape_of(skirt).drape.nodes};
  Points3 beside[2];
  std::thread first([&] { beside[0] = drape_of(tshirt).drape.nodes; }),
      second([&] { beside[1] = drape_of(skirt).drape.nodes; });
  first.join(), second.join();
  for (int k = 0; k < 2; ++k) EXPECT_TRUE(alone[k] == beside[k]);
}

TEST(SlowDrapeScene, PinnedOpeningsStretchTheGarmentInsteadOfSliding) {
  TOILE_REQUIRE_SHARED_DATA();
  test::Dressing d = test::dress("leggings_tight", kTriangles);
  const DrapeResult own = drape_of(d);
  Drape longer = own.drape;
  for (Eigen::Index i = 0; i < longer.nodes.rows(); ++i) longer.nodes(i, 1) += 0.05 * (longer.nodes(i, 1) - 0.6);
  const auto drift = [&](bool pinned) {
    d.options.pin_openings = pinned;
    const DrapeResult result = drape_from(d.pattern, d.mesh, d.body, longer, d.options, nullptr);
    EXPECT_NE(result.quality.rest, Rest::NotAtRest);
    double most = 0;
    for (const std::vector<int>& line : free_lines(d.pattern, d.mesh))
      for (int n : line) most = std::max(most, (result.drape.nodes.row(n) - longer.nodes.row(n)).norm());
    return most;
  };
  EXPECT_LT(drift(true), 0.003);
  EXPECT_GT(drift(false), 0.010);
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/carry_drape.h"

#include <gtest/gtest.h>

#include "engine/sim/cloth.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

const Vec3 kSlip(0.0, 0.0004, 0.0);  // m, of held nodes from their anchors
constexpr double kPressure = 120.0;  // of friction, N/m^2

// A sheet stretched and turned out of its plane, held where it is above `lowest`.
struct CarriedSheet {
  Pattern pattern = test::sheet_pattern(0.4, 0.6, 1.0);
  PatternMesh mesh;
  DrapeEnd end;

  explicit CarriedSheet(double lowest) : mesh(test::structured_mesh(pattern, 8, 12)) {
    const Eigen::VectorXd area = make_cloth(pattern, mesh).node_area;
    end.drape.nodes = placed(mesh);
    end.held.hold_height = 1.05;
    end.held.friction = {Eigen::VectorXd::Zero(mesh.node_count), Points3::Zero(mesh.node_count, 3),
                         Points3::Zero(mesh.node_count, 3)};
    for (int i = 0; i < mesh.node_count; ++i) {
      if (end.drape.nodes(i, 1) < lowest) continue;
      end.held.friction.load[i] = kPressure * area[i];
      end.held.friction.anchor.row(i) = end.drape.nodes.row(i) - kSlip.transpose();
      end.held.friction.normal.row(i) << 0, 0, 1;
    }
  }
  Points3 placed(const PatternMesh& other) const {
    const Points3 flat = test::placed_nodes(pattern, other);
    Eigen::Matrix3d by;
    by << 1.1, 0.1, 0, 0, 1.2, 0.3, 0, 0, 1;
    return flat * by;
  }
};

TEST(CarryDrape, PutsEveryNodeWhereItsPointOfTheClothLies) {
  const CarriedSheet sheet(0.0);
  const PatternMesh finer = test::structured_mesh(sheet.pattern, 13, 17);
  const DrapeEnd carried = carry_drape(sheet.pattern, sheet.mesh, sheet.end, finer);
  EXPECT_LT((carried.drape.nodes - sheet.placed(finer)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(carried.held.hold_height, 1.05);
}

TEST(CarryDrape, CarriesFrictionPerArea) {
  const CarriedSheet sheet(0.0);
  const PatternMesh finer = test::structured_mesh(sheet.pattern, 13, 17);
  const DrapeEnd carried = carry_drape(sheet.pattern, sheet.mesh, sheet.end, finer);
  const Eigen::VectorXd area = make_cloth(sheet.pattern, finer).node_area;
  EXPECT_LT((carried.held.friction.load - kPressure * area).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(((carried.drape.nodes - carried.held.friction.anchor).rowwise() - kSlip.transpose()).norm(), 1e-9);
  EXPECT_LT((carried.held.friction.normal.rowwise() - Eigen::RowVector3d(0, 0, 1)).norm(), 1e-9);
}

// Nodes that never touched have no anchor: their neighbours' must not be drawn to where it would be.
TEST(CarryDrape, ClothBesideTheHeldIsNotDrawnAway) {
  const CarriedSheet sheet(0.9);
  const PatternMesh finer = test::structured_mesh(sheet.pattern, 13, 17);
  const DrapeEnd carried = carry_drape(sheet.pattern, sheet.mesh, sheet.end, finer);
  int held = 0, between = 0;
  const Eigen::VectorXd area = make_cloth(sheet.pattern, finer).node_area;
  for (int i = 0; i < finer.node_count; ++i) {
    const double load = carried.held.friction.load[i];
    if (load <= 0) continue;
    ++held;
    between += load < 0.99 * kPressure * area[i];
    EXPECT_LE((carried.drape.nodes.row(i) - carried.held.friction.anchor.row(i)).norm(), kSlip.norm() + 1e-12);
  }
  EXPECT_GT(held, 20);
  EXPECT_LT(held, finer.node_count);
  EXPECT_GT(between, 5);
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/contact.h"

#include "engine/sim/drape_energy.h"
#include "tests/engine/sim/finite_difference.h"
#include "tests/engine/sim/tube_scene.h"

namespace toile {
namespace {

using test::kRadius;
using Scene = test::TubeScene;

test::EnergyFunction energy_of(Contact& contact) {
  return [&contact](const Points3& x, Points3& g) {
    g.setZero();
    return contact.energy_gradient(x, g);
  };
}

TEST(Contact, ProfileIsContinuousWithItsSlopeAtBothEnds) {
  double slope = 0;
  EXPECT_EQ(contact_profile(-1, 0.01, slope), 0);
  EXPECT_EQ(slope, 0);
  const double below = contact_profile(0.01 - 1e-9, 0.01, slope), above = contact_profile(0.01 + 1e-9, 0.01, slope);
  EXPECT_NEAR(above - below, 2e-9 * 0.01, 1e-14);
  EXPECT_EQ(slope, 0.01);
  for (double depth : {0.004, 0.03}) {
    const double difference = contact_profile(depth + 1e-7, 0.01, slope) - contact_profile(depth - 1e-7, 0.01, slope);
    contact_profile(depth, 0.01, slope);
    EXPECT_NEAR(difference / 2e-7, slope, 1e-9);
  }
}

TEST(Contact, FrictionProfileIsASpringThenACoulombForce) {
  double slope_over_length = 0;
  for (double length : {0.0003, 0.0009, 0.002}) {
    double ignored = 0;
    const double difference =
        friction_profile(length + 1e-8, 0.001, ignored) - friction_profile(length - 1e-8, 0.001, ignored);
    friction_profile(length, 0.001, slope_over_length);
    EXPECT_NEAR(difference / 2e-8, slope_over_length * length, 1e-6);
  }
  friction_profile(0.002, 0.001, slope_over_length);
  EXPECT_DOUBLE_EQ(slope_over_length * 0.002, 1);
  EXPECT_EQ(friction_profile(0, 0.001, slope_over_length), 0);
  EXPECT_DOUBLE_EQ(slope_over_length, 2000);
}

TEST(Contact, GradientIsTheDerivativeWhenTouchingAndWhenDeep) {
  Scene s;
  for (double radius : {kRadius + 0.001, kRadius - 0.02}) {
    Contact contact(s.cloth, s.field, {});
    test::expect_gradient(energy_of(contact), s.at(radius) + test::random_points(s.mesh.node_count, 3e-4, 5), 1e-7,
                          1e-5);
  }
}

TEST(Contact, FrictionGradientIsTheDerivativeStickingAndSliding) {
  Scene s;
  const Points3 touching = s.at(kRadius + 0.002);
  for (double slide : {0.0004, 0.004}) {
    Contact contact(s.cloth, s.field, {});
    contact.freeze_friction(touching);
    Points3 moved = touching;
    moved.col(1).array() += slide;
    test::expect_gradient(energy_of(contact), moved, 1e-7, 1e-4);
  }
}

TEST(Contact, SlidingFrictionIsMuTimesTheContactForce) {
  Scene s;
  Contact contact(s.cloth, s.field, {});
  const Points3 touching = s.at(kRadius + 0.002);
  contact.freeze_friction(touching);
  Points3 moved = touching, gradient = Points3::Zero(s.mesh.node_count, 3);
  moved.col(1).array() += 0.01;
  contact.energy_gradient(moved, gradient);
  const double normal_force = 2e6 * 0.001 * s.cloth.node_area.sum();
  EXPECT_NEAR(gradient.col(1).sum(), 0.3 * normal_force, 1e-6 * normal_force);
}

TEST(Contact, SkippingFarNodesNeverMissesAContact) {
  Scene s;
  Contact contact(s.cloth, s.field, {});
  Points3 gradient = Points3::Zero(s.mesh.node_count, 3);
  for (double radius : {0.30, 0.25, 0.144, 0.16, 0.142}) {
    gradient.setZero();
    const double energy = contact.energy_gradient(s.at(radius), gradient);
    const double depth = std::max(0.0, kRadius + 0.003 - radius);
    EXPECT_NEAR(energy, 0.5 * 2e6 * depth * depth * s.cloth.node_area.sum(), 1e-9) << radius;
  }
}

TEST(Contact, WholeEnergyHasTheRightGradientWithHoldsAndPins) {
  Scene s;
  Contact contact(s.cloth, s.field, {});
  DrapeEnergy energy(s.cloth, &contact, 9.81);
  const Points3 x = s.at(kRadius + 0.002) + test::random_points(s.mesh.node_count, 5e-4, 9);
  energy.holds = {{3, x(3, 1) + 0.01, 500.0}, {4, x(4, 1) - 0.01, 500.0}};
  energy.pins = {{7, Vec3(0.1, 0.2, 0.3), 300.0}};
  contact.freeze_friction(x);
  test::expect_gradient([&](const Points3& p, Points3& g) { return energy.evaluate(p, g); },
                        x + test::random_points(s.mesh.node_count, 2e-4, 11), 1e-7, 1e-5);
}

}  // namespace
}  // namespace toile

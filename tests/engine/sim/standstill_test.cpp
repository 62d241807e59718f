// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/standstill.h"

#include <cmath>

#include <gtest/gtest.h>

namespace toile {
namespace {

// Rounds until it is told, at most 100; `residual`, `energy` and `tangle` of round i.
template <class Residual, class Energy, class Tangle>
int rounds(Residual residual, Energy energy, Tangle tangle) {
  Standstill standstill;
  for (int i = 0; i < 100; ++i)
    if (standstill.after_round(residual(i), energy(i), tangle(i))) return i + 1;
  return 100;
}

template <class Residual, class Energy>
int rounds(Residual residual, Energy energy) {
  return rounds(residual, energy, [](int) { return 0.0; });
}

double falling(int round) {
  return std::pow(0.9, round);
}

TEST(Standstill, IsToldWhereForcesStayFarFromRest) {
  EXPECT_EQ(rounds([](int i) { return i % 2 ? 1500.0 : 1200.0; }, [](int i) { return i % 3 ? 123.2 : 123.1; }),
            Standstill::kRounds + 1);
}

TEST(Standstill, IsNotToldOfClothNearRest) {
  EXPECT_EQ(rounds([](int) { return 5.0; }, [](int) { return 1.3; }), 100);
}

TEST(Standstill, IsNotToldWhileForcesFall) {
  EXPECT_EQ(rounds([](int i) { return 1e9 * std::pow(0.9, i); }, [](int) { return -1.0; }), 100);
}

TEST(Standstill, IsNotToldWhileEnergyFalls) {
  EXPECT_EQ(rounds([](int) { return 1e4; }, [](int i) { return -1.0 - 0.01 * i * i; }), 100);
}

TEST(Standstill, CountsFromTheLastGain) {
  EXPECT_EQ(rounds([](int i) { return i < 8 ? 1000.0 : 240.0; }, [](int) { return 1.0; }), 8 + Standstill::kRounds + 1);
}

TEST(Standstill, IsToldOfTangledClothWhoseEnergyFalls) {
  const auto force = [](int) { return 1e4; };
  EXPECT_EQ(rounds(force, falling, [](int i) { return i % 2 ? 0.3 : 0.2; }), Standstill::kRounds + 1);
  EXPECT_EQ(rounds(force, falling, [](int i) { return i < 8 ? 0.0 : 0.3; }), 8 + Standstill::kRounds + 1);
}

TEST(Standstill, IsNotToldOfClothThatComesFreeNorWhereFewTrianglesArePierced) {
  const auto force = [](int) { return 1e4; };
  EXPECT_EQ(rounds(force, falling, [](int i) { return 100 * falling(i); }), 100);
  EXPECT_EQ(rounds(force, falling, [](int) { return 0.09; }), 100);
}

TEST(Standstill, IsNotToldOfTangledClothNearRest) {
  EXPECT_EQ(rounds([](int) { return 5.0; }, falling, [](int) { return 1.0; }), 100);
}

TEST(Standstill, TellsTangledClothFromClothThatStandsStill) {
  Standstill tangled, still;
  for (int i = 0; i <= Standstill::kRounds; ++i) {
    EXPECT_FALSE(tangled.tangled());
    tangled.after_round(1e4, falling(i), 0.2);
    still.after_round(1e4, 1.0, 0.0);
  }
  EXPECT_TRUE(tangled.tangled());
  EXPECT_FALSE(still.tangled());
}

}  // namespace
}  // namespace toile

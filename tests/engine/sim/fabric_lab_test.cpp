// SPDX-License-Identifier: GPL-3.0-or-later
// The fabrics of the library on the instruments of a textile laboratory: cases 18 and 19 of design/method.md.
#include "tests/support/fabric_lab.h"

#include <numbers>

#include <gtest/gtest.h>

namespace toile::test {
namespace {

TEST(FabricLab, ElasticaFallsBy41DegreesAtTwiceItsBendingLength) {
  EXPECT_NEAR(elastica_overhang_factor(), 2.0, 0.02);
}

TEST(FabricLab, CantileverOverhangIsThatOfTheElastica) {
  for (const char* name : {"wool", "denim"}) {
    const Cantilever strip = cantilever(*fabric_named(name), 12);
    EXPECT_LT(strip.specimen.residual, 0.05);
    EXPECT_NEAR(strip.overhang / strip.exact_overhang, 1, 0.02) << name;
  }
}

TEST(FabricLab, StripsAlongTheYarnsExtendByLoadOverStiffness) {
  Fabric fabric = *fabric_named("shirting");
  fabric.warp_stiffness = 2000;
  const double load = 40, half_pi = std::numbers::pi / 2;
  const double warp = tensile_strip(fabric, 0, load).extension, weft = tensile_strip(fabric, half_pi, load).extension,
               bias = tensile_strip(fabric, half_pi / 2, load).extension;
  // Shear resists a stretched fibre a little; the jaws keep the strip from narrowing.
  EXPECT_NEAR(warp, load / (2000 + 60), 0.1 * warp);
  EXPECT_NEAR(weft, load / (1500 + 60), 0.1 * weft);
  EXPECT_GT(bias, 4 * weft);
}

TEST(SlowFabricLab, DrapeCoefficientsLieInThePublishedBands) {
  struct Band {
    const char* fabric;
    double low, high;
  };
  for (const Band& band :
       {Band{"silk", 0.20, 0.40}, Band{"wool", 0.40, 0.70}, Band{"shirting", 0.60, 0.76}, Band{"denim", 0.70, 0.90}}) {
    const DrapeMeter meter = drape_meter(*fabric_named(band.fabric), 7, 2);
    EXPECT_GT(meter.coefficient, band.low) << band.fabric;
    EXPECT_LT(meter.coefficient, band.high) << band.fabric;
    for (const DrapeDrop& drop : meter.drops) EXPECT_GE(drop.folds, 4) << band.fabric;
  }
}

// One drop falls into 7 to 9 folds, with coefficients points apart; the mean of six is what a mesh must not change.
TEST(SlowFabricLab, MeanDrapeCoefficientDoesNotDependOnTheMesh) {
  const Fabric cotton = *fabric_named("cotton");
  const DrapeMeter coarse = drape_meter(cotton, 6), finer = drape_meter(cotton, 9);
  ASSERT_EQ(coarse.drops.size(), 6U);
  EXPECT_GT(finer.drops[0].specimen.mesh.triangle_count(), 2 * coarse.drops[0].specimen.mesh.triangle_count());
  EXPECT_GT(coarse.spread, 0.0005);  // the drops do differ
  EXPECT_NEAR(coarse.coefficient, finer.coefficient, 0.02);
}

}  // namespace
}  // namespace toile::test

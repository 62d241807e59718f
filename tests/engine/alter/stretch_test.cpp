// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/stretch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/alter/lay_sheet.h"
#include "engine/alter/propagate_tear.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

// A square whose wanted outline is wider at the top than cloth can be without stress.
Vec2 widened(const Vec2& p) {
  return {p.x() * (1.0 + 0.5 * p.y()), p.y()};
}

Sheet square(int cells) {
  const test::GridGarment garment = test::grid_garment({{"square", 0.4, 0.4, cells, cells, 0.0}});
  const Points2 wanted = garment.mapped([](int, const Vec2& p) { return widened(p); });
  return make_sheet(garment.pattern, garment.mesh, garment.mesh.rest, wanted, 0);
}

void let_go(Sheet& sheet, int side) {
  for (SheetVertex& vertex : sheet.vertices)
    if (SheetAnchor* anchor = vertex.anchor(side)) anchor->attached = false;
}

double largest_move(const Sheet& a, const Sheet& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    largest = std::max(largest, (a.vertices[v].now - b.vertices[v].now).norm());
  return largest;
}

TEST(Stretch, SharedEquationsRelaxACopyAsItsOwnWould) {
  const RelaxOptions options;
  Sheet sheet = square(10);
  relax(sheet, options);
  SheetEquations shared(sheet, options.hold);
  Sheet copy = sheet, own = sheet;
  for (Sheet* released : {&copy, &own}) let_go(*released, 1);
  relax(copy, options, nullptr, &shared);
  relax(own, options);
  EXPECT_GT(largest_move(copy, sheet), 1e-3);
  EXPECT_EQ(largest_move(copy, own), 0.0);
}

TEST(Stretch, ClothThatIsLetGoLosesItsStress) {
  Sheet sheet = square(10);
  relax(sheet);
  const SheetStress held = measure_stress(sheet);
  ASSERT_GT(held.p95, 0.03);
  for (int side = 0; side < static_cast<int>(sheet.sides.size()); ++side) let_go(sheet, side);
  relax(sheet, {.max_renewals = 60, .energy_drop = 1e-8});
  EXPECT_LT(measure_stress(sheet).p95, 0.1 * held.p95);
}

// A waistband, stretched onto one that is 3 % longer and less bent, and let go at both ends.
class ABandLetGoAtBothEnds : public ::testing::Test {
 protected:
  struct Gaps {
    double left = 0.0, right = 0.0;  // m, mean along each end
    double together() const { return left + right; }
    double apart() const { return std::abs(left - right); }
  };

  Gaps gaps(std::optional<Vec2> across) {
    sheet_.across = across;
    relax(sheet_);
    EXPECT_GT(measure_stress(sheet_).p95, 0.02);
    for (const int side : {1, 3}) let_go(sheet_, side);
    relax(sheet_, {.max_renewals = 200, .energy_drop = 1e-9});
    return {gap_at(3), gap_at(1)};
  }

  static constexpr double kWidth = 0.43, kShorter = 0.97;  // m; relative
  const test::GridGarment garment_ = test::grid_garment({{"band", kWidth, 0.045, 32, 3, 0.0}});

 private:
  static auto bent(double bend, double growing) {
    return [=](int, const Vec2& p) {
      const double x = p.x() - kWidth / 2;
      return Vec2(p.x(), p.y() + bend * x * x * (1.0 + growing * x));
    };
  }

  Sheet band() const {
    Points2 cloth = garment_.mapped(bent(0.45, 1.0));
    cloth.col(0) *= kShorter;
    return make_sheet(garment_.pattern, garment_.mesh, cloth, garment_.mapped(bent(0.25, 0.0)), 0);
  }

  double gap_at(int side) const {
    double sum = 0.0;
    int count = 0;
    for (int v = 0; v < sheet_.vertex_count(); ++v)
      if (sheet_.vertices[static_cast<std::size_t>(v)].anchor(side)) sum += gap_to_side(sheet_, v, side), ++count;
    return sum / count;
  }

  Sheet sheet_ = band();
};

TEST_F(ABandLetGoAtBothEnds, StaysNearTheMiddle) {
  const Gaps found = gaps(std::nullopt);
  EXPECT_NEAR(found.together(), (1.0 - kShorter) * kWidth, 3e-3);
  EXPECT_LT(found.apart(), 0.3 * found.together());
}

TEST_F(ABandLetGoAtBothEnds, StaysInTheMiddleIfItIsItsOwnMirrorImage) {
  const Gaps found = gaps(Vec2::UnitX());
  EXPECT_NEAR(found.together(), (1.0 - kShorter) * kWidth, 3e-3);
  EXPECT_LT(found.apart(), 0.05 * found.together());
}

TEST(LaySheet, AFineSheetBeginsNearWhereItEnds) {
  Sheet coarse = square(6), fine = square(18);
  for (Sheet* sheet : {&coarse, &fine}) let_go(*sheet, 1);
  relax(coarse);
  Sheet relaxed = fine;
  const RelaxOptions to_the_end = {.max_renewals = 200, .energy_drop = 1e-9};
  relax(relaxed, to_the_end);
  const double from_plain = largest_move(fine, relaxed);
  ASSERT_GT(from_plain, 5e-3);
  lay_like(fine, coarse);
  EXPECT_LT(largest_move(fine, relaxed), 0.2 * from_plain);
}

}  // namespace
}  // namespace toile

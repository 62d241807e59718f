// SPDX-License-Identifier: GPL-3.0-or-later
// The accuracy ledger: what every comparison of a test reached beside what it tolerates. Where the environment names a
// file as TOILE_LEDGER, a line is added to it for each EXPECT_NEAR and ASSERT_NEAR of every test program (the linker
// leads them here) and, in sources that include this header, for each EXPECT_LT and EXPECT_LE of fractions:
//   suite.test <tab> what was compared <tab> with what <tab> value <tab> expected <tab> tolerance
// `toile-bench ledger` runs the programs and prints the ledger.
#pragma once

#include <type_traits>

#include <gtest/gtest.h>

namespace toile::test {

void write_ledger(const char* what, const char* with, double value, double expected, double tolerance);

// A bound from above is a tolerance around zero.
template <class A, class B>
testing::AssertionResult less_on_ledger(const char* what, const char* bound, const A& a, const B& b) {
  if constexpr (std::is_floating_point_v<A> && std::is_arithmetic_v<B>)
    write_ledger(what, bound, static_cast<double>(a), 0.0, static_cast<double>(b));
  return testing::internal::CmpHelperLT(what, bound, a, b);
}
template <class A, class B>
testing::AssertionResult at_most_on_ledger(const char* what, const char* bound, const A& a, const B& b) {
  if constexpr (std::is_floating_point_v<A> && std::is_arithmetic_v<B>)
    write_ledger(what, bound, static_cast<double>(a), 0.0, static_cast<double>(b));
  return testing::internal::CmpHelperLE(what, bound, a, b);
}

}  // namespace toile::test

#undef EXPECT_LT
#undef EXPECT_LE
#define EXPECT_LT(value, bound) EXPECT_PRED_FORMAT2(::toile::test::less_on_ledger, value, bound)
#define EXPECT_LE(value, bound) EXPECT_PRED_FORMAT2(::toile::test::at_most_on_ledger, value, bound)

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ledger/ledger.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace toile::test {

void write_ledger(const char* what, const char* with, double value, double expected, double tolerance) {
  const char* file = std::getenv("TOILE_LEDGER");
  if (!file) return;
  const auto* running = testing::UnitTest::GetInstance()->current_test_info();
  std::string line = running ? std::string(running->test_suite_name()) + "." + running->name() : "?";
  for (const char* text : {what, with}) {
    line += "\t";
    for (; *text; ++text) line += *text == '\t' || *text == '\n' ? ' ' : *text;
  }
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, "\t%.17g\t%.17g\t%.17g\n", value, expected, tolerance);
  line += numbers;
  if (std::FILE* out = std::fopen(file, "a")) {
    std::fwrite(line.data(), 1, line.size(), out);
    std::fclose(out);
  }
}

}  // namespace toile::test

// What EXPECT_NEAR calls, by the names the linker's --wrap gives it.
extern "C" {
testing::AssertionResult __real__ZN7testing8internal20DoubleNearPredFormatEPKcS2_S2_ddd(const char* value_text,
                                                                                        const char* expected_text,
                                                                                        const char* tolerance_text,
                                                                                        double value, double expected,
                                                                                        double tolerance);

testing::AssertionResult __wrap__ZN7testing8internal20DoubleNearPredFormatEPKcS2_S2_ddd(const char* value_text,
                                                                                        const char* expected_text,
                                                                                        const char* tolerance_text,
                                                                                        double value, double expected,
                                                                                        double tolerance) {
  toile::test::write_ledger(value_text, expected_text, value, expected, tolerance);
  return __real__ZN7testing8internal20DoubleNearPredFormatEPKcS2_S2_ddd(value_text, expected_text, tolerance_text,
                                                                        value, expected, tolerance);
}
}

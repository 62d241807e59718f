// SPDX-License-Identifier: GPL-3.0-or-later
// The program under test, run as a process.
#pragma once

#include <string>
#include <vector>

#include "tests/support/run_process.h"

namespace toile::test {

inline const std::string kToile = TOILE_BINARY_DIR "/bin/toile";

inline ProcessResult toile_says(std::vector<std::string> words) {
  words.insert(words.begin(), kToile);
  return run_process(words);
}

}  // namespace toile::test

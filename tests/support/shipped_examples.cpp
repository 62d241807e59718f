// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shipped_examples.h"

namespace toile::test {

std::string shipped_example_folder() {
  return std::string(TOILE_SOURCE_DIR) + "/schemas/examples/";
}

}  // namespace toile::test

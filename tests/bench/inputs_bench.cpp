// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "tests/bench/inputs.h"
#include "tests/support/shared_data.h"

namespace toile::bench {

int bench_inputs(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "inputs: ../shared/data is not beside this checkout\n");
    return 2;
  }
  bench_bodies(arguments);
  bench_meshing(arguments);
  return 0;
}

}  // namespace toile::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// The benchmarks that prove the whole: what it costs, how exact it is, and that nothing breaks it.
#pragma once

#include "tests/bench/bench.h"

namespace toile::bench {

int bench_stress(const Arguments& arguments);

}  // namespace toile::bench

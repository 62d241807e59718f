// SPDX-License-Identifier: GPL-3.0-or-later
// The benchmarks that prove the whole: what it costs, how exact it is, and that nothing breaks it.
#pragma once

#include "tests/bench/bench.h"

namespace toile::bench {

int bench_batch(const Arguments& arguments);
int bench_growth(const Arguments& arguments);
int bench_ledger(const Arguments& arguments);
int bench_pareto(const Arguments& arguments);
int bench_skip(const Arguments& arguments);
int bench_stress(const Arguments& arguments);
int bench_threads(const Arguments& arguments);

}  // namespace toile::bench

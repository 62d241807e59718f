// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `toile-bench inputs`.
#pragma once

#include "tests/bench/bench.h"

namespace toile::bench {

void bench_bodies(const Arguments& arguments);   // shared scans, read, repaired and normalised
void bench_meshing(const Arguments& arguments);  // panels of shared garments to triangles

}  // namespace toile::bench

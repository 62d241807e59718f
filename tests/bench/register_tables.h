// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of toile-bench register beside its own: each runs when its word is given.
#pragma once

#include "tests/bench/bench.h"

namespace toile::bench {

// "pairs [TARGET]": every pair of ../shared/data whose truth is known.
int bench_register_pairs(const Arguments& arguments);
// "variants [BODY]": imitated scans of re-posed bodies, three of each.
int bench_register_variants(const Arguments& arguments);
// "measures [TARGET | BODY:SEED...]": what is measured on scans, beside the bodies they were made of.
int bench_register_measures(const Arguments& arguments);
// "skin [SCAN...]": garments on scans' own skin and on the registered reference, beside the bodies they were made of.
int bench_register_skin(const Arguments& arguments);

}  // namespace toile::bench

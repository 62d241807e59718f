// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of toile-bench register beside its own: each runs when its word is given.
#pragma once

#include "tests/bench/bench.h"
#include "tests/support/registration/registration_score.h"

namespace toile::bench {

// "scan_a", a body of shared/data with its vertices shuffled, or BODY:SEED, an imitated scan of it in another pose.
test::RegistrationCase find_case(const std::string& name);

// "pairs [TARGET]": every pair of ../shared/data whose truth is known.
int bench_register_pairs(const Arguments& arguments);
// "variants [BODY]": imitated scans of re-posed bodies, three of each.
int bench_register_variants(const Arguments& arguments);
// "measures [TARGET | BODY:SEED...]": what is measured on scans, beside the bodies they were made of.
int bench_register_measures(const Arguments& arguments);
// "where [TARGET | BODY:SEED...]": by parts of the body, which way a map slides off the truth.
int bench_register_where(const Arguments& arguments);
// "skin [SCAN...]": garments on scans' own skin and on the registered reference, beside the bodies they were made of.
int bench_register_skin(const Arguments& arguments);

}  // namespace toile::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// People as a tailor might meet them: tape measurements that go together, from a seed.
#pragma once

#include "engine/bodies/make_mannequin.h"

namespace toile::test {

struct RandomPerson {
  Figure figure = Figure::Person;
  Measurements asked;  // some of a person's measurements; the height always
};

// The same number gives the same person on every machine. Women 1.45 to 1.90 m, men 1.58 to 2.05 m, children 0.90 to
// 1.65 m; from two and a half sizes under the average to seven above, single girths off by up to two sizes besides.
RandomPerson random_person(int number);

}  // namespace toile::test

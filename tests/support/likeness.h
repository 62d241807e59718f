// SPDX-License-Identifier: GPL-3.0-or-later
// How like a mannequin is to the person whose tape it was made from: the fifteen bodies of ../shared/data.
#pragma once

#include "engine/bodies/make_mannequin.h"

namespace toile::test {

struct SharedPerson {
  const char* name;
  Figure figure;
};
inline constexpr std::array<SharedPerson, 15> kSharedPeople = {{{"ggg_large_male", Figure::Man},
                                                                {"ggg_male_extra", Figure::Man},
                                                                {"ggg_mean_all", Figure::Person},
                                                                {"ggg_mean_female", Figure::Woman},
                                                                {"ggg_mean_male", Figure::Man},
                                                                {"ggg_small_female", Figure::Woman},
                                                                {"mh_child_8y", Figure::Child},
                                                                {"mh_female_athletic", Figure::Woman},
                                                                {"mh_female_average", Figure::Woman},
                                                                {"mh_female_heavy_short", Figure::Woman},
                                                                {"mh_female_heavy_tall", Figure::Woman},
                                                                {"mh_female_thin_short", Figure::Woman},
                                                                {"mh_female_thin_tall", Figure::Woman},
                                                                {"mh_male_average", Figure::Man},
                                                                {"mh_male_old_heavy", Figure::Man}}};

struct Likeness {
  Body person, mannequin;
  double mean = 0.0;  // m, from the person's trunk and legs to the mannequin after the best rigid motion
};

// The mannequin is made of height, chest, waist, belly, hip, thigh and inside leg alone, as measure_body takes them.
// Call only after TOILE_REQUIRE_SHARED_DATA().
Likeness mannequin_of(const SharedPerson& person);

}  // namespace toile::test

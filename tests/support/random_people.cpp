// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_people.h"

#include <array>
#include <cstdint>

#include "engine/bodies/mannequin_proportions.h"
#include "tests/support/dice.h"

namespace toile::test {
namespace {

struct Spread {
  const char* name;
  double share;    // of the measurement itself, either way
  double present;  // how often it is asked for
};
constexpr std::array<Spread, 9> kSpreads = {{{"waist_girth", 0.09, 0.9},
                                             {"hip_girth", 0.05, 0.9},
                                             {"thigh_girth", 0.05, 0.5},
                                             {"knee_girth", 0.04, 0.3},
                                             {"calf_girth", 0.05, 0.3},
                                             {"neck_girth", 0.05, 0.3},
                                             {"upper_arm_girth", 0.06, 0.3},
                                             {"wrist_girth", 0.05, 0.3},
                                             {"inside_leg_length", 0.03, 0.6}}};

}  // namespace

RandomPerson random_person(int number) {
  Dice dice(static_cast<std::uint64_t>(number) * 7919 + 17);
  RandomPerson person;
  const double which = dice.between(0.0, 5.0);
  person.figure = which < 2.0 ? Figure::Woman : which < 4.0 ? Figure::Man : Figure::Child;
  const bool child = person.figure == Figure::Child, woman = person.figure == Figure::Woman;
  const double height = child ? dice.between(0.90, 1.65) : woman ? dice.between(1.45, 1.90) : dice.between(1.58, 2.05);
  const char* bust = woman ? "bust_girth" : "chest_girth";
  const double usual = complete_measurements({{"height", height}}, person.figure).at(bust);
  const double skewed = dice.between(0.0, 1.0);  // more slim people than very stout ones
  const double size = -2.5 + (child ? 4.5 : 9.5) * skewed * skewed;
  person.asked = {{"height", height}, {bust, usual + 0.04 * size * height / 1.7}};
  const Measurements complete = complete_measurements(person.asked, person.figure);
  for (const Spread& spread : kSpreads) {
    const double value = complete.at(spread.name) * (1.0 + dice.between(-spread.share, spread.share));
    if (dice.between(0.0, 1.0) < spread.present) person.asked[spread.name] = value;
  }
  // A tape finds the waist where the trunk is least: no more than hip and chest.
  if (const auto waist = person.asked.find("waist_girth"); waist != person.asked.end())
    for (const char* name : {"hip_girth", "chest_girth"})
      if (person.asked.contains(name)) waist->second = std::min(waist->second, 0.99 * person.asked.at(name));
  return person;
}

}  // namespace toile::test

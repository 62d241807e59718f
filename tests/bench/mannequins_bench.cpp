// SPDX-License-Identifier: GPL-3.0-or-later
// mannequins [people N]: seeded people of the human range, how far each is from the tape asked for and who is refused.
// mannequins likeness FOLDER: the shared bodies, each beside the mannequin made of its tape, as pictures and a table.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/bodies/measure_body.h"
#include "engine/core/error.h"
#include "engine/geometry/half_edges.h"
#include "engine/render/png.h"
#include "engine/render/scene.h"
#include "engine/stages/render_views.h"
#include "tests/bench/bench.h"
#include "tests/support/crossing_triangles.h"
#include "tests/support/likeness.h"
#include "tests/support/random_people.h"

namespace toile::bench {
namespace {

struct Checked {
  std::string worst_name, refused;
  double worst = 0.0;  // m
  std::size_t crossings = 0;
  bool closed = true;
};

Checked check(const test::RandomPerson& person) {
  Checked checked;
  try {
    const Body body = make_mannequin(person.asked, {.figure = person.figure}).body;
    checked.closed = find_defects(body.surface.vertex_count(), body.surface.triangles).none();
    checked.crossings = test::crossing_triangles(body.surface).size();
    const Landmarks bust = {{"bust_l", body.landmarks.at("bust_l")}, {"bust_r", body.landmarks.at("bust_r")}};
    const Measurements taken = measure_body(body.surface, *body.skeleton, bust).measurements;
    for (const auto& [name, value] : person.asked)
      if (const double miss = std::abs(taken.at(name) - value); miss > checked.worst)
        checked.worst = miss, checked.worst_name = name;
  } catch (const Error& error) {
    checked.refused = error.subject + ": " + error.message;
  }
  return checked;
}

int people(int count, const Arguments& arguments) {
  constexpr double kTape = 5e-3;  // m
  Table table({"person", "figure", "height", "worst mm", "of", "crossings", "closed"});
  double sum = 0.0, most = 0.0;
  int made = 0, good = 0;
  for (int number = 0; number < count; ++number) {
    const test::RandomPerson person = test::random_person(number);
    const Checked checked = check(person);
    const bool ok = checked.refused.empty() && checked.worst < kTape && checked.crossings == 0 && checked.closed;
    good += ok;
    if (checked.refused.empty()) sum += checked.worst, most = std::max(most, checked.worst), ++made;
    if (ok) continue;
    table.add({std::to_string(number), std::to_string(static_cast<int>(person.figure)),
               fixed(person.asked.at("height"), 3), fixed(1e3 * checked.worst, 1),
               checked.refused.empty() ? checked.worst_name : checked.refused, std::to_string(checked.crossings),
               checked.closed ? "yes" : "NO"});
  }
  table.print(arguments.csv);
  std::printf(
      "%d of %d within 5 mm, closed, nowhere crossing; worst measurement of those made: mean %.2f mm, most %.2f mm\n",
      good, count, 1e3 * sum / made, 1e3 * most);
  return good == count ? 0 : 1;
}

// Both from four sides to one scale, the person above.
void write_picture(const test::Likeness& likeness, const std::string& path) {
  ViewOptions views;
  views.view_height = 420;
  Box frame;
  frame.add(likeness.person.surface.vertices);
  frame.add(likeness.mannequin.surface.vertices);
  views.frame = frame;
  for (int k = 0; k < 2; ++k) {
    views.title = k == 0 ? "person" : "mannequin of the same tape, " + fixed(1e3 * likeness.mean, 1) + " mm";
    const Bytes png =
        render_views(k == 0 ? &likeness.person.surface : &likeness.mannequin.surface, nullptr, nullptr, nullptr, views);
    std::ofstream(path + (k == 0 ? "_person.png" : "_mannequin.png"), std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  }
}

int likeness(const std::string& folder, const Arguments& arguments) {
  std::filesystem::create_directories(folder);
  Table table({"person", "mean mm"});
  double sum = 0.0;
  for (const test::SharedPerson& person : test::kSharedPeople) {
    const test::Likeness found = test::mannequin_of(person);
    sum += found.mean;
    table.add({person.name, fixed(1e3 * found.mean, 1)});
    write_picture(found, folder + "/" + person.name);
  }
  table.add({"mean", fixed(1e3 * sum / test::kSharedPeople.size(), 1)});
  table.print(arguments.csv);
  return 0;
}

}  // namespace

int bench_mannequins(const Arguments& arguments) {
  const auto& words = arguments.words;
  if (words.size() == 2 && words[0] == "likeness") return likeness(words[1], arguments);
  if (words.empty()) return people(500, arguments);
  if (words.size() == 2 && words[0] == "people" && std::atoi(words[1].c_str()) > 0)
    return people(std::atoi(words[1].c_str()), arguments);
  std::fprintf(stderr, "usage: toile-bench mannequins [people N] | likeness FOLDER\n");
  return 2;
}

}  // namespace toile::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// Imitated scans of re-posed bodies, drawn at run time: three for every body of ../shared/data.
#include <cstdio>

#include "engine/bodies/register_bodies.h"
#include "engine/core/error.h"
#include "tests/bench/register_tables.h"
#include "tests/support/registration/posed_body.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

bool is_man(const std::string& name) {
  return name.starts_with("mh_male");
}

// Median, p95, surface mean, surface p95, landmark median, in mm: the gates of the shared scans, 1.3 times.
std::array<double, 5> gates(const std::string& name) {
  if (name.starts_with("ggg_")) return {13, 26, 1.3, 3.25, 15.6};
  if (is_man(name)) return {20.8, 58.5, 1.3, 3.25, 33.8};
  return {15.6, 39, 1.3, 3.25, 15.6};
}

}  // namespace

int bench_register_variants(const Arguments& arguments) {
  Table table({"body", "seed", "cpu_s", "corr_median_mm", "corr_p95_mm", "surface_mean_mm", "surface_p95_mm",
               "landmark_median_mm", "within"});
  std::map<std::string, RegistrationReference> prepared;
  int inside = 0, all = 0;
  unsigned number = 0;
  for (const std::string& name : test::shared_body_names())
    for (int i = 0; i < 3; ++i) {
      const unsigned seed = ++number;
      const std::string wanted = arguments.words.size() > 1 ? arguments.words[1] : name;
      if (wanted != name) continue;
      const std::string from = name.starts_with("ggg_") ? "ggg_mean_all" : "mh_female_average";
      auto found = prepared.find(from);
      if (found == prepared.end())
        found = prepared.emplace(from, prepare_reference(test::load_shared_body(from))).first;
      ++all;
      try {
        const test::RegistrationCase known = test::variant_case(name, seed);
        RegisterBodiesResult result;
        const Timing time = time_cpu(1, [&] { result = register_bodies(found->second, known.target); });
        const auto s = score_registration(result.map.mapped, found->second.weights, known, from, true);
        const std::array<double, 5> values = {s.median, s.p95, s.surface_mean, s.surface_p95, s.landmark_median};
        bool within = true;
        std::vector<std::string> row = {name, std::to_string(seed), fixed(time.median, 2)};
        for (std::size_t k = 0; k < values.size(); ++k) {
          within &= values[k] * 1e3 < gates(name)[k];
          row.push_back(mm(values[k], k == 2 || k == 3 ? 2 : 1));
        }
        inside += within;
        row.emplace_back(within ? "yes" : "NO");
        table.add(std::move(row));
      } catch (const Error& error) {
        table.add({name, std::to_string(seed), error.message});
      }
    }
  table.print(arguments.csv);
  std::printf("%d of %d within 1.3 times the gates\n", inside, all);
  return 0;
}

}  // namespace toile::bench

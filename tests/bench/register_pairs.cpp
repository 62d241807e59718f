// SPDX-License-Identifier: GPL-3.0-or-later
// Every pair of ../shared/data whose truth is known: errors of the map, and of what is measured on the mapped body.
#include <cstdio>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/measure_body.h"
#include "engine/bodies/register_bodies.h"
#include "tests/bench/bench.h"
#include "tests/bench/register_tables.h"
#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

constexpr const char* kMeasured[] = {"waist_girth", "hip_girth", "bust_girth", "thigh_girth", "inside_leg_length"};

struct Pair {
  std::string reference, target;
};

std::vector<Pair> all_pairs() {
  std::vector<Pair> pairs = {
      {test::kWoman, "scan_a"}, {test::kWoman, "scan_c"}, {test::kWoman, "scan_d"}, {test::kMean, "scan_b"}};
  for (const char* name :
       {"mh_female_thin_short", "mh_female_thin_tall", "mh_female_heavy_short", "mh_female_heavy_tall",
        "mh_female_athletic", "mh_child_8y", "mh_male_average", "mh_male_old_heavy"})
    pairs.push_back({test::kWoman, name});
  for (const char* name : {"ggg_mean_female", "ggg_mean_male", "ggg_male_extra", "ggg_small_female", "ggg_large_male"})
    pairs.push_back({test::kMean, name});
  for (const char* name : {test::kWoman, "mh_male_average", "mh_child_8y"}) {
    pairs.push_back({test::kMean, name});
    pairs.push_back({name, test::kMean});
  }
  return pairs;
}

Measurements measure(const TriangleMesh& body) {
  return measure_body(body, find_skeleton(body).skeleton).measurements;
}

}  // namespace

int bench_register_pairs(const Arguments& arguments) {
  Table table({"reference", "target", "cpu_s", "corr_median_mm", "corr_p95_mm", "surface_mean_mm", "surface_p95_mm",
               "landmark_median_mm", "waist_mm", "hip_mm", "bust_mm", "thigh_mm", "crotch_mm", "floor_mm"});
  std::map<std::string, RegistrationReference> prepared;
  for (const Pair& pair : all_pairs()) {
    if (!arguments.words.empty() && arguments.words.back() != "pairs" && arguments.words.back() != pair.target)
      continue;
    auto found = prepared.find(pair.reference);
    if (found == prepared.end())
      found = prepared.emplace(pair.reference, prepare_reference(test::load_shared_body(pair.reference))).first;
    const RegistrationReference& reference = found->second;
    const test::RegistrationCase known =
        pair.target.starts_with("scan_") ? test::scan_case(pair.target) : test::shuffled_case(pair.target);
    RegisterBodiesResult result;
    const Timing time = time_cpu(1, [&] { result = register_bodies(reference, known.target); });
    const bool one_family =
        known.truth.vertex_count() == reference.surface.vertex_count();  // the families differ in their counts
    const auto score = score_registration(result.map.mapped, reference.weights, known, pair.reference, one_family);
    std::vector<std::string> row = {pair.reference, pair.target, fixed(time.median, 2)};
    row.push_back(one_family ? mm(score.median) : "");
    row.push_back(one_family ? mm(score.p95) : "");
    for (const double value : {score.surface_mean, score.surface_p95}) row.push_back(mm(value, 2));
    row.push_back(mm(score.landmark_median));
    const Measurements found_on = measure({result.map.mapped, reference.surface.triangles}),
                       truth = measure(known.truth);
    for (const char* name : kMeasured) row.push_back(mm(found_on.at(name) - truth.at(name)));
    row.push_back(mm(result.report.floor - known.truth.vertices.col(1).minCoeff()));
    table.add(std::move(row));
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// toile-bench register: time of a body map against its error, over the scans and over resolutions of one scan.
#include <cstdio>

#include "engine/bodies/register_bodies.h"
#include "engine/geometry/decimate.h"
#include "tests/bench/bench.h"
#include "tests/bench/register_tables.h"
#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct Run {
  double seconds;
  test::RegistrationScore score;
};

Run time_registration(const RegistrationReference& reference, const std::string& name,
                      const test::RegistrationCase& known, int repeats) {
  RegisterBodiesResult result;
  const Timing time = time_cpu(repeats, [&] { result = register_bodies(reference, known.target); });
  return {time.median, score_registration(result.map.mapped, reference.weights, known, name, true)};
}

void add_row(Table& table, const std::string& target, int triangles, const RegistrationReference& reference,
             const Run& run) {
  table.add({target, std::to_string(triangles), std::to_string(reference.surface.vertex_count()), fixed(run.seconds, 3),
             mm(run.score.median, 2), mm(run.score.p95, 2), mm(run.score.surface_mean, 2),
             mm(run.score.surface_p95, 2)});
}

// A coarser scan of the same person.
test::RegistrationCase coarser(const test::RegistrationCase& known, int triangles) {
  test::RegistrationCase out = known;
  out.target.surface = decimate(known.target.surface, triangles / 2);
  return out;
}

}  // namespace

int bench_register(const Arguments& arguments) {
  if (!test::has_shared_data()) return std::fprintf(stderr, "../shared/data is not beside this checkout\n"), 3;
  if (!arguments.words.empty() && arguments.words.front() == "pairs") return bench_register_pairs(arguments);
  if (!arguments.words.empty() && arguments.words.front() == "variants") return bench_register_variants(arguments);
  if (!arguments.words.empty() && arguments.words.front() == "measures") return bench_register_measures(arguments);
  if (!arguments.words.empty() && arguments.words.front() == "skin") return bench_register_skin(arguments);
  if (!arguments.words.empty() && arguments.words.front() == "where") return bench_register_where(arguments);
  const std::string woman = "mh_female_average", mean = "ggg_mean_all";
  const double start = cpu_seconds();
  const RegistrationReference small = prepare_reference(test::load_shared_body(woman));
  const double between = cpu_seconds();
  const RegistrationReference large = prepare_reference(test::load_shared_body(mean));
  std::printf("reference prepared once: %s %.3f s, %s %.3f s\n", woman.c_str(), between - start, mean.c_str(),
              cpu_seconds() - between);

  Table table({"target", "triangles", "reference_vertices", "cpu_s", "corr_median_mm", "corr_p95_mm", "surface_mean_mm",
               "surface_p95_mm"});
  for (const char* scan : {"scan_a", "scan_c", "scan_d", "scan_b"}) {
    const test::RegistrationCase known = test::scan_case(scan);
    const bool is_large = std::string(scan) == "scan_b";
    const RegistrationReference& reference = is_large ? large : small;
    add_row(table, scan, known.target.surface.triangle_count(), reference,
            time_registration(reference, is_large ? mean : woman, known, arguments.repeats));
  }
  std::vector<double> sizes, times;
  const test::RegistrationCase finest = test::scan_case("scan_d");
  for (const int triangles : {3200, 6400, 12800, 25600, 51200}) {
    const test::RegistrationCase known = coarser(finest, triangles);
    const Run run = time_registration(small, woman, known, arguments.repeats);
    add_row(table, "scan_d coarser", known.target.surface.triangle_count(), small, run);
    sizes.push_back(known.target.surface.triangle_count()), times.push_back(run.seconds);
  }
  table.print(arguments.csv);
  std::printf("growth with the target's triangles: n^%.2f\n", growth_exponent(sizes, times));
  return 0;
}

}  // namespace toile::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// `derive random`: bodies drawn from seeds, blends and scalings of the shared family; what fails, and how.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>

#include "engine/core/error.h"
#include "tests/bench/derive.h"
#include "tests/bench/random_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct Tally {
  std::map<std::string, int> failures;  // by code
  int done = 0, unclassified = 0, held_back = 0, not_at_rest = 0, worse = 0;
  std::vector<double> after;
};

void derive_one(const std::string& garment, const BodyInput& body, const DeriveRequest& request, StageCache* stages,
                Tally& tally) {
  try {
    StageRunner runner(stages, nullptr, kDeriveStages);
    const DerivedGarment r = derive_garment(shared_garment(garment), shared_wearer(test::body_of_garment(garment)),
                                            body, request.options, runner)
                                 .value;
    ++tally.done;
    const double before = compare_fits(r.reference.mesh, r.reference.fit, r.fit_before).whole.rms_stretch;
    tally.worse += r.derived.rms_stretch_error > before + 0.001;
    tally.after.push_back(r.derived.rms_stretch_error);
    tally.not_at_rest += r.derived.drape.quality.rest == Rest::NotAtRest;
    if (r.derived.held_back.empty()) return;
    ++tally.held_back;
    std::printf("  %s on %s: %zu panels held back at %.2f\n", garment.c_str(), body.name.c_str(),
                r.derived.held_back.size(), r.derived.kept_change);
  } catch (const Error& error) {
    ++tally.failures[std::string(error_name(error.code))];
    std::printf("  %s on %s: %s: %s\n", garment.c_str(), body.name.c_str(), error.subject.c_str(),
                error.message.c_str());
  } catch (const std::exception& error) {
    ++tally.unclassified;
    std::printf("  %s on %s: UNCLASSIFIED %s\n", garment.c_str(), body.name.c_str(), error.what());
  }
  std::fflush(stdout);
}

}  // namespace

int derive_random(const DeriveRequest& request, const Arguments&) {
  const std::vector<TriangleMesh> family = shared_family();
  Tally tally;
  for (const std::string& garment : request.garments) {
    const auto stages = stage_store(request.stages, kDrapeStages);  // the reference drape alone is worth keeping
    for (int number = 0; number < request.count; ++number)
      derive_one(garment, random_body(number, family), request, stages.get(), tally);
  }
  std::sort(tally.after.begin(), tally.after.end());
  int failed = 0;
  for (const auto& [code, count] : tally.failures) failed += count, std::printf("%s: %d\n", code.c_str(), count);
  const int all = tally.done + failed + tally.unclassified;
  std::printf(
      "%d derivations: %d failed in a classified way, %d unclassified, %d held back, %d not at rest, %d worse\n", all,
      failed, tally.unclassified, tally.held_back, tally.not_at_rest, tally.worse);
  if (!tally.after.empty())
    std::printf("stretch error: median %.2f %%, largest %.2f %%\n", 100 * tally.after[tally.after.size() / 2],
                100 * tally.after.back());
  const bool met = tally.unclassified == 0 && 50 * failed < all;
  std::printf("nothing unclassified, under 2 %% classified: %s\n", met ? "met" : "NOT met");
  return met ? 0 : 1;
}

}  // namespace toile::bench

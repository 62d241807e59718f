// SPDX-License-Identifier: GPL-3.0-or-later
// `derive random`: bodies drawn from seeds, blends and scalings of the shared family; what fails, and how.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <random>

#include "engine/core/error.h"
#include "engine/io/mesh_file.h"
#include "tests/bench/derive.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

const std::vector<std::string> kFamily = {"ggg_mean_all",     "ggg_mean_female", "ggg_mean_male",
                                          "ggg_small_female", "ggg_large_male",  "ggg_male_extra"};

// The same number gives the same body everywhere: uniform numbers are made from the engine's bits alone.
class Draw {
 public:
  explicit Draw(int number) : engine_(static_cast<std::uint64_t>(number) + 1) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

// Two bodies of the family mixed, and scaled: 1.45 to 2 m tall, by a tenth wider or narrower than tall.
BodyInput random_body(int number, const std::vector<TriangleMesh>& family) {
  Draw draw(number);
  const TriangleMesh &a = family[draw.index(family.size())], &b = family[draw.index(family.size())];
  const double mix = draw.between(0.0, 1.0), height = draw.between(1.45, 2.0);
  TriangleMesh mesh = a;
  mesh.vertices = (1.0 - mix) * a.vertices + mix * b.vertices;
  const double tall = height / (mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff());
  mesh.vertices.col(0) *= tall * draw.between(0.92, 1.1);
  mesh.vertices.col(1) *= tall;
  mesh.vertices.col(2) *= tall * draw.between(0.92, 1.1);
  BodyInput body;
  body.name = "random-" + std::to_string(number);
  body.bytes = write_obj(mesh);
  return body;
}

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
  std::vector<TriangleMesh> family;
  for (const std::string& name : kFamily) family.push_back(test::load_shared_body(name).surface);
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

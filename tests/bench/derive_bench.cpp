// SPDX-License-Identifier: GPL-3.0-or-later
// derive [trips|growth|random|sweeps] [GARMENT...] [--bodies a,b] [--triangles N] [--count N] [--pictures FOLDER]
//        [--stages FOLDER] [--asymmetric]: target patterns of garments of ../shared/data on bodies of it.
// Alone: fit and position after draping the target pattern beside those before, and the gates of both. `trips`: there
// and back again. `growth`: time without drapes against resolution. `random`: bodies drawn from seeds. `sweeps`:
// pictures of some sweeps.
#include <algorithm>
#include <cstdio>

#include "engine/core/error.h"
#include "engine/stages/outline_crossing.h"
#include "tests/bench/derive.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

// Gates of the pair table: what the median must reach, and how much worse a single pair may get.
constexpr double kLeastFall = 0.75, kGoodStretch = 0.007, kGoodPosition = 8e-3;
constexpr double kWorseStretch = 0.001, kWorsePosition = 1e-3, kSeamGate = 0.5e-3;

// Which drawn edge stands farthest from where the derivation put its vertices: "panel:edge".
std::string worst_edge(const DerivedGarment& r) {
  const FitPatternEdgesResult& drawn = r.derived.drawn;
  for (std::size_t p = 0; p < drawn.deviation.size(); ++p)
    for (std::size_t e = 0; e < drawn.deviation[p].size(); ++e)
      if (drawn.deviation[p][e] == drawn.largest_deviation)
        return r.reference.pattern.panels[p].name + ":" + std::to_string(e);
  return "";
}

struct PairOutcome {
  double stretch_before = 0, stretch_after = 0, position_before = 0, position_after = 0;
  double seam = 0, deviation = 0;
  int flips = 0, crossing_panels = 0;
};

PairOutcome pair_outcome(const DerivedGarment& r) {
  PairOutcome o;
  const PatternMesh& mesh = r.reference.mesh;
  o.stretch_before = compare_fits(mesh, r.reference.fit, r.fit_before).whole.rms_stretch;
  o.stretch_after = compare_fits(mesh, r.reference.fit, r.derived.fit).whole.rms_stretch;
  o.position_before = compare_positions(r.transported.drape.nodes, r.before->drape.nodes).rms;
  o.position_after = compare_positions(r.transported.drape.nodes, r.derived.drape.drape.nodes).rms;
  o.seam = r.derived.drawn.largest_seam_mismatch;
  o.deviation = r.derived.drawn.largest_deviation;
  o.flips = r.derived.derivation.flipped_triangles;
  for (const Panel& panel : r.derived.drawn.pattern.panels)
    o.crossing_panels += find_outline_crossing(panel).has_value();
  return o;
}

void draw(const DeriveRequest& request, const std::string& name, const DerivedGarment& r) {
  if (request.pictures.empty()) return;
  write_changes(request.pictures, name, r.reference.pattern, r.derived.drawn.pattern);
}

// "stretch error: median falls by 84 % to 0.6 %" and whether that is enough.
bool judge(const std::vector<PairOutcome>& all, const char* what, double PairOutcome::*before,
           double PairOutcome::*after, double good, double scale, const char* unit) {
  std::vector<double> falls, reached;
  for (const PairOutcome& o : all) {
    falls.push_back(o.*before > 0 ? 1.0 - o.*after / (o.*before) : 0.0);
    reached.push_back(o.*after);
  }
  const bool met = median(falls) >= kLeastFall || median(reached) <= good;
  std::printf("%s: in the median down by %.0f %%, to %.2f %s: %s\n", what, kPercent * median(falls),
              scale * median(reached), unit, met ? "met" : "NOT met");
  return met;
}

bool verdict(const char* what, int count) {
  std::printf("%s: %d: %s\n", what, count, count == 0 ? "met" : "NOT met");
  return count == 0;
}

int summarise(const std::vector<PairOutcome>& all, int failures) {
  const auto count = [&](auto&& bad) { return static_cast<int>(std::count_if(all.begin(), all.end(), bad)); };
  bool met = judge(all, "stretch error", &PairOutcome::stretch_before, &PairOutcome::stretch_after, kGoodStretch,
                   kPercent, "%");
  met &= judge(all, "position error", &PairOutcome::position_before, &PairOutcome::position_after, kGoodPosition, kMm,
               "mm");
  met &= verdict("pairs worse by more than 0.1 % stretch",
                 count([](const PairOutcome& o) { return o.stretch_after > o.stretch_before + kWorseStretch; }));
  met &= verdict("pairs worse by more than 1 mm",
                 count([](const PairOutcome& o) { return o.position_after > o.position_before + kWorsePosition; }));
  met &= verdict("pairs with a sewn side off by more than 0.5 mm",
                 count([](const PairOutcome& o) { return o.seam > kSeamGate; }));
  met &= verdict("pairs with flipped triangles", count([](const PairOutcome& o) { return o.flips > 0; }));
  met &= verdict("pairs with a panel that overlaps itself",
                 count([](const PairOutcome& o) { return o.crossing_panels > 0; }));
  met &= verdict("pairs that failed", failures);
  return met ? 0 : 1;
}

}  // namespace

namespace {

int derive_pairs(const DeriveRequest& request, const Arguments& arguments) {
  const auto stages = stage_store(request.stages);
  Table table({"garment", "body", "stretch before %", "after %", "position before mm", "after mm", "seam mm", "edge mm",
               "worst edge", "bent", "polylines", "flips", "overlaps", "passes %", "held back", "sweeps", "rest",
               "CPU s"});
  std::vector<PairOutcome> outcomes;
  int failures = 0;
  for (const std::string& garment : request.garments)
    for (const std::string& body : request.bodies) {
      std::printf("%s -> %s ...\n", garment.c_str(), body.c_str());
      std::fflush(stdout);
      const double start = cpu_seconds();
      try {
        const DerivedGarment r = derive_pair(garment, body, request.options, stages.get());
        const PairOutcome o = pair_outcome(r);
        outcomes.push_back(o);
        std::string passes;
        for (const double e : r.derived.pass_errors) passes.append(fixed(kPercent * e, 2)).append(" ");
        table.add({garment, body, fixed(kPercent * o.stretch_before, 2), fixed(kPercent * o.stretch_after, 2),
                   fixed(kMm * o.position_before, 1), fixed(kMm * o.position_after, 1), fixed(kMm * o.seam, 3),
                   fixed(kMm * o.deviation, 2), worst_edge(r), std::to_string(r.derived.drawn.bent_edges),
                   std::to_string(r.derived.drawn.polyline_edges), std::to_string(o.flips),
                   std::to_string(o.crossing_panels), passes,
                   r.derived.held_back.empty()
                       ? ""
                       : std::to_string(r.derived.held_back.size()) + " at " + fixed(r.derived.kept_change, 2),
                   std::to_string(r.derived.derivation.sweeps.size()),
                   std::string(rest_name(r.derived.drape.quality.rest)), fixed(cpu_seconds() - start, 2)});
        draw(request, garment + "_" + body, r);
      } catch (const Error& error) {
        ++failures;
        table.add({garment, body, error.message});
      }
    }
  table.print(arguments.csv);
  return summarise(outcomes, failures);
}

}  // namespace

int bench_derive(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench derive needs ../shared/data\n");
    return 2;
  }
  const DeriveRequest request = derive_request(arguments.words);
  if (request.what == "trips") return derive_trips(request, arguments);
  if (request.what == "growth") return derive_growth(request, arguments);
  if (request.what == "random") return derive_random(request, arguments);
  if (request.what == "sweeps") return derive_sweeps(request);
  return derive_pairs(request, arguments);
}

}  // namespace toile::bench

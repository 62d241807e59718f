// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "engine/archive_stages.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "engine/io/garmentcode_json.h"
#include "engine/outputs.h"
#include "engine/stages/import_pattern.h"
#include "tests/stress/independent.h"
#include "tests/stress/job_scene.h"
#include "tests/stress/part_scenes.h"

namespace toile::stress {
namespace {

using nlohmann::json;

// Two ways to the same figure, in double precision.
constexpr double kRounding = 1e-7;
constexpr double kStrained = 0.5, kSunkShare = 0.05;  // what a drape may not be without a finding that says so
// A scene moved sideways or sewn in another order comes to rest elsewhere by as much as its stop residual lets it.
constexpr double kSameArea = 0.02, kSameStretch = 0.01;

GarmentInput garment_input(const Pattern& pattern) {
  const std::string text = write_garmentcode(pattern);
  return {"garment.json", Bytes(text.begin(), text.end())};
}

struct Run {
  AlterResult result;
  std::vector<OutputFile> files;
};

Run run(const JobScene& scene, const Pattern& pattern, const BodyInput& reference, const BodyInput& target) {
  const GarmentInput garment = garment_input(pattern);
  StageRunner runner(nullptr, nullptr, kAlterStages);
  Run run;
  run.result = alter_garment(garment, reference, target, scene.options, runner);
  run.files = alter_outputs(run.result, scene.options, job_info(garment, reference, target));
  return run;
}

Keyed<DerivedGarment> derive(const JobScene& scene, const Pattern& pattern, const BodyInput& reference,
                             const BodyInput& target) {
  StageRunner runner(nullptr, nullptr, kDeriveStages);
  return derive_garment(garment_input(pattern), reference, target, scene.options, runner);
}

void expect_near(Outcome& outcome, const std::string& what, double told, double found, double tolerance) {
  if (!(std::abs(told - found) <= tolerance))
    outcome.fail(print_text("%s: told %.9g, found %.9g", what.c_str(), told, found));
}

void check_finite(const json& value, const std::string& place, Outcome& outcome) {
  if (value.is_null()) outcome.fail("result.json " + place + " is no number");
  if (value.is_structured())
    for (const auto& [key, child] : value.items()) check_finite(child, place + "/" + key, outcome);
}

// The quality block of one drape against independent measurement.
void check_quality(const json& told, const PatternMesh& mesh, const DrapeResult& drape, const Body& body,
                   const std::string& name, Outcome& outcome) {
  const Points3& nodes = drape.drape.nodes;
  if (!nodes.allFinite()) return outcome.fail(name + ": nodes are not finite");
  const Strains found = strains(mesh, mesh.rest, nodes);
  for (const auto& [direction, values] : {std::pair("weft_strain", &found.weft), std::pair("warp_strain", &found.warp)})
    for (const auto& [percentile, share] : {std::pair("p50", 0.5), std::pair("p99", 0.99)}) {
      const double limit = told.at(direction).at(percentile);
      if (share_within(*values, found.area, limit + kRounding * (1 + limit)) < share - kRounding ||
          share_within(*values, found.area, limit - kRounding * (1 + limit)) > share + kRounding)
        outcome.fail(print_text("%s: %s %s is not %.9g", name.c_str(), direction, percentile, limit));
    }
  const CrossingPairs crossing = crossing_pairs_by_volumes(mesh, nodes);
  const double pairs = told.at("crossing_pairs");
  expect_near(outcome, name + " crossing pairs", pairs, std::clamp<double>(pairs, crossing.sure, crossing.possible),
              0.02 * pairs);
  const bool whole = body.kind == BodyKind::Form;  // of people, arms the garment does not dress are left out
  const double deepest = deepest_node(nodes, body.surface, whole ? 1 : 8) * kMmPerMetre;
  if (whole)
    expect_near(outcome, name + " deepest node", told.at("deepest_node_mm"), deepest, 1e-4);
  else if (drape.diagnostics.bodice && deepest > told.at("deepest_node_mm").get<double>() + 1e-4)
    outcome.fail(print_text("%s: a node lies %.3f mm deep, told was less", name.c_str(), deepest));
}

// A drape that is of no use must say so.
void check_not_silent(const json& told, const DrapeResult& drape, const std::string& name, Outcome& outcome) {
  const auto says = [&](const char* finding) {
    return std::any_of(drape.diagnostics.findings.begin(), drape.diagnostics.findings.end(),
                       [&](const DrapeFinding& f) { return f.name == finding; });
  };
  const double sunk = told.at("nodes_deeper_than_1_mm").get<double>() / static_cast<double>(drape.drape.nodes.rows());
  if (sunk > kSunkShare && !says("inside_body")) outcome.fail(name + ": sunk into the body without a word");
  const double strained = std::max(told.at("weft_strain").at("p99"), told.at("warp_strain").at("p99"));
  if (strained > kStrained && !says("overstretched")) outcome.fail(name + ": overstretched without a word");
  if (told.at("rest") == "not_at_rest" && !says("not_at_rest")) outcome.fail(name + ": moves without a word");
}

void check_derivation(const json& stages, const DerivedGarment& derived, Outcome& outcome) {
  const json& told = stages.at("derive_pattern");
  const auto shown = [](const PatternMesh& mesh, const Drape& drape) {
    return recovered(mesh, mesh.rest, strains(mesh, mesh.rest, drape.nodes));
  };
  const Strains wanted = shown(derived.reference.mesh, derived.reference.drape.drape);
  Strains compared = shown(derived.derived.mesh, derived.derived.drape.drape);
  compared.area = wanted.area;
  const bool degenerate =
      std::count(derived.derived.fit.degenerate.begin(), derived.derived.fit.degenerate.end(), true) +
          std::count(derived.reference.fit.degenerate.begin(), derived.reference.fit.degenerate.end(), true) >
      0;
  if (!degenerate)
    expect_near(outcome, "rms stretch error", told.at("rms_stretch_error"), rms_difference(wanted, compared),
                kRounding * (1 + rms_difference(wanted, compared)));
  expect_near(outcome, "flipped triangles", told.at("flipped_triangles"),
              flipped_triangles(derived.derived.mesh.triangles, derived.derived.mesh.rest), 0);
  const json& sweeps = told.at("sweep_energies");
  for (std::size_t i = 1; i < sweeps.at("energy_m2").size(); ++i) {
    const double before = sweeps.at("energy_m2")[i - 1], after = sweeps.at("energy_m2")[i];
    if (sweeps.at("edge_weight")[i] == sweeps.at("edge_weight")[i - 1] && after > before * (1 + 1e-9) + 1e-15)
      outcome.fail(print_text("derivation: energy grows in sweep %zu from %.12g to %.12g", i, before, after));
  }
}

const OutputFile* file_named(const std::vector<OutputFile>& files, const std::string& name) {
  const auto found = std::find_if(files.begin(), files.end(), [&](const OutputFile& f) { return f.name == name; });
  return found == files.end() ? nullptr : &*found;
}

void check_files(const Run& run, Outcome& outcome) {
  for (const OutputFile& file : run.files) {
    const std::string text(file.bytes.begin(), file.bytes.end());
    for (const char* word : {"nan", "inf"})
      for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if (at > 0 && std::string_view(" ,:[-\"").find(text[at - 1]) != std::string_view::npos &&
            !std::isalpha(static_cast<unsigned char>(text[std::min(at + 3, text.size() - 1)])))
          return outcome.fail(file.name + " holds a number that is not finite");
  }
  for (const char* name : {"altered_pattern.json", "target_pattern.json"}) {
    const OutputFile* file = file_named(run.files, name);
    if (!file) continue;
    try {
      import_pattern(file->bytes);
    } catch (const Error& error) {
      outcome.fail(std::string(name) + " is not read back: " + error.what());
    }
  }
}

void check_result(const Run& run, double stretch_limit, Outcome& outcome) {
  const OutputFile* file = file_named(run.files, "result.json");
  const json told = json::parse(file->bytes);
  check_finite(told, "", outcome);
  const AlterResult& r = run.result;
  const json& quality = told.at("quality");
  struct Part {
    const char* name;
    const PatternMesh& mesh;
    const DrapeResult& drape;
    const Body& body;
  };
  std::vector<Part> parts = {{"reference_drape", r.reference.mesh, r.reference.drape, r.reference.body},
                             {"target_drape_before", r.reference.mesh, *r.before, r.target_body},
                             {"target_pattern_drape", r.derived.mesh, r.derived.drape, r.target_body}};
  if (r.after && r.after->problem.empty())
    parts.push_back({"target_drape_after", r.after->mesh, r.after->drape, r.target_body});
  for (const Part& part : parts) {
    check_quality(quality.at(part.name), part.mesh, part.drape, part.body, part.name, outcome);
    check_not_silent(quality.at(part.name), part.drape, part.name, outcome);
  }
  check_derivation(told.at("stages"), r, outcome);
  check_balance(r.altered, stretch_limit, outcome);
  check_files(run, outcome);
}

void check_determinism(const JobScene& scene, const Run& first, Outcome& outcome) {
  const Run second = run(scene, scene.pattern, scene.reference, scene.target);
  for (std::size_t i = 0; i < first.files.size(); ++i)
    if (first.files[i].bytes != second.files[i].bytes) outcome.fail(first.files[i].name + " differs when made again");
}

// New names change nothing but names: the same nodes to the last bit.
void check_renaming(const JobScene& scene, const Run& first, Outcome& outcome) {
  Pattern renamed = scene.pattern;
  for (std::size_t p = 0; p < renamed.panels.size(); ++p)
    renamed.panels[p].name = print_text("z%zu_%zu", (p * 7919 + 13) % 1000, p);
  const auto again = derive(scene, renamed, scene.reference, scene.target);
  if (again.value.reference.drape.drape.nodes != first.result.reference.drape.drape.nodes ||
      again.value.derived.mesh.rest != first.result.derived.mesh.rest)
    outcome.fail("other names of the panels give another pattern");
}

// Target areas of the panels, in the order of `order` (to_of_from).
std::vector<double> target_areas(const DerivedGarment& derived) {
  std::vector<double> areas;
  for (const Panel& panel : derived.derived.drawn.pattern.panels) areas.push_back(std::abs(outline_signed_area(panel)));
  return areas;
}

void compare_derived(const JobScene& scene, const DerivedGarment& a, const DerivedGarment& b,
                     const std::vector<int>& b_of_a, const std::string& what, Outcome& outcome) {
  if (!scene.tight) return;
  const std::vector<double> first = target_areas(a), second = target_areas(b);
  for (std::size_t p = 0; p < first.size(); ++p) {
    const double other = second[static_cast<std::size_t>(b_of_a[p])];
    expect_near(outcome, what + ": area of panel " + std::to_string(p), first[p], other, kSameArea * first[p]);
  }
  expect_near(outcome, what + ": stretch error", a.derived.rms_stretch_error, b.derived.rms_stretch_error,
              kSameStretch);
}

void check_reordering(const JobScene& scene, const Run& first, Outcome& outcome) {
  const int count = static_cast<int>(scene.pattern.panels.size());
  Pattern turned = scene.pattern;
  std::vector<int> turned_of_panel;
  for (int p = 0; p < count; ++p) turned_of_panel.push_back(count - 1 - p);
  for (int p = 0; p < count; ++p)
    turned.panels[static_cast<std::size_t>(count - 1 - p)] = scene.pattern.panels[static_cast<std::size_t>(p)];
  for (Seam& seam : turned.seams)
    for (SeamSide* side : {&seam.a, &seam.b}) side->panel = PanelId(count - 1 - side->panel.value);
  std::reverse(turned.seams.begin(), turned.seams.end());
  const auto again = derive(scene, turned, scene.reference, scene.target);
  compare_derived(scene, first.result, again.value, turned_of_panel, "panels in another order", outcome);
}

BodyInput shifted(const BodyInput& input, const Vec3& by) {
  TriangleMesh surface = read_body(input).surface;
  surface.vertices.rowwise() += by.transpose();
  return form_input(surface, 1.0);
}

void check_shift(const JobScene& scene, const Run& first, test::Dice& dice, Outcome& outcome) {
  const Vec3 by(dice.between(-2, 2), 0, dice.between(-2, 2));
  Pattern moved = scene.pattern;
  std::vector<int> same;
  for (std::size_t p = 0; p < moved.panels.size(); ++p) {
    moved.panels[p].translation += by;
    same.push_back(static_cast<int>(p));
  }
  const auto again = derive(scene, moved, shifted(scene.reference, by), shifted(scene.target, by));
  compare_derived(scene, first.result, again.value, same, "scene moved sideways", outcome);
}

}  // namespace

void check_job(const JobScene& plain, test::Dice& dice, Outcome& outcome) {
  JobScene scene = plain;
  scene.options.outputs = {"altered_pattern.json", "altered_pattern.svg", "ticket.json",
                           "target_pattern.json",  "reference_drape.obj", "result.json"};
  if (dice.chance(0.3)) scene.options.outputs.push_back("target_after.obj");
  const Run first = run(scene, scene.pattern, scene.reference, scene.target);
  check_result(first, scene.options.stretch_limit, outcome);
  switch (dice.whole(0, 5)) {
    case 0: return check_determinism(scene, first, outcome);
    case 1: return check_renaming(scene, first, outcome);
    case 2: return check_reordering(scene, first, outcome);
    case 3:
      if (scene.shiftable) check_shift(scene, first, dice, outcome);
      return;
    default: return;
  }
}

}  // namespace toile::stress

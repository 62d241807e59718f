// SPDX-License-Identifier: GPL-3.0-or-later
// worn [GARMENT...] [--triangles N] [--stages FOLDER] [--pictures FOLDER] [--sentences]: garments worn by MakeHuman
// bodies (made by deriving the shared garments for them first), altered for others: leggings from child to adult and
// back, a dress on five sizes and heights, skirt, sweater, trousers and T-shirt for a smaller, a larger and a scanned
// person. Prints fit before and after and where every plan rested; pictures: the garment where it was worn, on the
// other person as it is and as altered, all to one scale of stretch, and what is cut; one per pair and
// contact_sheet.png.
#include <algorithm>
#include <cstdio>

#include "engine/core/units.h"
#include "engine/io/garmentcode_json.h"
#include "engine/stages/render_views.h"
#include "tests/bench/alter_pairs.h"
#include "tests/bench/derive.h"
#include "tests/bench/drape_sheets.h"
#include "tests/bench/words.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct WornPair {
  const char *garment, *wearer, *body;
};

constexpr WornPair kPairs[] = {
    {"leggings_tight", "mh_child_8y", "mh_female_average"},
    {"leggings_tight", "mh_female_average", "mh_child_8y"},
    {"dress_sleeveless", "mh_female_average", "mh_female_thin_short"},
    {"dress_sleeveless", "mh_female_average", "mh_female_thin_tall"},
    {"dress_sleeveless", "mh_female_average", "mh_female_athletic"},
    {"dress_sleeveless", "mh_female_average", "mh_female_heavy_short"},
    {"dress_sleeveless", "mh_female_average", "mh_female_heavy_tall"},
    {"skirt_pencil", "mh_female_average", "mh_female_thin_short"},
    {"skirt_pencil", "mh_female_average", "mh_female_heavy_tall"},
    {"skirt_pencil", "mh_female_average", "scan_b"},
    {"sweater_loose_hood", "mh_male_average", "mh_female_thin_short"},
    {"sweater_loose_hood", "mh_male_average", "mh_male_old_heavy"},
    {"sweater_loose_hood", "mh_male_average", "scan_b"},
    {"pants_straight", "mh_male_average", "mh_female_thin_short"},
    {"pants_straight", "mh_male_average", "mh_male_old_heavy"},
    {"pants_straight", "mh_male_average", "scan_b"},
    {"tshirt_fitted", "mh_female_average", "mh_female_thin_short"},
    {"tshirt_fitted", "mh_female_average", "mh_female_heavy_tall"},
    {"tshirt_fitted", "mh_female_average", "scan_b"},
};

constexpr int kViewHeight = 420, kPatternWidth = 520, kColumns = 2;

struct WornRequest {
  std::vector<std::string> garments;
  AlterOptions job;
  std::string stages, pictures;
  bool sentences = false;
};

WornRequest worn_request(Words words) {
  WornRequest request;
  request.job.triangles = words.integer("--triangles").value_or(4000);
  request.job.outputs = {"fit_after.png"};
  request.stages = words.text("--stages").value_or("");
  request.pictures = words.text("--pictures").value_or("");
  request.sentences = words.flag("--sentences");
  request.garments = words.rest();
  return request;
}

Image view_of(const Body& body, const PatternMesh& mesh, const Drape& drape, const FittingMap& fit,
              const std::string& title) {
  ViewOptions options;
  options.views = {View::Front, View::Back};
  options.view_height = kViewHeight;
  options.max_view_width = kViewHeight;
  options.title = title;
  return draw_views(&body.surface, &mesh, &drape, &fit, options);
}

Image picture_of_pair(const WornPair& pair, const AlterResult& r) {
  const DrapedGarment& worn = r.reference;
  std::vector<Image> cells = {
      view_of(worn.body, worn.mesh, worn.drape.drape, worn.fit, pair.garment + std::string(" on ") + pair.wearer),
      view_of(r.target_body, worn.mesh, r.before->drape, r.fit_before, pair.body + std::string(" before")),
  };
  if (r.after && r.after->problem.empty())
    cells.push_back(
        view_of(r.target_body, r.after->mesh, r.after->drape.drape, r.after->fit, pair.body + std::string(" after")));
  cells.push_back(picture_of("cloth", r.altered, kPatternWidth));
  int width = 0, height = 0, x = 0;
  for (const Image& cell : cells) width += cell.width, height = std::max(height, cell.height);
  Image row(width, height, {255, 255, 255});
  for (const Image& cell : cells) {
    paste(row, cell, x, 0);
    x += cell.width;
  }
  return row;
}

// "6 off 12.0, 7+2 off 7.9": operations of every plan, and its faults, and where it rested, mm.
std::string words_of(const PlacedPlans& place) {
  std::string words;
  for (const TriedPlan& plan : place.plans) {
    words += (words.empty() ? "" : ", ") + std::to_string(plan.operations);
    if (plan.faults > 0) words += "+" + std::to_string(plan.faults);
    words += " off " + fixed(kMmPerMetre * plan.position, 1);
  }
  return words;
}

std::vector<std::string> words_of(const WornPair& pair, const AlterResult& r) {
  const AlterOutcome outcome = outcome_of(r.altered);
  const auto percent = [](double share) { return fixed(100.0 * share, 2); };
  const bool sewn = r.after && r.after->problem.empty();
  double inserted = 0.0, removed = 0.0;
  for (const PanelAlteration& panel : r.altered.panels) {
    for (const AlteredRegion& region : panel.insertions) inserted += region.area;
    for (const AlteredRegion& region : panel.removals) removed += region.area;
  }
  return {pair.garment,
          pair.wearer,
          pair.body,
          percent(compare_fits(r.reference.mesh, r.reference.fit, r.fit_before).whole.rms_stretch),
          percent(r.derived.rms_stretch_error),
          sewn ? percent(compare_fits(r.after->mesh, r.after->reference, r.after->fit).whole.rms_stretch) : "-",
          sewn ? std::string(rest_name(r.after->drape.quality.rest)) : "-",
          sewn ? std::to_string(r.after->drape.quality.nodes_inside) : "-",
          std::to_string(outcome.operations),
          fixed(1e4 * inserted, 0),
          fixed(1e4 * removed, 0),
          percent(outcome.balance),
          std::to_string(outcome.flags),
          fixed(kMmPerMetre * r.place.kept_plan().position, 1),
          fixed(kMmPerMetre * r.place.allowed, 1),
          words_of(r.place)};
}

// The garment as drafted for its own body, made to fit the wearer.
GarmentInput worn_garment(const WornPair& pair, const AlterOptions& job, StageCache* stages) {
  const DerivedGarment derived = derive_pair(pair.garment, pair.wearer, job, stages);
  const std::string text = write_garmentcode(derived.derived.drawn.pattern);
  return {std::string(pair.garment) + ".json", Bytes(text.begin(), text.end())};
}

}  // namespace

int bench_worn(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench worn needs ../shared/data\n");
    return 2;
  }
  const WornRequest request = worn_request(Words(arguments.words));
  const auto stages = stage_store(request.stages);
  Table table({"garment", "worn by", "for", "before %", "ideal %", "altered %", "rest", "inside", "operations",
               "in cm2", "out cm2", "balance %", "flags", "off mm", "allowed", "plans"});
  std::vector<Image> sheet;
  int failed = 0;
  for (const WornPair& pair : kPairs) {
    const auto& wanted = request.garments;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), pair.garment) == wanted.end()) continue;
    try {
      StageRunner runner(stages.get(), nullptr, kAlterStages);
      const AlterResult r = alter_garment(worn_garment(pair, request.job, stages.get()), shared_wearer(pair.wearer),
                                          shared_wearer(pair.body), request.job, runner);
      table.add(words_of(pair, r));
      if (request.sentences) {
        std::printf("%s from %s to %s\n", pair.garment, pair.wearer, pair.body);
        for (const TicketOperation& operation : r.altered.ticket.operations)
          std::printf("  %s\n", operation.sentence.c_str());
        for (const auto* flags : {&r.altered.flags, &r.altered.sewn.flags})
          for (const std::string& flag : *flags) std::printf("  flag: %s\n", flag.c_str());
      }
      if (!request.pictures.empty()) {
        sheet.push_back(picture_of_pair(pair, r));
        write_picture(request.pictures, std::string(pair.garment) + "_" + pair.wearer + "_" + pair.body, sheet.back());
      }
    } catch (const Error& error) {
      ++failed;
      std::printf("%s from %s to %s: %s\n", pair.garment, pair.wearer, pair.body, error.message.c_str());
    }
    std::fflush(stdout);
  }
  table.print(arguments.csv);
  if (!sheet.empty()) write_picture(request.pictures, "contact_sheet", tile(sheet, kColumns));
  return failed == 0 ? 0 : 1;
}

}  // namespace toile::bench

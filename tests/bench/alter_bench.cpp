// SPDX-License-Identifier: GPL-3.0-or-later
// alter [GARMENT[:BODY]...] [--triangles N] [--stages FOLDER] [--pictures FOLDER] [--greedy] [--drape] [--sentences]
//       [--mu X] [--gamma X] [--plans N] [--mesh-edges] [--growth]: alters shared garments for other bodies (default:
//       the
// derivation's 40 pairs) as a job does and prints operations, what strain the cloth keeps, how many plans were tried,
// and the CPU time of one plan alone and of all with the drapes they are tried on with.
// --drape: also how it fits, sewn and draped. --greedy: beside choosing without the program. --pictures: one per pair
// and contact_sheet.png. --stages: where finished stages are kept. Then which of the acceptance lines hold.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "engine/stage_options.h"
#include "tests/bench/alter_pairs.h"
#include "tests/bench/derive.h"
#include "tests/bench/drape_sheets.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

constexpr int kSheetColumns = 5, kSheetWidth = 620;
// Gates of the acceptance lines.
constexpr double kShareOfIdeal = 1.25, kFartherOff = 2e-3, kBalance = 0.01, kAlike = 5e-4, kFewFlags = 0.1,
                 kNarrow = 0.95;  // widths are measured to a few per cent

struct AlterRequest {
  std::vector<AlterPair> pairs;
  std::string stages, pictures;
  bool greedy = false, drape = false, sentences = false, growth = false;
  AlterOptions job;
};

AlterRequest alter_request(const std::vector<std::string>& words) {
  AlterRequest request;
  request.job.triangles = 4000;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&] { return i + 1 < words.size() ? words[++i] : std::string(); };
    if (word == "--triangles")
      request.job.triangles = std::atoi(value().c_str());
    else if (word == "--stages")
      request.stages = value();
    else if (word == "--pictures")
      request.pictures = value();
    else if (word == "--mu")
      request.job.stretch_limit = std::atof(value().c_str());
    else if (word == "--gamma")
      request.job.seam_preference = std::atof(value().c_str());
    else if (word == "--plans")
      request.job.alteration_plans = std::atoi(value().c_str());
    else if (word == "--mesh-edges")
      request.job.cuts = CutKind::MeshEdges;
    else if (word == "--greedy")
      request.greedy = true;
    else if (word == "--drape")
      request.drape = true;
    else if (word == "--sentences")
      request.sentences = true;
    else if (word == "--growth")
      request.growth = true;
    else if (const std::size_t colon = word.find(':'); colon != std::string::npos)
      request.pairs.push_back({word.substr(0, colon), word.substr(colon + 1)});
    else
      for (const AlterPair& pair : acceptance_pairs())
        if (pair.garment == word || pair.body == word) request.pairs.push_back(pair);
  }
  if (request.pairs.empty()) request.pairs = acceptance_pairs();
  return request;
}

struct Row {
  AlterPair pair;
  AlterOutcome chosen;
  std::optional<AlterOutcome> greedy;
  std::optional<AlterFit> fit;
};

void print_sentences(const AlterPair& pair, const AlterPatternResult& result) {
  std::printf("%s for %s\n", pair.garment.c_str(), pair.body.c_str());
  for (const TicketOperation& operation : result.ticket.operations) std::printf("  %s\n", operation.sentence.c_str());
  for (const std::string& flag : result.flags) std::printf("  flag: %s\n", flag.c_str());
  for (const std::string& flag : result.sewn.flags) std::printf("  flag: %s\n", flag.c_str());
}

Row alter_one(const AlterRequest& request, const AlterPair& pair, const AlterOptions& job, StageCache* stages,
              std::vector<Image>& sheet) {
  const DerivedGarment derived = derive_pair(pair.garment, pair.body, job, stages);
  double start = cpu_seconds();
  alter_pattern(derived.reference.pattern, derived.reference.mesh, derived.derived.mesh.rest, alter_options_of(job));
  const double one_plan = cpu_seconds() - start;
  start = cpu_seconds();
  const AlterInLoopResult in_loop = alter_derived(derived, job);
  const AlterPatternResult& result = in_loop.altered;
  Row row{pair, outcome_of(result), {}, {}};
  row.chosen.seconds = one_plan;
  row.chosen.all_seconds = cpu_seconds() - start;
  row.chosen.plans = in_loop.place.plans.size();
  if (request.greedy) {
    AlterOptions greedy = job;
    greedy.tear_weights = TearWeights::Greedy;
    row.greedy = outcome_of(alter_derived(derived, greedy).altered);
  }
  if (request.drape) row.fit = fit_of(derived, result, job);
  if (row.fit && !row.fit->problem.empty())
    std::printf("%s for %s: %s\n", pair.garment.c_str(), pair.body.c_str(), row.fit->problem.c_str());
  if (!request.pictures.empty()) {
    const std::string title = pair.garment + " for " + pair.body;
    write_picture(request.pictures, pair.garment + "_" + pair.body, picture_of(title, result, 1400));
    sheet.push_back(picture_of(title, result, kSheetWidth));
  }
  if (request.sentences) print_sentences(pair, result);
  return row;
}

std::vector<std::string> words_of(const Row& row) {
  const AlterOutcome& o = row.chosen;
  std::vector<std::string> words = {row.pair.garment,
                                    row.pair.body,
                                    std::to_string(o.operations),
                                    std::to_string(o.tears),
                                    row.greedy ? std::to_string(row.greedy->operations) : "-",
                                    row.greedy ? fixed(kPercent * row.greedy->strain_after, 1) : "-",
                                    fixed(kPercent * o.strain_before, 1),
                                    fixed(kPercent * o.strain_after, 1)};
  if (row.fit && row.fit->problem.empty())
    for (const double value :
         {kPercent * row.fit->stretch_before, kPercent * row.fit->stretch_ideal, kPercent * row.fit->stretch_after,
          kMm * row.fit->position_ideal, kMm * row.fit->position_anew, kMm * row.fit->position_after})
      words.push_back(fixed(value, 2));
  else
    words.insert(words.end(), 6, row.fit ? "failed" : "-");
  for (const std::string& word : {std::to_string(o.most_cuts), fixed(kMm * o.narrowest, 0),
                                  fixed(kPercent * o.balance, 2), fixed(kMm * o.plies, 2), std::to_string(o.flags),
                                  std::to_string(o.plans), fixed(o.seconds, 2), fixed(o.all_seconds, 2)})
    words.push_back(word);
  return words;
}

bool fits(const AlterFit& fit, double mu) {
  return fit.problem.empty() &&
         fit.stretch_after <= std::max(kShareOfIdeal * fit.stretch_ideal, fit.stretch_ideal + 0.5 * mu);
}

bool lies(const AlterFit& fit, double ideal) {
  return fit.problem.empty() && fit.position_after <= kShareOfIdeal * ideal + kFartherOff;
}

// Prints how many rows a line holds for, and names the others.
bool judge(const std::vector<Row>& rows, const char* line, double least_share,
           const std::function<bool(const Row&)>& holds) {
  std::size_t good = 0;
  std::string others;
  for (const Row& row : rows)
    if (holds(row))
      ++good;
    else
      others += " " + row.pair.garment + ":" + row.pair.body;
  const bool met = static_cast<double>(good) >= least_share * static_cast<double>(rows.size());
  std::printf("%s: %zu of %zu: %s%s%s\n", line, good, rows.size(), met ? "met" : "NOT met", others.empty() ? "" : ";",
              others.c_str());
  return met;
}

int summarise(const std::vector<Row>& rows, const AlterOptions& job) {
  if (rows.empty()) return 1;
  bool met = judge(rows, "without a flag", 1.0 - kFewFlags, [](const Row& row) { return row.chosen.flags == 0; });
  met &= judge(rows, "areas balance within 1 %", 1.0, [](const Row& row) { return row.chosen.balance <= kBalance; });
  met &= judge(rows, "both sides of every seam alike within 0.5 mm", 1.0,
               [](const Row& row) { return row.chosen.plies <= kAlike; });
  met &= judge(rows, "no side cut into more often than allowed", 1.0,
               [&](const Row& row) { return row.chosen.most_cuts <= job.max_tears_per_side; });
  met &= judge(rows, "nothing let in narrower than the least strip", 1.0, [&](const Row& row) {
    return row.chosen.narrowest == 0.0 || kMm * row.chosen.narrowest >= kNarrow * job.min_strip_mm;
  });
  if (rows.front().greedy)
    met &= judge(rows, "no more operations than the greedy choice", 1.0,
                 [](const Row& row) { return row.chosen.operations <= row.greedy->operations; });
  if (rows.front().fit) {
    met &= judge(rows, "stretch error within 1.25 of the ideal or half the allowed stretch", 1.0,
                 [&](const Row& row) { return fits(*row.fit, job.stretch_limit); });
    met &= judge(rows, "position error within 1.25 of the target pattern's own, meshed anew as well, and 2 mm", 1.0,
                 [](const Row& row) { return lies(*row.fit, row.fit->position_anew); });
    judge(rows, "  the same, of the target pattern on the mesh it was derived on", 1.0,
          [](const Row& row) { return lies(*row.fit, row.fit->position_ideal); });
  }
  return met ? 0 : 1;
}

}  // namespace

int bench_alter(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench alter needs ../shared/data\n");
    return 2;
  }
  const AlterRequest request = alter_request(arguments.words);
  const auto stages = stage_store(request.stages);
  Table table({"garment",      "body",      "operations",
               "tears",        "greedy",    "its p95 %",
               "p95 % before", "after",     "stretch % before",
               "ideal",        "after",     "position mm ideal",
               "anew",         "after",     "cuts",
               "narrowest mm", "balance %", "plies mm",
               "flags",        "plans",     "CPU s a plan",
               "in all"});
  std::vector<Row> rows;
  std::vector<Image> sheet;
  for (const AlterPair& pair : request.pairs) {
    std::vector<double> sizes, times;
    for (const int triangles :
         request.growth ? std::vector<int>{2000, 4000, 10000, 20000} : std::vector<int>{*request.job.triangles}) {
      AlterOptions job = request.job;
      job.triangles = triangles;
      try {
        rows.push_back(alter_one(request, pair, job, stages.get(), sheet));
        table.add(words_of(rows.back()));
        times.push_back(rows.back().chosen.seconds);
        sizes.push_back(triangles);
      } catch (const Error& error) {
        std::printf("%s for %s: %s\n", pair.garment.c_str(), pair.body.c_str(), error.message.c_str());
      }
      std::fflush(stdout);
    }
    if (request.growth)
      std::printf("%s for %s: time grows as n^%.2f\n", pair.garment.c_str(), pair.body.c_str(),
                  growth_exponent(sizes, times));
  }
  table.print(arguments.csv);
  if (!sheet.empty()) write_picture(request.pictures, "contact_sheet", tile(sheet, kSheetColumns));
  return summarise(rows, request.job);
}

}  // namespace toile::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// The first thread through the whole house: a tube skirt, whose target pattern is known.
#include <gtest/gtest.h>

#include "engine/archive_stages.h"
#include "engine/job_report.h"
#include "engine/outputs.h"
#include "engine/result_records.h"
#include "tests/pipeline/tube_job.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

AlterResult alter_tube(const std::string& from, const std::string& to, StageCache* cache = nullptr, int threads = 1) {
  StageRunner runner(cache, nullptr, kAlterStages, threads);
  return alter_garment(test::tube_skirt(), {.name = "builtin:" + from, .bytes = {}},
                       {.name = "builtin:" + to, .bytes = {}}, test::small_job(), runner);
}

// Mean width and height of the target panels over those of the reference.
Vec2 growth(const AlterResult& result) {
  const auto extent = [](const Points2& rest, const PanelRange& panel) -> Vec2 {
    const auto rows = rest.middleRows(panel.vertex_begin, panel.vertex_end - panel.vertex_begin);
    return (rows.colwise().maxCoeff() - rows.colwise().minCoeff()).transpose();
  };
  Vec2 sum = Vec2::Zero();
  for (const PanelRange& panel : result.reference.mesh.panels)
    sum += extent(result.derived.mesh.rest, panel).cwiseQuotient(extent(result.reference.mesh.rest, panel));
  return sum / static_cast<double>(result.reference.mesh.panels.size());
}

// Cloth lies a contact thickness off the form: its girth is that of radius + thickness.
constexpr double kRatioTolerance = 5e-3;

TEST(TubePipeline, ChangesNothingWhenBothBodiesAreTheSame) {
  const AlterResult result = alter_tube("tube-14-100", "tube-14-100");
  ASSERT_GT(result.reference.fit.stretch_weft.mean(), 0.02);  // it is a tight skirt: there is something to keep
  EXPECT_LT((result.derived.mesh.rest - result.reference.mesh.rest).cwiseAbs().maxCoeff(), 5e-4);
}

TEST(TubePipeline, WidensAndLengthensTheSkirtAsTheFormGrows) {
  const Vec2 wider = growth(alter_tube("tube-14-100", "tube-18-100"));
  EXPECT_NEAR(wider.x(), (0.18 + 0.003) / (0.14 + 0.003), kRatioTolerance);
  EXPECT_NEAR(wider.y(), 1.0, kRatioTolerance);
  const Vec2 taller = growth(alter_tube("tube-14-100", "tube-14-125"));
  EXPECT_NEAR(taller.x(), 1.0, kRatioTolerance);
  EXPECT_NEAR(taller.y(), 1.25, kRatioTolerance);
}

// target_pattern.json with target_worn.obj beside it.
GarmentInput handed_on(const AlterResult& there, const BodyInput& body) {
  AlterOptions options = test::small_job();
  options.outputs = {"target_pattern.json", "target_worn.obj"};
  GarmentInput again;
  for (const OutputFile& file : alter_outputs(there, options, job_info(test::tube_skirt(), body, body))) {
    if (file.name == "target_pattern.json") again.bytes = file.bytes;
    if (file.name == "target_worn.obj") again.worn = file.bytes;
  }
  again.name = "target_pattern.json";
  return again;
}

TEST(TubePipeline, ComesBackFromAnotherFormToThePatternItWentWith) {
  const BodyInput slim{.name = "builtin:tube-14-100", .bytes = {}}, stout{.name = "builtin:tube-18-125", .bytes = {}};
  const AlterResult there = alter_tube("tube-14-100", "tube-18-125");
  StageRunner runner(nullptr, nullptr, kDeriveStages);
  const DerivedGarment back = derive_garment(handed_on(there, stout), stout, slim, test::small_job(), runner).value;
  const auto size = [](const Points2& rest) -> Vec2 {
    return (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).transpose();
  };
  // Asked for on the way back is the fit of the first form, not what the drape on the second one reached.
  EXPECT_NEAR(back.reference.fit.stretch_weft.mean(), there.reference.fit.stretch_weft.mean(), 1e-5);
  for (std::size_t p = 0; p < there.reference.mesh.panels.size(); ++p) {
    const auto of_panel = [p](const PatternMesh& mesh, const Points2& rest) -> Points2 {
      const PanelRange& range = mesh.panels[p];
      return rest.middleRows(range.vertex_begin, range.vertex_end - range.vertex_begin);
    };
    const Vec2 before = size(of_panel(there.reference.mesh, there.reference.mesh.rest)),
               after = size(of_panel(back.reference.mesh, back.derived.mesh.rest));
    EXPECT_NEAR(after.x(), before.x(), 5e-4);
    EXPECT_NEAR(after.y(), before.y(), 5e-4);
  }
}

struct MemoryCache : StageCache {
  std::map<std::string, Bytes> kept;
  int hits = 0;
  std::optional<Bytes> get(const std::string& key) override {
    const auto found = kept.find(key);
    if (found == kept.end()) return std::nullopt;
    ++hits;
    return found->second;
  }
  void put(const std::string& key, const Bytes& value) override { kept.emplace(key, value); }
};

std::string bytes_of(const AlterResult& result, const std::vector<std::string>& pictures = {}, bool at_once = false) {
  std::string all;
  AlterOptions options = test::small_job();
  options.outputs = {"reference_drape.obj", "target_before.obj", "target_pattern.json", "ticket.json"};
  options.outputs.insert(options.outputs.end(), pictures.begin(), pictures.end());
  const BodyInput body{.name = "builtin:tube-14-100", .bytes = {}};
  const JobInfo info = job_info(test::tube_skirt(), body, body);
  for (const OutputFile& file : alter_outputs(result, options, info, at_once))
    all.append(file.name).append(file.bytes.begin(), file.bytes.end());
  return all;
}

TEST(TubePipeline, ResumesAfterEveryStageWithTheSameBytes) {
  MemoryCache cache;
  const std::string fresh = bytes_of(alter_tube("tube-14-100", "tube-18-100", &cache));
  const int stages = static_cast<int>(cache.kept.size());
  ASSERT_GE(stages, 8);
  EXPECT_EQ(bytes_of(alter_tube("tube-14-100", "tube-18-100", &cache)), fresh);
  EXPECT_EQ(cache.hits, kAlterStages);
  for (const auto& [key, value] : std::map<std::string, Bytes>(cache.kept)) {
    cache.kept.erase(key);
    EXPECT_EQ(bytes_of(alter_tube("tube-14-100", "tube-18-100", &cache)), fresh);
    ASSERT_EQ(cache.kept.count(key), 1u);
    EXPECT_EQ(cache.kept.at(key), value);
  }
}

TEST(TubePipeline, GivesTheSameBytesWithTwoThreadsAsWithOne) {
  const std::vector<std::string> pictures = {"fit_reference.png", "fit_before.png", "fit_target.png"};
  MemoryCache one, two;
  EXPECT_EQ(bytes_of(alter_tube("tube-14-100", "tube-11-125", &two, 2), pictures, true),
            bytes_of(alter_tube("tube-14-100", "tube-11-125", &one), pictures));
  EXPECT_EQ(two.kept, one.kept);
}

TEST(TubePipeline, TellsTheTimesOfStagesInOneOrderWithAnyNumberOfThreads) {
  const auto stages = [](int threads) {
    StageRunner runner(nullptr, nullptr, kAlterStages, threads);
    alter_garment(test::tube_skirt(), {.name = "builtin:tube-14-100", .bytes = {}},
                  {.name = "builtin:tube-18-100", .bytes = {}}, test::small_job(), runner);
    std::string names;
    for (const StageTiming& timing : runner.timings()) names += timing.stage + " ";
    return names;
  };
  EXPECT_EQ(stages(2), stages(1));
}

TEST(TubePipeline, DrapesTheGarmentAsItIsOnlyWhereAFileTellsOfIt) {
  const auto job = [](const std::string& output) {
    AlterOptions options = test::small_job();
    options.outputs = {output};
    StageRunner runner(nullptr, nullptr, kAlterStages);
    const BodyInput slim{.name = "builtin:tube-14-100", .bytes = {}}, stout{.name = "builtin:tube-18-100", .bytes = {}};
    const AlterResult result = alter_garment(test::tube_skirt(), slim, stout, options, runner);
    const auto files = alter_outputs(result, options, job_info(test::tube_skirt(), slim, stout));
    const std::string told(files.back().bytes.begin(), files.back().bytes.end());
    EXPECT_EQ(told.find("\"before\"") != std::string::npos, result.before.has_value());
    return std::pair(result.before.has_value(), result.altered.target_area);
  };
  const auto [draped, area] = job("result.json");
  const auto [draped_for_ticket, area_of_ticket] = job("ticket.json");
  EXPECT_TRUE(draped);
  EXPECT_FALSE(draped_for_ticket);
  EXPECT_EQ(area_of_ticket, area);
}

TEST(TubePipeline, AltersAlikeWhateverFilesAreAskedFor) {
  const auto altered = [](const std::string& output) {
    AlterOptions options = test::small_job();
    options.outputs = {output};
    StageRunner runner(nullptr, nullptr, kAlterStages);
    const AlterResult result = alter_garment(test::tube_skirt(), {.name = "builtin:tube-14-100", .bytes = {}},
                                             {.name = "builtin:tube-18-125", .bytes = {}}, options, runner);
    EXPECT_GT(result.place.kept_plan().position, 0.0);
    return to_bytes(AlterInLoopResult{result.altered, {}, result.place});
  };
  const Bytes for_ticket = altered("ticket.json");
  EXPECT_EQ(altered("target_after.obj"), for_ticket);
  EXPECT_EQ(altered("all"), for_ticket);
}

TEST(TubePipeline, TellsWhereTheAlteredGarmentRests) {
  const AlterResult result = alter_tube("tube-14-100", "tube-18-100");
  AlterOptions options = test::small_job();
  options.outputs = {"result.json"};
  const BodyInput body{.name = "builtin:tube-14-100", .bytes = {}};
  const auto files = alter_outputs(result, options, job_info(test::tube_skirt(), body, body));
  const std::string told(files.back().bytes.begin(), files.back().bytes.end());
  EXPECT_NE(told.find("\"altered_place\": {"), std::string::npos);
  const Record place = place_record(result.place);
  EXPECT_TRUE(std::get<bool>(*place.find("in_place")));
  const double position = std::get<double>(*place.find("position_mm"));
  EXPECT_GT(position, 0.0);
  EXPECT_LE(position, std::get<double>(*place.find("allowed_mm")));
  EXPECT_EQ(std::get<std::vector<Record>>(*place.find("plans")).size(), result.place.plans.size());
}

TEST(TubePipeline, TheReportSaysWhereTheAlteredGarmentRestsOffItsPlace) {
  AlterResult result = alter_tube("tube-14-100", "tube-18-100");
  const JobFits fits = compare_job_fits(result);
  const auto in_place = summary_sentences(result, fits);
  result.place.allowed = 0.0;
  const auto off = summary_sentences(result, fits);
  ASSERT_EQ(off.size(), in_place.size() + 1);
  EXPECT_NE(off[2].find("mm off its place"), std::string::npos);
}

TEST(TubePipeline, ReportsProgressThatNeverFallsAndEndsAtOne) {
  for (const int threads : {1, 2}) {
    double last = 0.0;
    Progress progress;
    progress.report = [&](std::string_view, double fraction) {
      EXPECT_GE(fraction, last - 1e-12);
      last = fraction;
    };
    StageRunner runner(nullptr, &progress, kAlterStages, threads);
    alter_garment(test::tube_skirt(), {.name = "builtin:tube-14-100", .bytes = {}},
                  {.name = "builtin:tube-11-100", .bytes = {}}, test::small_job(), runner);
    EXPECT_EQ(last, 1.0);
  }
}

TEST(TubePipeline, EndsAtOnceWhenCancelled) {
  std::atomic<bool> cancelled{false};
  Progress progress;
  progress.cancelled = &cancelled;
  progress.report = [&](std::string_view stage, double) { cancelled = stage == "drape_before"; };
  StageRunner runner(nullptr, &progress, kAlterStages);
  try {
    alter_garment(test::tube_skirt(), {.name = "builtin:tube-14-100", .bytes = {}},
                  {.name = "builtin:tube-18-100", .bytes = {}}, test::small_job(), runner);
    FAIL() << "ran to the end";
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::Cancelled);
  }
}

}  // namespace
}  // namespace toile

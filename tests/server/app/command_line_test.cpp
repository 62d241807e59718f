// SPDX-License-Identifier: GPL-3.0-or-later
// The command line as a newcomer meets it: what it says of itself, and of what is wrong.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/options_json.h"
#include "tests/server/app/toile_program.h"

namespace toile {
namespace {

using test::kToile;
using test::toile_says;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kExamples = TOILE_SOURCE_DIR "/schemas/examples/";
constexpr const char* kTriangles = "1000";

// The tube skirt worn by the tube it was drafted for.
test::ProcessResult drape(const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {
      "drape", "--garment", kExamples + "tube_skirt.json", "--body", "builtin:tube-14-100", "--triangles", kTriangles,
      "--out", out};
  words.insert(words.end(), more.begin(), more.end());
  return toile_says(words);
}

// As the help is printed: one sentence over several lines.
std::string unwrapped(const std::string& text) {
  std::string joined;
  for (const char c : text)
    if (c != ' ' && c != '\n') joined += c;
  return joined;
}

TEST(CommandLine, HelpTellsEveryOptionOfAJobInTheWordsOfItsSchema) {
  const test::ProcessResult result = toile_says({"alter", "--help"});
  ASSERT_EQ(result.exit_code, 0);
  for (const OptionInfo& option : list_options()) {
    std::string sentence = option.meaning;
    if (sentence.ends_with('.')) sentence.pop_back();
    EXPECT_THAT(unwrapped(result.out), HasSubstr(unwrapped(sentence))) << option.name;
  }
  EXPECT_THAT(unwrapped(result.out), HasSubstr("0.005to0.3;default0.03"));
  EXPECT_THAT(unwrapped(result.out), HasSubstr("oneofdraft,standard,fine;defaultstandard"));
}

TEST(CommandLine, HelpOfADrapeLeavesOutWhatOnlyAnAlterationAsks) {
  const test::ProcessResult result = toile_says({"drape", "--help"});
  EXPECT_THAT(result.out, HasSubstr("--triangles"));
  EXPECT_THAT(result.out, Not(HasSubstr("--seam-preference")));
}

TEST(CommandLine, HelpTellsTheVariableAndTheRangeOfASetting) {
  const test::ProcessResult result = toile_says({"serve", "--help"});
  EXPECT_THAT(unwrapped(result.out), HasSubstr("0to65535;default8080;variableTOILE_PORT"));
}

TEST(CommandLine, WithoutACommandTellsWhichThereAre) {
  const test::ProcessResult nothing = toile_says({}), wrong = toile_says({"alte"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("  alter  "));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("no command \"alte\""));
  EXPECT_EQ(toile_says({"--version"}).out, toile_says({"version"}).out);
}

TEST(CommandLine, AMisspeltWordIsToldWithTheRightOne) {
  const test::ProcessResult option = toile_says({"alter", "--garmet", "skirt.json"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, HasSubstr("toile: there is no option --garmet; did you mean --garment?"));
  EXPECT_THAT(toile_says({"--quiet", "dape"}).err, HasSubstr("no command \"dape\"; did you mean drape?"));
  EXPECT_THAT(toile_says({"--thread=2", "version"}).err, HasSubstr("did you mean --threads?"));
  EXPECT_THAT(toile_says({"drape", "--colour", "red"}).err, HasSubstr("no option --colour; see toile drape --help"));
  EXPECT_THAT(toile_says({"check", "--schema", "nothing", "x"}).err, HasSubstr("see toile check --help"));
}

TEST(CommandLine, WhatStandardOutputDoesNotTakeIsAFailure) {
  const auto says = [](const std::string& line) { return test::run_process({"/bin/sh", "-c", kToile + line}); };
  const test::ProcessResult full = says(" version > /dev/full");
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_THAT(full.err, HasSubstr("standard output: cannot be written"));
  EXPECT_EQ(says(" --quiet body builtin:tube-14-100 | head -n 1").err, "");
}

TEST(CommandLine, StoppedByASignalItLeavesNoResult) {
  const test::TemporaryFolder folder;
  const std::string line =
      kToile + " drape --garment " + kExamples + "leggings.json --body builtin:child-128 --triangles 60000 --out " +
      folder.path() + "/out 2> " + folder.path() + "/said & job=$!; while kill -0 $job && ! grep -q 'putting it on' " +
      folder.path() + "/said; do sleep 0.05; done; kill -TERM $job; wait $job";
  EXPECT_EQ(test::run_process({"/bin/sh", "-c", line}).exit_code, 5);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() + "/out"));
}

TEST(CommandLine, AFileThatALinkLeadsToIsWrittenInto) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("body.obj", ""), link = folder.path() + "/link.obj";
  std::filesystem::create_symlink(file, link);
  ASSERT_EQ(toile_says({"--quiet", "body", "builtin:tube-14-100", "--out", link}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_GT(std::filesystem::file_size(file), 1000u);
}

TEST(CommandLine, WrongOptionsAreToldByTheirFlagOrFile) {
  const test::TemporaryFolder folder;
  const std::string options = folder.write("options.json", R"({"preset": "fast"})");
  const std::string out = folder.path() + "/out";
  const auto flag = drape(out, {"--stretch-limit", "5"}), file = drape(out, {"--options", options});
  const auto name = drape(out, {"--outputs", "fit.png,fit.jpg"}), other = drape(out, {"--outputs", "ticket.json"});
  for (const auto& result : {flag, file, name, other}) EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(flag.err, HasSubstr("--stretch-limit 5: must lie between"));
  EXPECT_THAT(file.err, HasSubstr(options + "#/preset: expected one of draft"));
  EXPECT_THAT(name.err, HasSubstr("--outputs fit.png,fit.jpg: no file of this name"));
  EXPECT_THAT(other.err, HasSubstr("ticket.json comes from an alteration; a drape makes drape.obj"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(CommandLine, AFolderThatCannotBeWrittenIsToldBeforeTheWork) {
  const test::ProcessResult result = drape("/proc/nothing-can-be-made-here");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--out /proc/nothing-can-be-made-here"));
  EXPECT_THAT(result.err, Not(HasSubstr("reading the garment")));
}

TEST(CommandLine, FilesAreMadeByNameWithCommasBetween) {
  const test::TemporaryFolder folder;
  const test::ProcessResult result = drape(folder.path(), {"--outputs", "drape.obj,fit.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/drape.obj"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/fit.png"));
  const test::ProcessResult one = drape(folder.path() + "/one", {"--outputs", "drape.obj", "--json-log"});
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/one/fit.png"));
  EXPECT_THAT(one.err, HasSubstr(R"({"event":"progress","stage":"drape")"));
}

TEST(CommandLine, ABrokenGarmentIsToldByItsFileAndPlace) {
  const test::TemporaryFolder folder;
  const std::string cut = folder.write("cut.json", "{\"pattern\":\n {");
  const auto result = toile_says(
      {"--quiet", "drape", "--garment", cut, "--body", "builtin:tube-14-100", "--out", folder.path() + "/out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("cut.json: not JSON: syntax error at line 2"));
}

TEST(CommandLine, AFileThatIsNoGarmentIsToldByWhatItHolds) {
  const test::TemporaryFolder folder;
  const auto says = [&](const std::string& garment, const std::string& body, const std::string& flag = "--quiet") {
    return toile_says({"drape", "--garment", garment, "--body", body, "--out", folder.path() + "/out", flag}).err;
  };
  const std::string about = folder.write("about.json", R"({"fabric": "jersey", "fits": ["mean_female"]})");
  const std::string skirt = kExamples + "tube_skirt.json";
  EXPECT_THAT(says(about, "builtin:tube-14-100"), HasSubstr("are \"fabric\", \"fits\"; give the file"));
  EXPECT_THAT(says(folder.write("empty.obj", " \n"), "builtin:tube-14-100"), HasSubstr("empty.obj: the file is empty"));
  EXPECT_THAT(says(skirt, skirt), HasSubstr("tube_skirt.json: /: this is a garment"));
  EXPECT_THAT(says(skirt, "builtin:tube-14-100", "--keep-drape"), HasSubstr("keep_drape is for a garment as OBJ"));
}

TEST(CommandLine, LandmarksThatCannotBeUsedAreRefused) {
  const test::TemporaryFolder folder;
  const std::string far = folder.write("far.json", R"({"landmarks_m": {"crotch": [0, 70, 0]}})");
  const std::string unknown = folder.write("unknown.json", R"({"landmarks_m": {"left_wrist": [0.4, 0.9, 0]}})");
  const auto off = toile_says({"body", "builtin:woman-38-168", "--landmarks", far});
  EXPECT_EQ(off.exit_code, 3);
  EXPECT_THAT(off.err, HasSubstr("crotch lies 68 m away from the body"));
  const auto wrong = toile_says({"register", "--reference-body", "builtin:woman-38-168", "--target-body",
                                 "builtin:woman-44-172", "--landmarks", unknown, "--out", folder.path()});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("no landmark \"left_wrist\"; it has ankle_l, "));
}

TEST(CommandLine, ABatchTellsWhichBodyFailsAndGoesOn) {
  const test::TemporaryFolder folder;
  const std::string bodies = folder.write("bodies.txt", "builtin:tube-99\nbuiltin:tube-16-100\n");
  const auto result = toile_says({"batch", "--garment", kExamples + "tube_skirt.json", "--reference-body",
                                  "builtin:tube-14-100", "--target-bodies", bodies, "--triangles", kTriangles,
                                  "--outputs", "ticket.json", "--out", folder.path() + "/all"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, HasSubstr("builtin:tube-99"));
  EXPECT_THAT(result.err, HasSubstr("2/2 tube-16-100"));
  EXPECT_THAT(result.err, HasSubstr("1 body could not be fitted"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/all/tube-16-100/ticket.json"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/all/tube-16-100/report.html"));
}

TEST(CommandLine, ABatchTakesOneBodyAndAFolderWhoseMeshesHaveNotesBesideThem) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(toile_says({"body", "builtin:tube-16-100", "--out", folder.path() + "/form.obj"}).exit_code, 0);
  folder.write("form.json", R"({"measured": "in spring"})");
  for (const std::string& bodies : {folder.path() + "/form.obj", folder.path(), std::string("builtin:tube-16-100")}) {
    const auto result = toile_says({"--quiet", "batch", "--garment", kExamples + "tube_skirt.json", "--reference-body",
                                    "builtin:tube-14-100", "--target-bodies", bodies, "--kind", "form", "--triangles",
                                    kTriangles, "--outputs", "ticket.json", "--out", folder.path() + "/all"});
    EXPECT_EQ(result.exit_code, 0) << bodies << ": " << result.err;
  }
}

TEST(CommandLine, CheckTellsWhatAFileIsAndWhereItIsWrong) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(toile_says({"check", kExamples + "leggings.json"}).out, HasSubstr("valid (garment)"));
  const std::string text = folder.write("notes.txt", "hem 3 cm\n");
  const auto neither = toile_says({"check", text});
  EXPECT_EQ(neither.exit_code, 3);
  EXPECT_THAT(neither.err, HasSubstr("neither a JSON document nor a mesh"));
  const std::string options = folder.write("options.json", R"({"schema": "toile/options/1", "triangles": 3})");
  const auto wrong = toile_says({"check", options});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.err, HasSubstr(options + "#/triangles"));
  const auto body = toile_says({"check", "--schema", "measurements", folder.write("m.json", R"({"figure": "woman"})")});
  EXPECT_EQ(body.exit_code, 3);
}

TEST(CommandLine, AGarmentAndABodyAreToldApartAsMeshes) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(drape(folder.path(), {"--outputs", "drape.obj"}).exit_code, 0);
  const std::string body = folder.path() + "/body.obj";
  ASSERT_EQ(toile_says({"body", "builtin:woman-38-168", "--out", body}).exit_code, 0);
  EXPECT_THAT(toile_says({"check", folder.path() + "/drape.obj"}).out, HasSubstr("garment, 2 panels, 2 seams"));
  EXPECT_THAT(toile_says({"check", body}).out, HasSubstr("body, "));
}

TEST(CommandLine, RegisterWritesTheMapBetweenTwoBodies) {
  const test::TemporaryFolder folder;
  const auto result = toile_says({"--quiet", "register", "--reference-body", "builtin:woman-38-168", "--target-body",
                                  "builtin:woman-44-172", "--out", folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/mapped_reference.obj"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/map.json"));
}

}  // namespace
}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/stress_scene.h"

#include <algorithm>
#include <ctime>

#include "engine/core/error.h"
#include "tests/stress/job_scene.h"
#include "tests/stress/part_scenes.h"

namespace toile::stress {
namespace {

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void run_kind(test::Dice& dice, Outcome& outcome) {
  if (outcome.kind == "patchwork") return check_job(patchwork_scene(dice, outcome), dice, outcome);
  if (outcome.kind == "person") return check_job(person_scene(dice, outcome), dice, outcome);
  if (outcome.kind == "body") return run_body_scene(dice, outcome);
  if (outcome.kind == "cut") return run_cut_scene(dice, outcome);
  if (outcome.kind == "derive") return run_derive_scene(dice, outcome);
  outcome.fail("there is no kind of scene \"" + outcome.kind + "\"");
}

// What the input or the method may be blamed for; the rest of the codes belong to the service, or to a bug.
bool may_be_refused(ErrorCode code) {
  constexpr std::array<ErrorCode, 12> kRefusals = {
      ErrorCode::FormatUnknown,  ErrorCode::FileMalformed,    ErrorCode::LimitExceeded,
      ErrorCode::OptionInvalid,  ErrorCode::BodyUnusable,     ErrorCode::BodyNotRecognised,
      ErrorCode::GarmentInvalid, ErrorCode::SeamInvalid,      ErrorCode::RegistrationFailed,
      ErrorCode::DrapeFailed,    ErrorCode::DerivationFailed, ErrorCode::AlterationFailed};
  return std::find(kRefusals.begin(), kRefusals.end(), code) != kRefusals.end();
}

}  // namespace

test::Dice dice_of(std::uint64_t seed) {
  return test::Dice(seed * 0x2545f4914f6cdd1dULL + 0x9e3779b9ULL);
}

const std::vector<std::string>& scene_kinds() {
  static const std::vector<std::string> kinds = {"patchwork", "person", "body", "cut", "derive"};
  return kinds;
}

Outcome run_scene(const std::string& kind, std::uint64_t seed) {
  Outcome outcome;
  outcome.kind = kind;
  test::Dice dice = dice_of(seed);
  const double start = thread_cpu_seconds();
  try {
    run_kind(dice, outcome);
  } catch (const Error& error) {
    outcome.error = std::string(error_name(error.code)) + ": " + error.what();
    if (outcome.ending == Ending::Done) outcome.ending = Ending::Refused;
    if (!may_be_refused(error.code)) outcome.fail("an error that is no refusal: " + outcome.error);
    if (error.message.empty()) outcome.fail("an error without a message");
  } catch (const std::exception& error) {
    outcome.fail(std::string("an exception that is no Error: ") + error.what());
  }
  outcome.cpu_s = thread_cpu_seconds() - start;
  return outcome;
}

Outcome run_scene(std::uint64_t seed) {
  // In twenty: jobs round forms, jobs on people, and the cheaper scenes of single stages.
  constexpr std::array<int, 20> kKinds = {0, 0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4};
  return run_scene(scene_kinds()[static_cast<std::size_t>(kKinds[seed % kKinds.size()])], seed);
}

}  // namespace toile::stress

// SPDX-License-Identifier: GPL-3.0-or-later
// Job kinds for tests of the service: well-behaved ones that cost nothing, and every way to end badly.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <nlohmann/json.hpp>

#include "engine/core/content_hash.h"
#include "server/app/job_kinds.h"

namespace toile::app {

namespace {

using nlohmann::json;

Bytes bytes_of(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

// {"ms": N} or {"until": FILE}: sleeps so long, or until the file is there; reports progress, can be cancelled.
JobReport sleep_job(const JobContext& context) {
  const json options = json::parse(context.options);
  const std::string until = options.value("until", "");
  const int total = options.value("ms", 100);
  for (int slept = 0; until.empty() ? slept < total : !std::filesystem::exists(until); slept += 10) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    report(context.progress, "sleep", std::min(0.99, static_cast<double>(slept) / total));
  }
  context.artifact("slept.txt", "text/plain", bytes_of(std::to_string(total)));
  return {};
}

// {"bytes": N}: artifacts that follow from the inputs; the summary has a fit by zone.
JobReport write_job(const JobContext& context) {
  const json options = json::parse(context.options);
  std::string text = "made from";
  for (const auto& [role, input] : context.inputs) text += " " + role + "=" + sha256_hex(input.bytes);
  context.artifact("result.json", "application/json", bytes_of(json{{"text", text}}.dump()));
  Bytes filler(options.value("bytes", 1000));
  for (std::size_t i = 0; i < filler.size(); ++i) filler[i] = static_cast<std::uint8_t>(i % 251);
  context.artifact("filler.bin", "application/octet-stream", filler);
  return {json{{"fit", {{"waist", 0.25 * static_cast<double>(text.size() % 7)}, {"hip", 0.1}}}}.dump(),
          R"({"wall_s":0})"};
}

// Copies the bytes of an input out again, as a stage and as an artifact: something of the scan everywhere.
JobReport copy_job(const JobContext& context) {
  const std::string key = sha256_hex(context.inputs.at("reference_body").bytes);
  const bool known = context.stages->get(key).has_value();
  if (!known) context.stages->put(key, context.inputs.at("reference_body").bytes);
  context.artifact("copy.bin", "application/octet-stream", context.inputs.at("target_body").bytes);
  return {json{{"reused", known}, {"target", sha256_hex(context.inputs.at("target_body").bytes)}}.dump(), "{}"};
}

JobReport crash_job(const JobContext&) {
  std::abort();
}

JobReport segfault_job(const JobContext&) {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
  return {};
}

JobReport loop_job(const JobContext&) {
  std::atomic<std::uint64_t> turns{0};
  for (;;) ++turns;
}

// Touches 10 GB, if it gets it.
JobReport allocate_job(const JobContext&) {
  std::vector<Bytes> hoard;
  for (int i = 0; i < 640; ++i) hoard.emplace_back(std::size_t{16} << 20, std::uint8_t{1});
  return {json{{"pieces", hoard.size()}}.dump(), "{}"};
}

JobReport fail_job(const JobContext&) {
  throw Error(ErrorCode::GarmentInvalid, "panel:front", "the outline crosses itself: redraw it");
}

// Ends as if the machine had killed it.
JobReport vanish_job(const JobContext&) {
  std::raise(SIGKILL);
  return {};
}

}  // namespace

void add_test_job_kinds(JobHandlers& kinds) {
  kinds["sleep"] = sleep_job;
  kinds["write"] = write_job;
  kinds["copy"] = copy_job;
  kinds["crash"] = crash_job;
  kinds["segfault"] = segfault_job;
  kinds["loop"] = loop_job;
  kinds["allocate"] = allocate_job;
  kinds["fail"] = fail_job;
  kinds["vanish"] = vanish_job;
}

}  // namespace toile::app

// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/attempt.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>

#include "jobs/worker/child_protocol.h"

namespace toile {

namespace {

namespace fs = std::filesystem;
using Steady = std::chrono::steady_clock;

constexpr auto kPoll = std::chrono::milliseconds(50);
constexpr std::size_t kStderrTail = 400;  // characters of a crashed job's last words

// The working folder of one attempt; gone with it.
class Scratch {
 public:
  Scratch(const fs::path& root, const Lease& lease)
      : folder_(root / (lease.job + "-" + std::to_string(lease.attempt))) {
    std::error_code error;
    fs::remove_all(folder_, error);
    if (!fs::create_directory(folder_, error))
      throw Error(ErrorCode::StorageFailed, "scratch", "cannot create a working folder: " + error.message());
  }
  ~Scratch() {
    std::error_code error;
    fs::remove_all(folder_, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& folder() const { return folder_; }

  std::string last_words() const {
    try {
      const Bytes bytes = read_whole_file(folder_ / "stderr.txt");
      const std::size_t length = std::min(bytes.size(), kStderrTail);
      return std::string(bytes.end() - static_cast<std::ptrdiff_t>(length), bytes.end());
    } catch (const Error&) {
      return {};
    }
  }

 private:
  fs::path folder_;
};

class Attempt {
 public:
  Attempt(const Job& job, Store& store, const AttemptOptions& options, AttemptState& state)
      : job_(job), store_(store), options_(options), state_(state), scratch_(store.scratch_folder(), state.lease()) {}

  Outcome run() {
    ChildProcess child(options_.command, scratch_.folder(), options_.limits);
    deadline_ = Steady::now() + std::chrono::seconds(options_.wall_s);
    child.send_line(encode_request(request()));
    std::vector<std::string> lines;
    bool open = true;
    while (open && !state_.lost) {
      lines.clear();
      open = child.read_lines(lines, kPoll);
      for (const std::string& line : lines) handle(line, child);
      if (!enforce(child)) break;
    }
    if (open) child.kill();
    return outcome(child.wait());
  }

 private:
  JobRequest request() const {
    JobRequest request{job_.kind, job_.options, job_.created_ms, options_.threads, {}};
    for (const auto& [role, id] : job_.inputs) {
      const std::optional<Input> input = store_.inputs.find(job_.tenant, id);
      if (!input) throw Error(ErrorCode::NotFound, "/" + role, "the " + role + " was deleted");
      request.inputs[role] = {fs::absolute(store_.artifacts.path_of(input->sha256)).string(), input->name,
                              input->fields};
    }
    return request;
  }

  void handle(const std::string& line, ChildProcess& child) {
    const std::optional<ChildEvent> event = decode_event(line);
    if (!event) return;
    switch (event->kind) {
      case ChildEvent::Kind::Progress: state_.set_progress(event->name, event->fraction); break;
      case ChildEvent::Kind::FindStage: {
        const auto file = store_.stages.find(StageStore::tenant_key(job_.tenant, event->name));
        child.send_line(encode_stage_reply(file ? std::optional(fs::absolute(*file).string()) : std::nullopt));
        break;
      }
      case ChildEvent::Kind::KeepStage: keep_stage(*event); break;
      case ChildEvent::Kind::Artifact: artifacts_.push_back(*event); break;
      case ChildEvent::Kind::Done:
      case ChildEvent::Kind::Failed: result_ = event; break;
    }
  }

  void keep_stage(const ChildEvent& event) {
    if (!is_plain_name(event.file)) return;
    std::vector<std::string> sources;
    for (const auto& [role, id] : job_.inputs) sources.push_back(id);
    try {
      store_.stages.add(StageStore::tenant_key(job_.tenant, event.name),
                        prepare_existing(scratch_.folder() / event.file), sources);
    } catch (const Error&) {
      // A stage that could not be kept is computed again next time.
    }
  }

  // False when the child was killed.
  bool enforce(ChildProcess& child) {
    const auto now = Steady::now();
    if (now > deadline_) {
      timed_out_ = true;
      return false;
    }
    if (state_.give_back) return false;
    if (!state_.cancel) return true;
    if (!asked_to_end_) {
      child.ask_to_end();
      asked_to_end_ = now;
    }
    return now < *asked_to_end_ + std::chrono::milliseconds(options_.cancel_grace_ms);
  }

  Outcome outcome(const ChildEnd& end) {
    Outcome outcome;
    // However its process ends after that: its files were whole before it said so.
    if (result_ && result_->kind == ChildEvent::Kind::Done && !state_.lost) return succeeded();
    if (state_.cancel) {
      outcome.kind = Outcome::Kind::Cancelled;
    } else if (state_.give_back || state_.lost) {
      interrupted(outcome);
    } else if (timed_out_ || end.signal == SIGXCPU || used_up_its_time(end)) {
      outcome.kind = Outcome::Kind::Failed;
      outcome.error = JobError{std::string(error_name(ErrorCode::TimedOut)), "job", time_message()};
    } else if (result_ && result_->kind == ChildEvent::Kind::Failed) {
      told(outcome);
    } else if (end.signal == SIGKILL) {
      interrupted(outcome);
    } else {
      crashed(outcome, end);
    }
    return outcome;
  }

  bool used_up_its_time(const ChildEnd& end) const {
    return end.signal == SIGKILL && options_.limits.cpu_s > 0 && end.cpu_s >= options_.limits.cpu_s;
  }

  std::string time_message() const {
    return timed_out_ ? "the job took longer than " + std::to_string(options_.wall_s) +
                            " s: choose a coarser preset or raise --job-wall-s"
                      : "the job used more than " + std::to_string(options_.limits.cpu_s) +
                            " s of processor time: choose a coarser preset or raise --job-cpu-s";
  }

  void interrupted(Outcome& outcome) const {
    outcome.kind = Outcome::Kind::Interrupted;
    outcome.error = JobError{std::string(error_name(ErrorCode::Crashed)), "job",
                             "its process was killed again and again: is the machine short of memory?"};
  }

  void told(Outcome& outcome) const {
    outcome.error = result_->error;
    const bool storage = outcome.error->code == error_name(ErrorCode::StorageFull) ||
                         outcome.error->code == error_name(ErrorCode::StorageFailed);
    outcome.kind = storage ? Outcome::Kind::Transient : Outcome::Kind::Failed;
  }

  void crashed(Outcome& outcome, const ChildEnd& end) const {
    outcome.kind = Outcome::Kind::Crashed;
    std::string how = end.signal != 0 ? std::string("ended by signal ") + std::to_string(end.signal) + " (" +
                                            ::strsignal(end.signal) + ")"
                                      : "ended without a result, exit code " + std::to_string(end.exit_code);
    const std::string words = scratch_.last_words();
    if (!words.empty()) how += "; last words: " + words;
    outcome.error = JobError{std::string(error_name(ErrorCode::Crashed)), "job", "the job's process " + how};
  }

  Outcome succeeded() {
    Outcome outcome;
    outcome.summary = result_->summary;
    outcome.timings = result_->timings;
    std::vector<PreparedBlob> blobs;
    for (const ChildEvent& artifact : artifacts_) {
      if (!is_plain_name(artifact.file) || !is_plain_name(artifact.name))
        throw Error(ErrorCode::Internal, "job", "the job named a file it may not name");
      blobs.push_back(prepare_existing(scratch_.folder() / artifact.file));
    }
    store_.artifacts.publish(blobs);
    for (std::size_t i = 0; i < blobs.size(); ++i)
      outcome.artifacts.push_back({artifacts_[i].name, artifacts_[i].content_type, std::move(blobs[i])});
    return outcome;
  }

  const Job& job_;
  Store& store_;
  const AttemptOptions& options_;
  AttemptState& state_;
  Scratch scratch_;
  Steady::time_point deadline_;
  std::optional<Steady::time_point> asked_to_end_;
  bool timed_out_ = false;
  std::vector<ChildEvent> artifacts_;
  std::optional<ChildEvent> result_;
};

}  // namespace

void AttemptState::set_progress(const std::string& stage, double progress) {
  const std::lock_guard lock(lock_);
  stage_ = stage.substr(0, 100);
  progress_ = std::clamp(progress, 0.0, 1.0);
}

ProgressReport AttemptState::progress() const {
  const std::lock_guard lock(lock_);
  return {lease_, stage_, progress_};
}

Outcome make_attempt(const Job& job, Store& store, const AttemptOptions& options, AttemptState& state) {
  // The outcome's files lie in the scratch folder but are also linked in the store: they outlive the attempt.
  return Attempt(job, store, options, state).run();
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/run_job.h"

#include <cerrno>
#include <fstream>
#include <istream>
#include <mutex>
#include <new>
#include <set>

#include <unistd.h>

#include "jobs/store/durable_file.h"
#include "jobs/worker/child_protocol.h"

namespace toile {

namespace {

// The wire to the worker. Messages of several threads do not mix.
class Wire {
 public:
  Wire(std::istream& requests, int events) : requests_(requests), events_(events) {}

  void send(const ChildEvent& event) {
    const std::lock_guard lock(lock_);
    write(encode_event(event) + "\n");
  }

  std::optional<std::string> ask_for_stage(const std::string& key) {
    const std::lock_guard lock(lock_);
    ChildEvent event;
    event.kind = ChildEvent::Kind::FindStage;
    event.name = key;
    write(encode_event(event) + "\n");
    std::string line;
    if (!std::getline(requests_, line)) throw Error(ErrorCode::Cancelled, "worker", "the worker is gone");
    return decode_stage_reply(line);
  }

  std::string read_line() {
    std::string line;
    std::getline(requests_, line);
    return line;
  }

 private:
  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::write(events_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw Error(ErrorCode::Cancelled, "worker", "the worker is gone");
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  std::mutex lock_;
  std::istream& requests_;
  int events_;
};

void write_file(const std::string& name, const Bytes& bytes) {
  std::ofstream out(name, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw Error(ErrorCode::StorageFull, "scratch", "cannot write a result: is the disk full?");
}

// The worker's stages, over the wire. Losing one costs time, not truth.
class RemoteStages : public StageCache {
 public:
  explicit RemoteStages(Wire& wire) : wire_(wire) {}

  std::optional<Bytes> get(const std::string& key) override {
    const std::optional<std::string> file = wire_.ask_for_stage(key);
    if (!file) return std::nullopt;
    try {
      return read_whole_file(*file);
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  void put(const std::string& key, const Bytes& value) override {
    const std::string file = "stage-" + std::to_string(++count_);
    try {
      write_file(file, value);
    } catch (const Error&) {
      return;
    }
    ChildEvent event;
    event.kind = ChildEvent::Kind::KeepStage;
    event.name = key;
    event.file = file;
    wire_.send(event);
  }

 private:
  Wire& wire_;
  std::atomic<int> count_{0};
};

class ArtifactWriter {
 public:
  explicit ArtifactWriter(Wire& wire) : wire_(wire) {}

  void operator()(const std::string& name, const std::string& content_type, const Bytes& bytes) {
    const std::lock_guard lock(lock_);
    if (!is_plain_name(name) || !names_.insert(name).second)
      throw Error(ErrorCode::Internal, name, "a job made an artifact of a bad or a used name");
    ChildEvent event;
    event.kind = ChildEvent::Kind::Artifact;
    event.name = name;
    event.content_type = content_type;
    event.file = "artifact-" + std::to_string(names_.size());
    write_file(event.file, bytes);
    wire_.send(event);
  }

 private:
  Wire& wire_;
  std::mutex lock_;
  std::set<std::string> names_;
};

JobReport run(const JobHandlers& handlers, Wire& wire, const std::atomic<bool>& cancelled) {
  const JobRequest request = decode_request(wire.read_line());
  const auto handler = handlers.find(request.kind);
  if (handler == handlers.end())
    throw Error(ErrorCode::BadUsage, "/kind", "this server does not know the kind of job '" + request.kind + "'");
  RemoteStages stages(wire);
  ArtifactWriter writer(wire);
  Progress progress;
  progress.cancelled = &cancelled;
  progress.report = [&](std::string_view stage, double fraction) {
    ChildEvent event;
    event.name = stage;
    event.fraction = fraction;
    wire.send(event);
  };
  JobContext context;
  context.options = request.options;
  context.created_ms = request.created_ms;
  context.threads = request.threads;
  context.artifact = std::ref(writer);
  context.stages = &stages;
  context.progress = &progress;
  for (const auto& [role, input] : request.inputs)
    context.inputs[role] = {input.name, input.fields, read_whole_file(input.file)};
  return handler->second(context);
}

ChildEvent failure(ErrorCode code, const std::string& subject, const std::string& message) {
  ChildEvent event;
  event.kind = ChildEvent::Kind::Failed;
  event.error = {std::string(error_name(code)), subject, message};
  return event;
}

ChildEvent result_of(const JobHandlers& handlers, Wire& wire, const std::atomic<bool>& cancelled) {
  try {
    const JobReport report = run(handlers, wire, cancelled);
    ChildEvent event;
    event.kind = ChildEvent::Kind::Done;
    event.summary = report.summary;
    event.timings = report.timings;
    return event;
  } catch (const Error& error) {
    return failure(error.code, error.subject, error.message);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::ResourceLimit, "memory",
                   "the job needed more memory than one job may use: lower `triangles` or raise --job-memory-mb");
  } catch (const std::exception& error) {
    return failure(ErrorCode::Internal, "job", error.what());
  }
}

}  // namespace

int run_job(const JobHandlers& handlers, std::istream& requests, int events, const std::atomic<bool>& cancelled) {
  Wire wire(requests, events);
  const ChildEvent result = result_of(handlers, wire, cancelled);
  try {
    wire.send(result);
  } catch (const Error&) {
    return 70;  // nobody listens any more
  }
  return 0;
}

}  // namespace toile

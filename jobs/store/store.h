// SPDX-License-Identifier: GPL-3.0-or-later
// Everything a data folder holds, opened together:
//   toile.db (and its -wal, -shm)   rows           blobs/   files named by content
//   tmp/   files being written                     scratch/ working folders of running jobs
#pragma once

#include "jobs/store/input_store.h"
#include "jobs/store/job_queue.h"
#include "jobs/store/job_reader.h"
#include "jobs/store/removal.h"
#include "jobs/store/stage_store.h"
#include "jobs/store/webhook_queue.h"

namespace toile {

struct WorkerStatus {
  std::string name;
  std::int64_t seen_ms = 0;
  int slots = 0;
  int running = 0;
};

class Store {
 public:
  // Creates what is missing. Throws Error{StorageFailed} when the folder cannot be used or the database is damaged.
  Store(const std::filesystem::path& data, QueueOptions options, Clock clock = system_clock_ms);

  const std::filesystem::path data;
  const Clock clock;
  Database database;
  ArtifactStore artifacts;
  InputStore inputs;
  JobQueue queue;
  JobReader jobs;
  StageStore stages;
  Removal removal;
  WebhookQueue webhooks;

  std::filesystem::path scratch_folder() const { return data / "scratch"; }
  std::int64_t free_bytes() const;

  // Workers say that they live; readiness asks for it.
  void note_worker(const WorkerStatus& status);
  void forget_worker(const std::string& name);
  std::vector<WorkerStatus> workers();
};

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Settings of `toile serve` and `toile work`: each a flag, an environment variable TOILE_... and a line of the --config
// file. The table in server/README.md lists them all.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "jobs/worker/sweeper.h"

namespace toile::app {

struct WorkSettings {
  std::string config;  // file with settings; empty: none
  std::string data = "toile-data";
  int workers = 0;  // jobs at a time; 0: one per processor core and job thread
  int job_threads = 1;
  std::int64_t job_memory_mb = 4096;
  int job_cpu_s = 3600;
  int job_wall_s = 7200;
  int lease_s = 30;
  int drain_s = 25;
  int retention_days = 30;  // 0: for ever
  std::int64_t stage_cache_mb = 4096;
  std::int64_t max_queued = 10000;
};

struct ServeSettings {
  std::string host = "127.0.0.1";
  int port = 8080;
  std::string port_file;  // gets the port, once the server listens
  std::string api_keys_file;
  int http_threads = 32;
  std::int64_t max_upload_mb = 64;
  std::int64_t min_free_mb = 512;
  int max_wait_s = 60;
  std::string webhook_secret_file;
  bool webhook_private = false;
  bool demo = false;
};

// Both commands then call apply_config_file: what flags and variables leave open comes from there.
void add_work_settings(CLI::App& command, WorkSettings& settings);
void add_serve_settings(CLI::App& command, ServeSettings& settings);

QueueOptions queue_options(const WorkSettings& settings);
WorkerPoolOptions worker_options(const WorkSettings& settings);
SweepOptions sweep_options(const WorkSettings& settings);

}  // namespace toile::app

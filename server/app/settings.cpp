// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/settings.h"

#include <algorithm>
#include <thread>

namespace toile::app {

namespace {

template <class T>
const char* kind_of(const std::string& name) {
  if (std::is_integral_v<T>) return "NUMBER";
  return name == "--data" ? "FOLDER" : name == "--host" ? "ADDRESS" : "FILE";
}

template <class T>
CLI::Option* setting(CLI::App& command, const std::string& name, T& value, const std::string& meaning) {
  std::string variable = "TOILE_" + name.substr(2);
  std::transform(variable.begin(), variable.end(), variable.begin(), [](char c) {
    return c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  });
  if constexpr (std::is_same_v<T, bool>)
    return command.add_flag(name, value, meaning)->envname(variable);
  else
    return command.add_option(name, value, meaning)
        ->type_name(kind_of<T>(name))
        ->envname(variable)
        ->capture_default_str();
}

}  // namespace

void add_work_settings(CLI::App& command, WorkSettings& settings) {
  setting(command, "--config", settings.config, "File with settings, one `name = value` a line");
  setting(command, "--data", settings.data, "Folder that keeps everything: jobs, bodies, garments, results");
  setting(command, "--workers", settings.workers, "Jobs worked on at a time; 0: one for each processor core")
      ->check(CLI::Range(0, 256));
  setting(command, "--job-threads", settings.job_threads, "Processor cores that one job may use")
      ->check(CLI::Range(1, 256));
  setting(command, "--job-memory-mb", settings.job_memory_mb, "Most memory of one job, in MiB; 0: no limit")
      ->check(CLI::Range(0, 1 << 24));
  setting(command, "--job-cpu-s", settings.job_cpu_s, "Most processor seconds of one job; 0: no limit")
      ->check(CLI::Range(0, 1 << 24));
  setting(command, "--job-wall-s", settings.job_wall_s, "Most seconds from start to end of one job")
      ->check(CLI::Range(1, 1 << 24));
  setting(command, "--lease-s", settings.lease_s,
          "Seconds after which a worker that gives no sign of life loses its job to another")
      ->check(CLI::Range(2, 3600));
  setting(command, "--drain-s", settings.drain_s,
          "Seconds that running jobs get to end when the server stops; later they begin anew")
      ->check(CLI::Range(0, 3600));
  setting(command, "--retention-days", settings.retention_days, "Days for which ended jobs are kept; 0: for ever")
      ->check(CLI::Range(0, 36500));
  setting(command, "--stage-cache-mb", settings.stage_cache_mb,
          "Most disk space for finished steps kept for reuse, in MiB")
      ->check(CLI::Range(0, 1 << 24));
  setting(command, "--max-queued", settings.max_queued, "Most jobs that may wait; a further one is refused (429)")
      ->check(CLI::Range(1, 1 << 24));
}

void add_serve_settings(CLI::App& command, ServeSettings& settings) {
  setting(command, "--host", settings.host, "Address to listen on; 0.0.0.0: every one of this machine");
  setting(command, "--port", settings.port, "Port to listen on; 0: a free one")->check(CLI::Range(0, 65535));
  setting(command, "--port-file", settings.port_file, "File into which the port is written once the server listens");
  setting(command, "--api-keys", settings.api_keys_file,
          "File with one `TENANT SHA256-OF-KEY` a line; without it everybody may come in");
  setting(command, "--http-threads", settings.http_threads, "Requests answered at a time")->check(CLI::Range(4, 512));
  setting(command, "--max-upload-mb", settings.max_upload_mb, "Largest body or garment taken, in MiB")
      ->check(CLI::Range(1, 1024));
  setting(command, "--min-free-mb", settings.min_free_mb,
          "Free disk space below which nothing new is taken (507), in MiB")
      ->check(CLI::Range(0, 1 << 24));
  setting(command, "--max-wait-s", settings.max_wait_s, "Most seconds for which `Prefer: wait` waits")
      ->check(CLI::Range(0, 600));
  setting(command, "--webhook-secret", settings.webhook_secret_file,
          "File with the secret that signs webhooks; without it none are sent");
  setting(command, "--webhook-private", settings.webhook_private,
          "Let webhooks go to addresses of this machine and its network");
  setting(command, "--demo", settings.demo, "Store a garment and bodies at start, and print lines to try");
}

QueueOptions queue_options(const WorkSettings& settings) {
  QueueOptions options;
  options.lease_ms = settings.lease_s * 1000LL;
  options.max_queued = settings.max_queued;
  options.engine_version = TOILE_VERSION;
  return options;
}

WorkerPoolOptions worker_options(const WorkSettings& settings) {
  WorkerPoolOptions options;
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  options.workers = settings.workers > 0 ? settings.workers : std::max(1, cores / settings.job_threads);
  options.lease_ms = settings.lease_s * 1000LL;
  options.heartbeat_ms = std::min<std::int64_t>(5000, options.lease_ms / 6);
  options.drain_ms = settings.drain_s * 1000LL;
  options.attempt.command = {"/proc/self/exe", "run-job"};
  options.attempt.limits.memory_bytes = settings.job_memory_mb << 20;
  options.attempt.limits.cpu_s = settings.job_cpu_s;
  options.attempt.wall_s = settings.job_wall_s;
  options.attempt.threads = settings.job_threads;
  return options;
}

SweepOptions sweep_options(const WorkSettings& settings) {
  SweepOptions options;
  options.retention_days = settings.retention_days;
  options.stage_bytes = settings.stage_cache_mb << 20;
  return options;
}

}  // namespace toile::app

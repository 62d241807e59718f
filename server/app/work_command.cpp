// SPDX-License-Identifier: GPL-3.0-or-later
#include <thread>

#include "server/app/command.h"
#include "server/app/config_file.h"
#include "server/app/json_log.h"
#include "server/app/settings.h"

namespace toile::app {

namespace {

void work(const WorkSettings& settings, const std::atomic<bool>& stop) {
  const EventLog log = json_log();
  Store store(settings.data, queue_options(settings));
  WorkerPool pool(store, worker_options(settings), log);
  log("worker_started", {{"data", settings.data}});
  while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  log("draining", {});
  pool.drain();
  log("stopped", {});
}

}  // namespace

void add_work_command(CLI::App& app, Context& context) {
  const auto settings = std::make_shared<WorkSettings>();
  CLI::App* command =
      app.add_subcommand("work", "Work off jobs of a server from a process of its own, in the same --data");
  add_work_settings(*command, *settings);
  command->callback([command, settings, &context] {
    apply_config_file(*command, settings->config);
    work(*settings, *context.progress.cancelled);
  });
}

}  // namespace toile::app

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <thread>

#include "jobs/worker/inspection.h"
#include "jobs/worker/sweeper.h"
#include "server/app/command.h"
#include "server/app/config_file.h"
#include "server/app/demo.h"
#include "server/app/engine_jobs.h"
#include "server/app/files.h"
#include "server/app/job_kinds.h"
#include "server/app/json_log.h"
#include "server/app/settings.h"
#include "server/http/library_server.h"
#include "server/http/openapi_text.h"
#include "server/http/service.h"
#include "server/http/webhook_sender.h"

namespace toile::app {

namespace {

std::string text_of_file(const std::string& path) {
  const Bytes bytes = read_file(path);
  return std::string(bytes.begin(), bytes.end());
}

http::ServiceOptions service_options(const ServeSettings& settings) {
  http::ServiceOptions options;
  options.max_upload_bytes = settings.max_upload_mb << 20;
  options.min_free_bytes = settings.min_free_mb << 20;
  options.max_wait_s = settings.max_wait_s;
  options.max_waiting = std::max(1, settings.http_threads * 3 / 8);
  options.max_uploads = std::max(1, settings.http_threads / 4);
  options.kinds.clear();
  for (const auto& [kind, handler] : job_kinds()) options.kinds.insert(kind);
  return options;
}

http::HubLimits hub_limits(const ServeSettings& settings) {
  http::HubLimits limits;
  limits.workers = settings.http_threads;
  return limits;
}

void tell_port(const ServeSettings& settings, int port) {
  if (settings.port_file.empty()) return;
  const std::string line = std::to_string(port) + "\n";
  write_file(settings.port_file, Bytes(line.begin(), line.end()));
}

// Uploads get less than jobs do: an import is a matter of seconds.
AttemptOptions inspection_options(const WorkSettings& work) {
  constexpr int kSeconds = 60;
  AttemptOptions options = worker_options(work).attempt;
  options.limits.memory_bytes = std::min<std::int64_t>(options.limits.memory_bytes, 2LL << 30);
  options.limits.cpu_s = kSeconds;
  options.wall_s = kSeconds;
  return options;
}

http::InputInspector inspector(Store& store, const WorkSettings& work) {
  return [&store, options = inspection_options(work)](InputKind kind, const std::string& name,
                                                      const std::string& fields, const std::filesystem::path& file) {
    JobRequest request;
    request.kind = "inspect_" + std::string(kind_name(kind));
    request.options = "{}";
    request.inputs["input"] = {std::filesystem::absolute(file).string(), name, fields};
    return inspect_in_child(store, request, options);
  };
}

// Wires what the endpoints leave to the application.
void equip(http::Service& service, const WorkSettings& work, const ServeSettings& settings) {
  service.inspect = inspector(service.store, work);
  service.check_options = complete_options;
  service.openapi = http::openapi_text();
  service.check_webhook = [&settings](const std::string& url) {
    if (settings.webhook_secret_file.empty())
      throw Error(ErrorCode::OptionInvalid, "/webhook", "webhooks are off: the server needs --webhook-secret");
    http::check_webhook_url(url, settings.webhook_private);
  };
}

std::unique_ptr<http::WebhookSender> webhook_sender(http::Service& service, const ServeSettings& settings) {
  if (settings.webhook_secret_file.empty()) return nullptr;
  http::WebhookOptions options;
  options.secret = http::webhook_key(text_of_file(settings.webhook_secret_file));
  options.private_hosts = settings.webhook_private;
  return std::make_unique<http::WebhookSender>(service, options);
}

void tell_demo(Store& store, const std::string& url) {
  std::printf("# Try these in another terminal:\n%s", store_demo(store, url).c_str());
  std::fflush(stdout);
}

void serve(const WorkSettings& work, const ServeSettings& settings, const std::atomic<bool>& stop) {
  const EventLog log = json_log();
  const http::ApiKeys keys =
      settings.api_keys_file.empty() ? http::ApiKeys() : http::ApiKeys::parse(text_of_file(settings.api_keys_file));
  Store store(work.data, queue_options(work));
  http::Service service(store, service_options(settings), keys, log);
  equip(service, work, settings);
  http::LibraryServer server(
      hub_limits(settings), [&](http::Request& request) { return service.answer(request); },
      [&](const http::Problem& problem, const std::string& remote) {
        service.metrics.count_refusal(problem.code);
        log("refused", {{"code", problem.code}, {"status", std::to_string(problem.status)}, {"remote", remote}});
      });
  const int port = server.bind(settings.host, settings.port);  // connections queue up from here on
  const std::string url = "http://" + settings.host + ":" + std::to_string(port);
  tell_port(settings, port);
  if (settings.demo) tell_demo(store, url);
  WorkerPool pool(store, worker_options(work), log);
  const Sweeper sweeper(store, sweep_options(work), log);
  const auto webhooks = webhook_sender(service, settings);
  std::thread listener([&] { server.run(); });
  log("listening", {{"url", url}, {"data", work.data}});
  while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  log("draining", {});
  service.stopping = true;
  server.stop();
  listener.join();
  pool.drain();
  log("stopped", {});
}

}  // namespace

void add_serve_command(CLI::App& app, Context& context) {
  const auto work = std::make_shared<WorkSettings>();
  const auto settings = std::make_shared<ServeSettings>();
  CLI::App* command = app.add_subcommand("serve", "Answer over HTTP and work off jobs; all is kept in --data");
  add_work_settings(*command, *work);
  add_serve_settings(*command, *settings);
  command->callback([command, work, settings, &context] {
    apply_config_file(*command, work->config);
    serve(*work, *settings, *context.progress.cancelled);
  });
}

}  // namespace toile::app

// SPDX-License-Identifier: GPL-3.0-or-later
// Alive, ready, measured, which version, which interface. Open to all: monitors carry no keys.
#include <sstream>

#include <nlohmann/json.hpp>

#include "engine/io/schema_texts.h"
#include "server/http/documents.h"
#include "server/http/service.h"

namespace toile::http {

using nlohmann::ordered_json;

namespace {

constexpr std::int64_t kWorkerSilenceMs = 30000;

bool database_answers(Service& service) {
  try {
    service.store.jobs.counts();
    return true;
  } catch (const Error&) {
    return false;
  }
}

int living_workers(Service& service) {
  int count = 0;
  for (const WorkerStatus& worker : service.store.workers())
    if (service.store.clock() - worker.seen_ms < kWorkerSilenceMs) ++count;
  return count;
}

Response ready(Service& service) {
  const bool database = database_answers(service);
  const bool disk = service.store.free_bytes() >= service.options.min_free_bytes;
  const bool worker = database && living_workers(service) > 0;
  const bool ok = database && disk && worker && !service.stopping;
  return json_response(ok ? 200 : 503, text_of({{"ready", ok},
                                                {"database", database},
                                                {"disk", disk},
                                                {"worker", worker},
                                                {"stopping", service.stopping.load()}}));
}

Response metrics(Service& service) {
  const QueueCounts counts = service.store.jobs.counts();
  std::ostringstream out;
  out << "# HELP toile_jobs Jobs by state.\n# TYPE toile_jobs gauge\n";
  for (const JobState state :
       {JobState::Queued, JobState::Running, JobState::Succeeded, JobState::Failed, JobState::Cancelled}) {
    const auto found = counts.jobs.find(state);
    out << "toile_jobs{state=\"" << state_name(state) << "\"} " << (found == counts.jobs.end() ? 0 : found->second)
        << '\n';
  }
  const double wait = counts.oldest_queued_ms == 0
                          ? 0.0
                          : static_cast<double>(service.store.clock() - counts.oldest_queued_ms) / 1000.0;
  out << "# HELP toile_queue_oldest_seconds Age of the longest waiting job.\n# TYPE toile_queue_oldest_seconds gauge\n"
      << "toile_queue_oldest_seconds " << wait << '\n'
      << "# HELP toile_workers Worker processes alive.\n# TYPE toile_workers gauge\ntoile_workers "
      << living_workers(service) << '\n'
      << "# HELP toile_free_bytes Free space of the data folder.\n# TYPE toile_free_bytes gauge\ntoile_free_bytes "
      << service.store.free_bytes() << '\n';
  Response response;
  response.content_type = "text/plain; version=0.0.4";
  response.body = out.str() + service.metrics.text();
  return response;
}

Response openapi(const Service& service) {
  Response response;
  response.content_type = "application/yaml";
  response.body = service.openapi;
  return response;
}

Response schema(const Request& request) {
  constexpr std::string_view kEnding = ".schema.json";
  const std::string& file = request.path_value("file");
  for (const SchemaText& text : schema_texts()) {
    if (file != std::string(text.name) + std::string(kEnding)) continue;
    Response response;
    response.content_type = "application/schema+json";
    response.body = text.text;
    return response;
  }
  throw Problem{404, "not_found", "there is no schema of this name", {}, {}};
}

}  // namespace

void add_system_routes(Service& service) {
  const auto open = [&](const std::string& path, Handler handler) {
    service.router.add({"GET", path, std::move(handler), true});
  };
  open("/healthz", [](Request&) { return json_response(200, R"({"alive":true})"); });
  open("/readyz", [&service](Request&) { return ready(service); });
  open("/metrics", [&service](Request&) { return metrics(service); });
  open("/version", [&service](Request&) {
    return json_response(200, text_of({{"name", "toile"}, {"version", service.options.version}}));
  });
  open("/schemas/{file}", [](Request& request) { return schema(request); });
  open("/openapi.yaml", [&service](Request&) { return openapi(service); });
}

}  // namespace toile::http

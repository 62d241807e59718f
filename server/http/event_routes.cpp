// SPDX-License-Identifier: GPL-3.0-or-later
// A job's events: server-sent, or by long poll. Each event carries the whole job, its id is the job's version: a client
// that comes back with Last-Event-ID gets what changed since, however much it missed.
#include <charconv>

#include <nlohmann/json.hpp>

#include "server/http/documents.h"
#include "server/http/waiting.h"

namespace toile::http {

namespace {

constexpr double kSilence = 15.0;       // seconds after which a comment keeps the connection open
constexpr double kLongest = 15 * 60.0;  // seconds of one stream; clients come back by themselves

int last_event(const Request& request) {
  std::string text = request.header("Last-Event-ID");
  if (text.empty()) text = request.parameter("last_event_id").value_or("0");
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string event_text(const Job& job) {
  return "id: " + std::to_string(job.version) + "\nevent: " + std::string(state_name(job.state)) +
         "\ndata: " + text_of(job_document(job)) + "\n\n";
}

void stream_events(Service& service, const std::string& tenant, const std::string& id, int seen,
                   const StreamSink& sink) {
  const Seat seat(service.waiting, service.options.max_waiting);
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(kLongest);
  if (!seat || !sink("retry: 1000\n\n")) return;
  try {
    while (!service.stopping && std::chrono::steady_clock::now() < until) {
      const Job job = wait_for_job(service, tenant, id, kSilence, [&](const Job& now) { return now.version > seen; });
      if (job.version <= seen) {
        if (!sink(": waiting\n\n")) return;
        continue;
      }
      seen = job.version;
      if (!sink(event_text(job)) || is_final(job.state)) return;
    }
  } catch (const Problem&) {
    sink("event: deleted\ndata: {}\n\n");
  }
}

Response events(Service& service, const Request& request) {
  const std::string tenant = request.tenant, id = request.path_value("id");
  const int seen = last_event(request);
  if (!service.store.jobs.find(tenant, id)) throw not_found("job");
  if (request.parameter("wait")) {
    const Job job = wait_for_job(service, tenant, id, wait_seconds(service, request),
                                 [&](const Job& now) { return now.version > seen || is_final(now.state); });
    return json_response(200,
                         text_of({{"id", job.version}, {"event", state_name(job.state)}, {"data", job_document(job)}}));
  }
  // A stream takes one place for itself and one for its looking: refuse early rather than end at once.
  if (service.waiting.load() + 2 > service.options.max_waiting)
    throw Problem{503, "busy", "too many event streams are open; poll with ?wait=30", {}, {{"Retry-After", "5"}}};
  Response response;
  response.content_type = "text/event-stream";
  response.with("Cache-Control", "no-store");
  response.stream = [&service, tenant, id, seen](const StreamSink& sink) {
    stream_events(service, tenant, id, seen, sink);
  };
  return response;
}

}  // namespace

void add_event_routes(Service& service) {
  service.router.add({"GET", "/v1/jobs/{id}/events", [&service](Request& r) { return events(service, r); }});
}

}  // namespace toile::http

// SPDX-License-Identifier: GPL-3.0-or-later
// POST, GET, DELETE of jobs.
#include <nlohmann/json.hpp>

#include "server/http/documents.h"
#include "server/http/idempotency.h"
#include "server/http/job_request.h"
#include "server/http/waiting.h"

namespace toile::http {

namespace {

Response job_response(int status, const Job& job) {
  const nlohmann::ordered_json document = job_document(job);
  Response response = json_response(status, text_of(document)).with("Location", document["links"]["self"]);
  if (!is_final(job.state)) response.with("Retry-After", "1");
  return response;
}

// Waits if the client prefers so; 202 while the job is not done.
Response accepted(Service& service, const Request& request, const std::string& id) {
  const int seconds = wait_seconds(service, request);
  const Job job =
      wait_for_job(service, request.tenant, id, seconds, [](const Job& seen) { return is_final(seen.state); });
  Response response = job_response(is_final(job.state) ? 200 : 202, job);
  if (seconds > 0) response.with("Preference-Applied", "wait=" + std::to_string(seconds));
  return response;
}

Response create_job(Service& service, Request& request) {
  refuse_when_disk_is_low(service);
  std::string raw;
  const nlohmann::json document = read_json(request, service.options.max_document_bytes, &raw);
  const Idempotency idempotency(service, request, raw);
  if (idempotency.remembered()) return accepted(service, request, idempotency.remembered()->resource);
  const NewJob job = read_job_request(service, request.tenant, document);
  std::string id;
  {
    Transaction transaction(service.store.database);
    id = service.store.queue.enqueue(transaction, job);
    idempotency.remember(transaction, 202, id);
    transaction.commit();
  }
  service.store.queue.announce_work();
  return accepted(service, request, id);
}

Response show_job(Service& service, const Request& request) {
  const auto job = service.store.jobs.find(request.tenant, request.path_value("id"));
  if (!job) throw not_found("job");
  const std::string tag = quoted_tag(std::to_string(job->version));
  if (request.header("If-None-Match") == tag) {
    Response response;
    response.status = 304;
    return response.with("ETag", tag);
  }
  Response response = json_response(200, text_of(job_document(*job))).with("ETag", tag);
  if (!is_final(job->state)) response.with("Retry-After", "1");
  return response;
}

Response list_jobs(Service& service, const Request& request) {
  const Page page = page_of(request, {"label", "state"});
  JobFilter filter;
  if (const auto state = request.parameter("state")) filter.state = state_of_name(*state);
  filter.label = request.parameter("label");
  filter.before = page.before;
  filter.limit = page.limit;
  const auto jobs = service.store.jobs.list(request.tenant, filter);
  nlohmann::ordered_json items = nlohmann::ordered_json::array();
  for (const Job& job : jobs) items.push_back(job_document(job));
  return json_response(200, list_document(std::move(items), next_link(request, jobs.size(), page.limit,
                                                                      jobs.empty() ? 0 : jobs.back().sequence)));
}

Response cancel(Service& service, const Request& request) {
  const std::string& id = request.path_value("id");
  service.store.queue.cancel(request.tenant, id);
  constexpr double kPatience = 1.5;  // a running job ends within a second
  const Job job =
      wait_for_job(service, request.tenant, id, kPatience, [](const Job& seen) { return is_final(seen.state); });
  return job_response(is_final(job.state) ? 200 : 202, job);
}

}  // namespace

void add_job_routes(Service& service) {
  service.router.add({"POST", "/v1/jobs", [&service](Request& r) { return create_job(service, r); }});
  service.router.add({"GET", "/v1/jobs", [&service](Request& r) { return list_jobs(service, r); }});
  service.router.add({"GET", "/v1/jobs/{id}", [&service](Request& r) { return show_job(service, r); }});
  service.router.add({"DELETE", "/v1/jobs/{id}", [&service](Request& r) { return cancel(service, r); }});
}

}  // namespace toile::http

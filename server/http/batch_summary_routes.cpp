// SPDX-License-Identifier: GPL-3.0-or-later
// What a batch came to, as a table and as a page.
#include <nlohmann/json.hpp>

#include "server/http/batch_report.h"
#include "server/http/documents.h"
#include "server/http/service.h"

namespace toile::http {

namespace {

BatchRowStatus status_of(JobState state) {
  switch (state) {
    case JobState::Queued: return BatchRowStatus::Queued;
    case JobState::Running: return BatchRowStatus::Running;
    case JobState::Succeeded: return BatchRowStatus::Done;
    case JobState::Failed: return BatchRowStatus::Failed;
    case JobState::Cancelled: return BatchRowStatus::Cancelled;
  }
  return BatchRowStatus::Queued;
}

std::map<std::string, double> fit_of(const Job& job) {
  std::map<std::string, double> fit;
  if (!job.summary) return fit;
  const auto summary = nlohmann::json::parse(*job.summary, nullptr, false);
  if (!summary.is_object() || !summary.contains("fit") || !summary["fit"].is_object()) return fit;
  for (const auto& [zone, value] : summary["fit"].items())
    if (value.is_number()) fit[zone] = value.get<double>();
  return fit;
}

std::string name_of(const Service& service, const std::string& tenant, InputKind kind, const std::string& id) {
  const auto input = service.store.inputs.find(tenant, kind, id);
  return input && !input->name.empty() ? input->name : id;
}

BatchRow row_of(const Service& service, const Job& job) {
  BatchRow row;
  row.id = job.inputs.at("target_body");
  row.body = name_of(service, job.tenant, InputKind::Body, row.id);
  row.status = status_of(job.state);
  if (job.state == JobState::Succeeded) row.link = "../../jobs/" + job.id + "/artifacts/report.html";
  if (job.error) row.error = job.error->code + ": " + job.error->message;
  row.fit = fit_of(job);
  return row;
}

// Oldest first, as the bodies were given.
std::vector<BatchRow> rows_of(const Service& service, const Batch& batch) {
  JobFilter filter;
  filter.batch = batch.id;
  filter.limit = service.options.max_batch;
  const std::vector<Job> jobs = service.store.jobs.list(batch.tenant, filter);
  std::vector<BatchRow> rows;
  for (auto job = jobs.rbegin(); job != jobs.rend(); ++job) rows.push_back(row_of(service, *job));
  return rows;
}

Batch batch_of(const Service& service, const Request& request) {
  const auto batch = find_batch(service.store.database, request.tenant, request.path_value("id"));
  if (!batch) throw not_found("batch");
  return *batch;
}

Response table(const Service& service, const Request& request) {
  Response response;
  response.content_type = "text/csv; charset=utf-8";
  response.body = batch_csv(rows_of(service, batch_of(service, request)));
  return response;
}

Response page(const Service& service, const Request& request) {
  const Batch batch = batch_of(service, request);
  Response response;
  response.content_type = "text/html; charset=utf-8";
  // Names in it are strangers' words: no script may run in this server's name.
  response.with("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'");
  response.body =
      batch_html(name_of(service, batch.tenant, InputKind::Garment, batch.garment), rows_of(service, batch));
  return response;
}

}  // namespace

void add_batch_summary_routes(Service& service) {
  service.router.add({"GET", "/v1/batches/{id}/summary.csv", [&service](Request& r) { return table(service, r); }});
  service.router.add({"GET", "/v1/batches/{id}/summary.html", [&service](Request& r) { return page(service, r); }});
}

}  // namespace toile::http

// SPDX-License-Identifier: GPL-3.0-or-later
// One garment on many bodies: POST, GET of batches, with counts, the fit matrix and the worst cases.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "server/http/documents.h"
#include "server/http/idempotency.h"
#include "server/http/job_request.h"

namespace toile::http {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::size_t kWorstCases = 10;

// The ids in `target_bodies`, or the bodies that carry `label`, oldest first.
std::vector<std::string> bodies_of(const Service& service, const std::string& tenant, const json& document) {
  const std::size_t most = static_cast<std::size_t>(service.options.max_batch);
  std::vector<std::string> ids;
  if (document.contains("target_bodies") == document.contains("label"))
    throw invalid("/target_bodies", "give either `target_bodies` (a list of ids) or `label`");
  if (document.contains("label")) {
    const auto found = service.store.inputs.list(tenant, InputKind::Body,
                                                 {required_text(document, "label"), 0, service.options.max_batch + 1});
    for (const Input& input : found) ids.push_back(input.id);
    std::reverse(ids.begin(), ids.end());
    if (ids.empty()) throw invalid("/label", "no body carries this label");
  } else {
    if (!document["target_bodies"].is_array() || document["target_bodies"].empty())
      throw invalid("/target_bodies", "a list of at least one body id");
    for (std::size_t i = 0; i < document["target_bodies"].size(); ++i) {
      const json& id = document["target_bodies"][i];
      const std::string pointer = "/target_bodies/" + std::to_string(i);
      if (!id.is_string() || !service.store.inputs.find(tenant, InputKind::Body, id))
        throw invalid(pointer, "no body with this id: upload it first");
      ids.push_back(id);
    }
  }
  if (ids.size() > most)
    throw invalid("/target_bodies", "a batch has at most " + std::to_string(most) + " bodies: split it");
  return ids;
}

struct BatchRequest {
  Batch batch;
  std::optional<std::string> worn;
  std::vector<std::string> bodies;
  std::optional<std::string> webhook;
};

BatchRequest read_batch(const Service& service, const std::string& tenant, const json& document) {
  require_schema(document, "batch_request");
  BatchRequest request;
  request.batch.tenant = tenant;
  request.batch.garment = required_text(document, "garment");
  if (!service.store.inputs.find(tenant, InputKind::Garment, request.batch.garment))
    throw invalid("/garment", "no garment with this id: upload it first");
  if (document.contains("worn")) {
    request.worn = required_text(document, "worn");
    if (!service.store.inputs.find(tenant, InputKind::Garment, *request.worn))
      throw invalid("/worn", "no garment with this id: upload it first");
  }
  request.batch.reference_body = required_text(document, "reference_body");
  if (!service.store.inputs.find(tenant, InputKind::Body, *request.batch.reference_body))
    throw invalid("/reference_body", "no body with this id: upload it first");
  request.bodies = bodies_of(service, tenant, document);
  request.batch.options = read_options(service, "alter", document);
  if (document.contains("labels")) request.batch.labels = labels_of(document["labels"], "/labels");
  request.webhook = read_webhook(service, document);
  return request;
}

// The first job makes what all share (reference drape and map); the others wait for it.
std::string store_batch(Service& service, Transaction& transaction, const BatchRequest& request) {
  const std::string id = add_batch(transaction, request.batch, service.store.clock());
  std::optional<std::string> leader;
  for (const std::string& body : request.bodies) {
    NewJob job;
    job.tenant = request.batch.tenant;
    job.kind = "alter";
    job.inputs = {
        {"garment", request.batch.garment}, {"reference_body", *request.batch.reference_body}, {"target_body", body}};
    if (request.worn) job.inputs["worn"] = *request.worn;
    job.options = request.batch.options;
    job.labels = request.batch.labels;
    job.webhook = request.webhook;
    job.priority = Priority::Batch;
    job.batch = id;
    job.blocked_by = leader;
    const std::string made = service.store.queue.enqueue(transaction, job);
    if (!leader && !service.store.queue.is_ended(transaction, made)) leader = made;
  }
  return id;
}

ordered_json counts_of(const Service& service, const std::string& batch) {
  const auto counted = count_batch_jobs(service.store.database, batch);
  ordered_json counts = ordered_json::object();
  std::int64_t total = 0;
  for (const JobState state :
       {JobState::Queued, JobState::Running, JobState::Succeeded, JobState::Failed, JobState::Cancelled}) {
    const auto found = counted.find(state);
    counts[std::string(state_name(state))] = found == counted.end() ? 0 : found->second;
    total += found == counted.end() ? 0 : found->second;
  }
  counts["total"] = total;
  return counts;
}

ordered_json summary_of(const Job& job) {
  return job.summary ? ordered_json::parse(*job.summary, nullptr, false) : ordered_json::object();
}

// One row a job: the body and its fit by zone, as the jobs' results say.
ordered_json fit_matrix(const std::vector<Job>& jobs) {
  ordered_json rows = ordered_json::array();
  for (auto job = jobs.rbegin(); job != jobs.rend(); ++job) {
    const ordered_json summary = summary_of(*job);
    rows.push_back({{"job", job->id},
                    {"body", job->inputs.at("target_body")},
                    {"state", std::string(state_name(job->state))},
                    {"fit", summary.is_object() && summary.contains("fit") ? summary["fit"] : ordered_json()},
                    {"error", job->error ? ordered_json(job->error->code) : ordered_json()}});
  }
  return rows;
}

double badness(const ordered_json& row) {
  if (!row["error"].is_null()) return 1e9;
  double worst = 0.0;
  if (row["fit"].is_object())
    for (const auto& [zone, value] : row["fit"].items())
      if (value.is_number()) worst = std::max(worst, std::abs(value.get<double>()));
  return worst;
}

ordered_json worst_cases(const ordered_json& rows) {
  std::vector<ordered_json> ended;
  for (const ordered_json& row : rows)
    if (row["state"] == "succeeded" || row["state"] == "failed") ended.push_back(row);
  std::stable_sort(ended.begin(), ended.end(),
                   [](const ordered_json& a, const ordered_json& b) { return badness(a) > badness(b); });
  if (ended.size() > kWorstCases) ended.resize(kWorstCases);
  return ended;
}

ordered_json batch_document(const Service& service, const Batch& batch) {
  const std::string self = "/v1/batches/" + batch.id;
  return {{"id", batch.id},
          {"garment", batch.garment},
          {"reference_body", batch.reference_body ? ordered_json(*batch.reference_body) : ordered_json()},
          {"options", ordered_json::parse(batch.options, nullptr, false)},
          {"labels", batch.labels},
          {"created_at", iso_time(batch.created_ms)},
          {"counts", counts_of(service, batch.id)},
          {"links", {{"self", self}, {"table", self + "/summary.csv"}, {"page", self + "/summary.html"}}}};
}

Response whole_batch(const Service& service, int status, const std::string& tenant, const std::string& id) {
  const auto batch = find_batch(service.store.database, tenant, id);
  if (!batch) throw not_found("batch");
  JobFilter filter;
  filter.batch = id;
  filter.limit = service.options.max_batch;
  ordered_json document = batch_document(service, *batch);
  document["fit_matrix"] = fit_matrix(service.store.jobs.list(tenant, filter));
  document["worst"] = worst_cases(document["fit_matrix"]);
  return json_response(status, text_of(document)).with("Location", document["links"]["self"]);
}

Response create_batch(Service& service, Request& request) {
  refuse_when_disk_is_low(service);
  std::string raw;
  const json document = read_json(request, service.options.max_document_bytes, &raw);
  const Idempotency idempotency(service, request, raw);
  if (idempotency.remembered()) return whole_batch(service, 202, request.tenant, idempotency.remembered()->resource);
  const BatchRequest batch = read_batch(service, request.tenant, document);
  std::string id;
  {
    Transaction transaction(service.store.database);
    id = store_batch(service, transaction, batch);
    idempotency.remember(transaction, 202, id);
    transaction.commit();
  }
  service.store.queue.announce_work();
  return whole_batch(service, 202, request.tenant, id).with("Retry-After", "5");
}

Response list_batches(Service& service, const Request& request) {
  const Page page = page_of(request);
  const auto batches = list_batches(service.store.database, request.tenant, page.before, page.limit);
  ordered_json items = ordered_json::array();
  for (const Batch& batch : batches) items.push_back(batch_document(service, batch));
  return json_response(200, list_document(std::move(items), next_link(request, batches.size(), page.limit,
                                                                      batches.empty() ? 0 : batches.back().sequence)));
}

}  // namespace

void add_batch_routes(Service& service) {
  service.router.add({"POST", "/v1/batches", [&service](Request& r) { return create_batch(service, r); }});
  service.router.add({"GET", "/v1/batches", [&service](Request& r) { return list_batches(service, r); }});
  service.router.add({"GET", "/v1/batches/{id}",
                      [&service](Request& r) { return whole_batch(service, 200, r.tenant, r.path_value("id")); }});
}

}  // namespace toile::http

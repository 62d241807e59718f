// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/job_request.h"

#include <nlohmann/json.hpp>

#include "server/http/documents.h"

namespace toile::http {

using nlohmann::json;

namespace {

void require_input(const Service& service, const std::string& tenant, InputKind kind, const json& document,
                   const std::string& role, NewJob& job) {
  const std::string id = required_text(document, role);
  if (!service.store.inputs.find(tenant, kind, id))
    throw invalid("/" + role, "no " + std::string(kind_name(kind)) + " with this id: upload it first");
  job.inputs[role] = id;
}

}  // namespace

std::string required_text(const json& document, const std::string& name) {
  if (!document.contains(name)) throw invalid("/" + name, "`" + name + "` is missing");
  if (!document[name].is_string()) throw invalid("/" + name, "`" + name + "` must be a string");
  return document[name];
}

std::string read_options(const Service& service, const std::string& kind, const json& document) {
  const json options = document.value("options", json::object());
  if (!options.is_object()) throw invalid("/options", "`options` must be an object");
  return service.check_options ? service.check_options(kind, options.dump()) : options.dump();
}

std::optional<std::string> read_webhook(const Service& service, const json& document) {
  if (!document.contains("webhook") || document["webhook"].is_null()) return std::nullopt;
  const std::string url = required_text(document, "webhook");
  if (service.check_webhook) service.check_webhook(url);
  return url;
}

NewJob read_job_request(const Service& service, const std::string& tenant, const json& document) {
  require_schema(document, "job_request");
  NewJob job;
  job.tenant = tenant;
  job.kind = document.contains("kind") ? required_text(document, "kind") : "alter";
  if (!service.options.kinds.contains(job.kind))
    throw invalid("/kind", "unknown kind of job; this server does: alter, drape");
  require_input(service, tenant, InputKind::Garment, document, "garment", job);
  if (document.contains("worn")) require_input(service, tenant, InputKind::Garment, document, "worn", job);
  require_input(service, tenant, InputKind::Body, document, "reference_body", job);
  if (job.kind != "drape" || document.contains("target_body"))
    require_input(service, tenant, InputKind::Body, document, "target_body", job);
  job.options = read_options(service, job.kind, document);
  if (document.contains("labels")) job.labels = labels_of(document["labels"], "/labels");
  job.webhook = read_webhook(service, document);
  return job;
}

void refuse_when_disk_is_low(const Service& service) {
  if (service.store.free_bytes() < service.options.min_free_bytes)
    throw Error(ErrorCode::StorageFull, "", "the server's disk is nearly full");
}

}  // namespace toile::http

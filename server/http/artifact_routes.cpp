// SPDX-License-Identifier: GPL-3.0-or-later
// What a job made: the list, and the bytes.
#include <nlohmann/json.hpp>

#include "server/http/documents.h"
#include "server/http/service.h"

namespace toile::http {

namespace {

void require_job(Service& service, const Request& request) {
  if (!service.store.jobs.find(request.tenant, request.path_value("id"))) throw not_found("job");
}

bool names_tag(const std::string& header, const std::string& tag) {
  return header == "*" || header.find(tag) != std::string::npos;
}

Response list_artifacts(Service& service, const Request& request) {
  require_job(service, request);
  const std::string& id = request.path_value("id");
  nlohmann::ordered_json items = nlohmann::ordered_json::array();
  for (const ArtifactRecord& artifact : service.store.jobs.artifacts(id))
    items.push_back(artifact_document(id, artifact));
  return json_response(200, list_document(std::move(items), ""));
}

Response show_artifact(Service& service, const Request& request) {
  require_job(service, request);
  const auto artifact = service.store.jobs.artifact(request.path_value("id"), request.path_value("name"));
  if (!artifact) throw Problem{404, "not_found", "the job has no artifact of this name (yet)", {}, {}};
  const std::string tag = quoted_tag(artifact->sha256);
  Response response;
  response.with("ETag", tag).with("Cache-Control", "private, max-age=31536000, immutable");
  if (names_tag(request.header("If-None-Match"), tag)) {
    response.status = 304;
    return response;
  }
  // Results are made from strangers' files: no script in them may run in this server's name.
  response.with("Content-Security-Policy", "default-src 'none'; img-src data:; style-src 'unsafe-inline'; sandbox");
  response.content_type = artifact->content_type;
  response.with("Accept-Ranges", "bytes");
  const std::string range = request.header("Range"), condition = request.header("If-Range");
  if (request.method == "GET" && !range.empty() && (condition.empty() || condition == tag)) {
    response.range = byte_range_of(range, artifact->size);
    response.status = 206;
    response.with("Content-Range", "bytes " + std::to_string(response.range->first) + "-" +
                                       std::to_string(response.range->last) + "/" + std::to_string(artifact->size));
  }
  response.file = service.store.artifacts.path_of(artifact->sha256);
  return response;
}

}  // namespace

void add_artifact_routes(Service& service) {
  service.router.add({"GET", "/v1/jobs/{id}/artifacts", [&service](Request& r) { return list_artifacts(service, r); }});
  service.router.add(
      {"GET", "/v1/jobs/{id}/artifacts/{name}", [&service](Request& r) { return show_artifact(service, r); }});
}

}  // namespace toile::http

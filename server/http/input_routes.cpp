// SPDX-License-Identifier: GPL-3.0-or-later
// POST, GET, DELETE of bodies and garments.
#include <nlohmann/json.hpp>

#include "server/http/documents.h"
#include "server/http/upload.h"

namespace toile::http {

namespace {

Response stored(const Input& input, bool is_new) {
  const nlohmann::ordered_json document = input_document(input);
  return json_response(is_new ? 201 : 200, text_of(document)).with("Location", document["links"]["self"]);
}

Response create(Service& service, Request& request, InputKind kind) {
  Upload upload = read_upload(service, request, kind);
  const bool known = service.store.inputs.find_equal(upload.input, upload.blob.sha256()).has_value();
  if (!known && service.inspect)
    upload.input.about = service.inspect(kind, upload.input.name, upload.input.fields, upload.blob.file());
  service.store.artifacts.publish(std::span(&upload.blob, 1));
  Transaction transaction(service.store.database);
  const auto [input, is_new] = service.store.inputs.add(transaction, upload.input, upload.blob);
  transaction.commit();
  return stored(input, is_new);
}

Response show(Service& service, const Request& request, InputKind kind) {
  const auto input = service.store.inputs.find(request.tenant, kind, request.path_value("id"));
  if (!input) throw not_found(std::string(kind_name(kind)));
  return json_response(200, text_of(input_document(*input)));
}

Response list(Service& service, const Request& request, InputKind kind) {
  const Page page = page_of(request, {"label"});
  const auto inputs =
      service.store.inputs.list(request.tenant, kind, {request.parameter("label"), page.before, page.limit});
  nlohmann::ordered_json items = nlohmann::ordered_json::array();
  for (const Input& input : inputs) items.push_back(input_document(input));
  return json_response(200, list_document(std::move(items), next_link(request, inputs.size(), page.limit,
                                                                      inputs.empty() ? 0 : inputs.back().sequence)));
}

Response remove(Service& service, const Request& request, InputKind kind) {
  service.store.removal.remove_input(request.tenant, kind, request.path_value("id"));
  Response response;
  response.status = 204;
  return response;
}

void add(Service& service, const std::string& base, InputKind kind) {
  service.router.add({"POST", base, [&service, kind](Request& r) { return create(service, r, kind); }});
  service.router.add({"GET", base, [&service, kind](Request& r) { return list(service, r, kind); }});
  service.router.add({"GET", base + "/{id}", [&service, kind](Request& r) { return show(service, r, kind); }});
  service.router.add({"DELETE", base + "/{id}", [&service, kind](Request& r) { return remove(service, r, kind); }});
}

}  // namespace

void add_input_routes(Service& service) {
  add(service, "/v1/bodies", InputKind::Body);
  add(service, "/v1/garments", InputKind::Garment);
}

}  // namespace toile::http

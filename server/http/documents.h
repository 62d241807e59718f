// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON documents of the interface (schemas/), from what the store knows.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "jobs/store/batch_store.h"
#include "jobs/store/store.h"
#include "server/http/message.h"

namespace toile::http {

std::string iso_time(std::int64_t ms);
std::string quoted_tag(const std::string& value);  // an ETag

nlohmann::ordered_json input_document(const Input& input);
nlohmann::ordered_json job_document(const Job& job);
nlohmann::ordered_json artifact_document(const std::string& job, const ArtifactRecord& artifact);

// {"items": [...], "next": "/v1/...&cursor=N" or null}
std::string list_document(nlohmann::ordered_json items, const std::string& next);
std::string text_of(const nlohmann::ordered_json& document);

struct Page {
  std::int64_t before = 0;
  int limit = 50;
};
// `limit` (1-200) and `cursor` of a list. Throws Problem 422, also for a parameter that is none of these and no filter
// of the list: a misspelt filter would list everything.
Page page_of(const Request& request, std::initializer_list<std::string_view> filters = {});
// The address of the next page, or empty when this one was not full.
std::string next_link(const Request& request, std::size_t count, int limit, std::int64_t last_sequence);

// The request's JSON body. Throws Problem: 415 not JSON, 413 too large, 400 malformed or nested deeper than 64.
nlohmann::json read_json(Request& request, std::int64_t max_bytes, std::string* raw = nullptr);
// Throws Problem 422 with a pointer for everything that disagrees with the schema (schemas/).
void require_schema(const nlohmann::json& document, const std::string& schema);
// Strings of at most 100 characters, at most 50 of them.
std::vector<std::string> labels_of(const nlohmann::json& value, const std::string& pointer);

}  // namespace toile::http

// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/documents.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>

#include <nlohmann/json.hpp>

#include "engine/io/json.h"
#include "engine/io/schema_check.h"
#include "server/http/problem.h"

namespace toile::http {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr int kMaxPage = 200;
constexpr std::size_t kMaxLabels = 50, kMaxLabelBytes = 100;

ordered_json time_or_null(const std::optional<std::int64_t>& ms) {
  return ms ? ordered_json(iso_time(*ms)) : ordered_json();
}

ordered_json parsed(const std::optional<std::string>& text) {
  return text ? ordered_json::parse(*text, nullptr, false) : ordered_json();
}

int number_of(const Request& request, const std::string& name, int fallback, int low, int high) {
  const std::optional<std::string> text = request.parameter(name);
  if (!text) return fallback;
  int value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || value < low || value > high)
    throw invalid(name,
                  "`" + name + "` must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return value;
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

std::string iso_time(std::int64_t ms) {
  const std::time_t seconds = ms / 1000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 40> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 8> fraction{};
  std::snprintf(fraction.data(), fraction.size(), ".%03dZ", static_cast<int>(ms % 1000));
  return std::string(text.data(), length) + fraction.data();
}

std::string quoted_tag(const std::string& value) {
  return std::string(1, '"').append(value).append(1, '"');
}

ordered_json input_document(const Input& input) {
  const std::string kind(kind_name(input.kind));
  const std::string plural = input.kind == InputKind::Body ? "bodies" : "garments";
  return {{"id", input.id},
          {"kind", kind},
          {"name", input.name},
          {"labels", input.labels},
          {"fields", ordered_json::parse(input.fields, nullptr, false)},
          {"about", ordered_json::parse(input.about, nullptr, false)},
          {"size_bytes", input.size},
          {"sha256", input.sha256},
          {"created_at", iso_time(input.created_ms)},
          {"links", {{"self", "/v1/" + plural + "/" + input.id}}}};
}

ordered_json job_document(const Job& job) {
  const std::string self = "/v1/jobs/" + job.id;
  ordered_json document = {{"id", job.id},
                           {"kind", job.kind},
                           {"state", std::string(state_name(job.state))},
                           {"stage", job.stage},
                           {"progress", job.progress},
                           {"attempt", job.attempt},
                           {"cancel_requested", job.cancel_requested}};
  for (const char* role : {"garment", "worn", "reference_body", "target_body"}) {
    const auto found = job.inputs.find(role);
    document[role] = found == job.inputs.end() ? ordered_json() : ordered_json(found->second);
  }
  document["options"] = ordered_json::parse(job.options, nullptr, false);
  document["labels"] = job.labels;
  document["batch"] = job.batch ? ordered_json(*job.batch) : ordered_json();
  document["created_at"] = iso_time(job.created_ms);
  document["started_at"] = time_or_null(job.started_ms);
  document["finished_at"] = time_or_null(job.finished_ms);
  document["error"] =
      job.error
          ? ordered_json{{"code", job.error->code}, {"subject", job.error->subject}, {"message", job.error->message}}
          : ordered_json();
  document["result"] = parsed(job.summary);
  document["timings"] = parsed(job.timings);
  document["links"] = {{"self", self}, {"events", self + "/events"}, {"artifacts", self + "/artifacts"}};
  return document;
}

ordered_json artifact_document(const std::string& job, const ArtifactRecord& artifact) {
  return {{"name", artifact.name},
          {"content_type", artifact.content_type},
          {"size_bytes", artifact.size},
          {"sha256", artifact.sha256},
          {"links", {{"self", "/v1/jobs/" + job + "/artifacts/" + artifact.name}}}};
}

std::string text_of(const ordered_json& document) {
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string list_document(ordered_json items, const std::string& next) {
  return text_of({{"items", std::move(items)}, {"next", next.empty() ? ordered_json() : ordered_json(next)}});
}

Page page_of(const Request& request, std::initializer_list<std::string_view> filters) {
  std::vector<std::string_view> known = {"limit", "cursor"};
  known.insert(known.end(), filters);
  for (const auto& [name, value] : request.query) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string list;
    for (const std::string_view one : known) list.append(list.empty() ? "" : ", ").append(one);
    throw invalid(name, "unknown parameter `" + name + "`; this list knows " + list);
  }
  Page page;
  page.limit = number_of(request, "limit", 50, 1, kMaxPage);
  page.before = number_of(request, "cursor", 0, 0, 2147483647);
  return page;
}

std::string next_link(const Request& request, std::size_t count, int limit, std::int64_t last_sequence) {
  if (count < static_cast<std::size_t>(limit)) return {};
  std::string link = request.path + "?limit=" + std::to_string(limit) + "&cursor=" + std::to_string(last_sequence);
  for (const char* name : {"label", "state"})
    if (const auto value = request.parameter(name)) {
      link += std::string("&") + name + "=";
      for (const unsigned char c : *value) {
        std::array<char, 4> escaped{};
        std::snprintf(escaped.data(), escaped.size(), "%%%02X", c);
        link += std::isalnum(c) != 0 ? std::string(1, static_cast<char>(c)) : std::string(escaped.data());
      }
    }
  return link;
}

json read_json(Request& request, std::int64_t max_bytes, std::string* raw) {
  if (request.media_type() != "application/json")
    throw Problem{415, "format_unknown", "send Content-Type: application/json", {}, {}};
  if (request.content_length > max_bytes)
    throw Problem{413, "limit_exceeded", "a request may have at most " + std::to_string(max_bytes) + " bytes", {}, {}};
  if (request.content_length == 0)
    throw Problem{400, "file_malformed", "the request is empty: send a JSON document", {}, {}};
  std::string text;
  const bool complete = request.read_body([&](std::span<const std::uint8_t> bytes) {
    text.append(bytes.begin(), bytes.end());
    return static_cast<std::int64_t>(text.size()) <= max_bytes;
  });
  if (!complete) throw Problem{400, "file_malformed", "the body ended early", {}, {}};
  if (raw) *raw = text;
  try {
    return parse_json(bytes_of(text), "request");
  } catch (const Error& error) {
    throw Problem{400, "file_malformed", error.message, {}, {}};
  }
}

void require_schema(const json& document, const std::string& schema) {
  const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  const SchemaCheck check = check_schema(bytes_of(text), schema);
  if (check.problems.empty()) return;
  Problem problem{422,
                  std::string(error_name(ErrorCode::BadUsage)),
                  check.problems[0].message + " (see /schemas/" + schema + ".schema.json)",
                  {},
                  {}};
  for (const SchemaProblem& found : check.problems) problem.errors.push_back({found.pointer, found.message});
  throw problem;
}

std::vector<std::string> labels_of(const json& value, const std::string& pointer) {
  if (!value.is_array() || value.size() > kMaxLabels) throw invalid(pointer, "labels are a list of at most 50 strings");
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!value[i].is_string() || value[i].get_ref<const std::string&>().empty() ||
        value[i].get_ref<const std::string&>().size() > kMaxLabelBytes)
      throw invalid(pointer + "/" + std::to_string(i), "a label is a string of 1 to 100 bytes");
    labels.push_back(value[i]);
  }
  return labels;
}

}  // namespace toile::http

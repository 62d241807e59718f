// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/child_protocol.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <nlohmann/json.hpp>

namespace toile {

using nlohmann::json;

namespace {

constexpr std::array<const char*, 6> kEventNames = {"progress", "find_stage", "keep_stage",
                                                    "artifact", "done",       "failed"};

// Text from libraries may not be UTF-8.
std::string dump(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

ChildEvent event_of(const json& value) {
  ChildEvent event;
  const auto* found = std::find(kEventNames.begin(), kEventNames.end(), value.at("event").get<std::string>());
  if (found == kEventNames.end()) throw json::other_error::create(0, "unknown event", nullptr);
  event.kind = static_cast<ChildEvent::Kind>(found - kEventNames.begin());
  event.name = value.value("name", "");
  event.fraction = value.value("fraction", 0.0);
  event.file = value.value("file", "");
  event.content_type = value.value("content_type", "");
  event.summary = value.value("summary", "{}");
  event.timings = value.value("timings", "{}");
  event.error = {value.value("code", ""), value.value("subject", ""), value.value("message", "")};
  return event;
}

}  // namespace

std::string encode_request(const JobRequest& request) {
  json inputs = json::object();
  for (const auto& [role, input] : request.inputs)
    inputs[role] = {{"file", input.file}, {"name", input.name}, {"fields", input.fields}};
  return dump({{"kind", request.kind},
               {"options", request.options},
               {"created_ms", request.created_ms},
               {"threads", request.threads},
               {"inputs", inputs}});
}

JobRequest decode_request(const std::string& line) {
  const json value = json::parse(line);
  JobRequest request{value.at("kind"), value.at("options"), value.at("created_ms"), value.at("threads"), {}};
  for (const auto& [role, input] : value.at("inputs").items())
    request.inputs[role] = {input.at("file"), input.at("name"), input.at("fields")};
  return request;
}

std::string encode_event(const ChildEvent& event) {
  json value = {{"event", kEventNames[static_cast<std::size_t>(event.kind)]}};
  switch (event.kind) {
    case ChildEvent::Kind::Progress:
      value["name"] = event.name;
      value["fraction"] = event.fraction;
      break;
    case ChildEvent::Kind::FindStage: value["name"] = event.name; break;
    case ChildEvent::Kind::Artifact: value["content_type"] = event.content_type; [[fallthrough]];
    case ChildEvent::Kind::KeepStage:
      value["name"] = event.name;
      value["file"] = event.file;
      break;
    case ChildEvent::Kind::Done:
      value["summary"] = event.summary;
      value["timings"] = event.timings;
      break;
    case ChildEvent::Kind::Failed:
      value["code"] = event.error.code;
      value["subject"] = event.error.subject;
      value["message"] = event.error.message;
      break;
  }
  return dump(value);
}

std::optional<ChildEvent> decode_event(const std::string& line) {
  try {
    return event_of(json::parse(line));
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::string encode_stage_reply(const std::optional<std::string>& file) {
  return dump({{"file", file ? json(*file) : json(nullptr)}});
}

std::optional<std::string> decode_stage_reply(const std::string& line) {
  const json value = json::parse(line);
  return value.at("file").is_null() ? std::nullopt : std::optional(value.at("file").get<std::string>());
}

bool is_plain_name(const std::string& name) {
  if (name.empty() || name.size() > 100 || name.front() == '.') return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (std::isalnum(c) != 0 && c < 128) || c == '.' || c == '_' || c == '-';
  });
}

}  // namespace toile

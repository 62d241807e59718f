// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/schema_words.h"

#include <cstdlib>

#include <nlohmann/json.hpp>

namespace toile {

using nlohmann::json;

namespace {

// The text between the first and the last ' of a complaint.
std::string quoted(const std::string& complaint) {
  const std::size_t from = complaint.find('\''), to = complaint.rfind('\'');
  // Some complaints quote other words first: the name is the last quoted one.
  const std::size_t before = to == complaint.npos || to == 0 ? to : complaint.rfind('\'', to - 1);
  if (from == complaint.npos || from == to) return {};
  return complaint.substr(before + 1, to - before - 1);
}

// A schema of the same document that "$ref" names ("#/definitions/point"); null where it is in another file.
const json* referred(const json* node, const json& root) {
  for (int hops = 0; node && node->is_object() && node->contains("$ref") && hops < 8; ++hops) {
    const std::string target = node->at("$ref");
    if (!target.starts_with("#/")) return nullptr;
    const json::json_pointer place(target.substr(1));
    node = root.contains(place) ? &root.at(place) : nullptr;
  }
  return node;
}

const json* inside(const json& node, const std::string& step) {
  if (node.contains("properties") && node["properties"].contains(step)) return &node["properties"][step];
  if (node.contains("additionalProperties") && node["additionalProperties"].is_object())
    return &node["additionalProperties"];
  if (!node.contains("items")) return nullptr;
  const json& items = node["items"];
  if (items.is_object()) return &items;
  const auto index = static_cast<std::size_t>(std::strtoul(step.c_str(), nullptr, 10));
  return index < items.size() ? &items[index] : nullptr;
}

// What the schema says of the value at `place`; null where that depends on the value.
const json* node_at(json::json_pointer place, const json& root) {
  std::vector<std::string> steps;
  for (; !place.empty(); place.pop_back()) steps.insert(steps.begin(), place.back());
  const json* node = referred(&root, root);
  for (const std::string& step : steps) {
    if (!node) return nullptr;
    node = referred(inside(*node, step), root);
  }
  return node;
}

std::string listed(const json& values) {
  std::string text;
  for (const json& value : values)
    text += (text.empty() ? "" : ", ") + (value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

std::string names_of(const json& object) {
  json names = json::array();
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return listed(names);
}

std::string shown(const json& value) {
  constexpr std::size_t kMost = 60;
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= kMost ? text : value.is_string() ? "a long text" : "a long " + std::string(value.type_name());
}

std::string with(const json* node, const char* key, const std::string& before) {
  return node && node->contains(key) ? before + listed(json::array({node->at(key)})) : std::string();
}

std::string expected_type(const json* node) {
  if (!node || !node->contains("type")) return "a value of another type";
  const json& type = node->at("type");
  return type.is_array() ? listed(type) : type.get<std::string>();
}

}  // namespace

std::string schema_words(const std::string& complaint, const std::string& pointer, const json& document,
                         const json& schema) {
  const auto says = [&](const char* words) { return complaint.find(words) != complaint.npos; };
  if (says("schema associated with property name") || says("Failed to validate item #")) return {};
  const json::json_pointer place(pointer == "/" ? "" : pointer);
  const json* node = node_at(place, schema);
  const std::string found = document.contains(place) ? shown(document.at(place)) : "nothing";
  if (says("Missing required property")) return "the member \"" + quoted(complaint) + "\" is missing; add it";
  if (says("'additionalProperties' constraints")) {
    const std::string known = node && node->contains("properties") ? names_of(node->at("properties")) : "";
    return "unknown member \"" + quoted(complaint) + "\"" + (known.empty() ? "" : "; known here are " + known);
  }
  if (says("'type' constraint")) return "expected " + expected_type(node) + ", found " + found;
  if (says("any enum values"))
    return "found " + found + (node && node->contains("enum") ? ", expected one of " + listed(node->at("enum")) : "");
  if (says("'const' constraint")) return "found " + found + with(node, "const", ", expected ");
  if (says("'pattern' constraint")) return found + " has not the form expected here" + with(node, "description", ": ");
  if (says("Expected number"))
    return "found " + found + with(node, "minimum", ", at least ") + with(node, "exclusiveMinimum", ", more than ") +
           with(node, "maximum", ", at most ") + with(node, "exclusiveMaximum", ", less than ") + " is expected";
  return complaint;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/record_json.h"

#include <nlohmann/json.hpp>

namespace toile {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Record& record);

struct ToJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const Record& record) const { return json_of(record); }
  Json operator()(const std::vector<Record>& records) const {
    Json array = Json::array();
    for (const Record& record : records) array.push_back(json_of(record));
    return array;
  }
  template <class T>
  Json operator()(const T& value) const {
    return value;
  }
};

Json json_of(const Record& record) {
  Json object = Json::object();
  for (const RecordField& field : record.fields()) object[field.name] = std::visit(ToJson{}, field.value);
  return object;
}

}  // namespace

Bytes write_json(const Record& record) {
  const std::string text = json_of(record).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  return Bytes(text.begin(), text.end());
}

}  // namespace toile

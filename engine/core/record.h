// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of named values, in the order they were added: how stages hand over diagnostics and how result documents are
// put together before engine/io writes them as JSON. Output only: no stage reads its inputs from a record.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace toile {

struct RecordField;

class Record {
 public:
  using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, Record, std::vector<Record>,
                             std::vector<double>, std::vector<std::string>, std::vector<std::vector<double>>,
                             std::vector<std::int64_t>>;

  Record();
  ~Record();
  Record(const Record&);
  Record(Record&&) noexcept;
  Record& operator=(const Record&);
  Record& operator=(Record&&) noexcept;

  // Adds a field; names are unique within one record and end in their unit where they have one ("width_mm").
  Record& add(std::string name, Value value);
  Record& add(std::string name, bool value);
  Record& add(std::string name, int value);
  Record& add(std::string name, std::int64_t value);
  Record& add(std::string name, double value);
  Record& add(std::string name, const char* value);

  const std::vector<RecordField>& fields() const { return fields_; }
  // The value of this name, or null.
  const Value* find(const std::string& name) const;

 private:
  template <class A>
  friend void archive(A& a, Record& record) {
    a(record.fields_);
  }
  std::vector<RecordField> fields_;
};

struct RecordField {
  std::string name;
  Record::Value value;
};

// Defined where the fields are complete: they hold records themselves.
inline Record::Record() = default;
inline Record::~Record() = default;
inline Record::Record(const Record&) = default;
inline Record::Record(Record&&) noexcept = default;
inline Record& Record::operator=(const Record&) = default;
inline Record& Record::operator=(Record&&) noexcept = default;

inline Record& Record::add(std::string name, Value value) {
  fields_.push_back({std::move(name), std::move(value)});
  return *this;
}

inline Record& Record::add(std::string name, bool value) {
  return add(std::move(name), Value(value));
}
inline Record& Record::add(std::string name, int value) {
  return add(std::move(name), Value(std::int64_t{value}));
}
inline Record& Record::add(std::string name, std::int64_t value) {
  return add(std::move(name), Value(value));
}
inline Record& Record::add(std::string name, double value) {
  return add(std::move(name), Value(value));
}
inline Record& Record::add(std::string name, const char* value) {
  return add(std::move(name), Value(std::string(value)));
}

inline const Record::Value* Record::find(const std::string& name) const {
  for (const RecordField& field : fields_)
    if (field.name == name) return &field.value;
  return nullptr;
}

// The alternative numbered `index`; a reader makes it first. An index out of range leaves the value empty.
template <std::size_t I = 0, class A>
void archive_alternative(A& a, Record::Value& value, std::uint8_t index) {
  if constexpr (I < std::variant_size_v<Record::Value>) {
    if (index != I) return archive_alternative<I + 1>(a, value, index);
    if (value.index() != I) value.emplace<I>();
    if constexpr (I > 0) a(std::get<I>(value));
  }
}

template <class A>
void archive(A& a, RecordField& field) {
  auto index = static_cast<std::uint8_t>(field.value.index());
  a(field.name, index);
  archive_alternative(a, field.value, index);
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Reading JSON that may come from anyone: limits on depth and size, and values that know where they stand.
//
// Every refusal is an Error whose subject is the JSON pointer of the offending value (RFC 6901) and whose message says
// what was expected. nlohmann-json itself is only named here; sources that include this header include it themselves.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/core/error.h"
#include "engine/core/types.h"

namespace toile {

inline constexpr int kMaxJsonDepth = 64;
inline constexpr std::size_t kMaxJsonValues = 1'000'000;  // bounds the memory of a document to about 130 MB
inline constexpr std::size_t kMaxJsonText = 1u << 20;     // bytes of one string, quotes and escapes included
inline constexpr std::size_t kMaxJsonBytes = 64u << 20;

// Whether the first character that is no white space begins an object or an array; not for an empty file.
bool looks_like_json(std::span<const std::uint8_t> bytes);

// Throws Error{FileMalformed} with line and column, Error{LimitExceeded} for depth or size.
nlohmann::json parse_json(std::span<const std::uint8_t> bytes, const std::string& subject);

// A value of a parsed document together with its JSON pointer. The document must outlive it.
class JsonView {
 public:
  explicit JsonView(const nlohmann::json& value, std::string pointer = {})
      : value_(&value), pointer_(std::move(pointer)) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& pointer() const { return pointer_; }
  bool is_object() const;
  bool is_array() const;
  bool is_string() const;
  bool is_number() const;
  bool is_null() const;

  // Members of an object. `at` throws when the member is missing; `find` is empty then, and for null.
  JsonView at(std::string_view key) const;
  std::optional<JsonView> find(std::string_view key) const;
  std::vector<std::pair<std::string, JsonView>> members() const;
  void require_only(std::initializer_list<std::string_view> keys) const;

  // Elements of an array.
  std::size_t size() const;
  JsonView at(std::size_t index) const;
  std::vector<JsonView> elements(std::size_t most) const;  // throws LimitExceeded above `most`

  double number(double least, double most) const;  // inclusive
  int integer(int least, int most) const;
  bool boolean() const;
  std::string text(std::size_t longest = 1000) const;
  Vec2 point(double bound) const;    // [x, y], each within +-bound
  Vec3 vector3(double bound) const;  // [x, y, z], each within +-bound

  [[noreturn]] void fail(const std::string& message, ErrorCode code = ErrorCode::FileMalformed) const;

 private:
  const nlohmann::json* value_;
  std::string pointer_;
};

// One step of a JSON pointer, with ~ and / escaped.
std::string pointer_step(std::string_view key);

}  // namespace toile

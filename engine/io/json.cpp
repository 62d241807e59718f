// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/json.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace toile {

using nlohmann::json;

namespace {

std::string line_and_column(std::span<const std::uint8_t> bytes, std::size_t offset) {
  const std::size_t end = std::min(offset, bytes.size());
  std::size_t line = 1, column = 1;
  for (std::size_t i = 0; i + 1 < end; ++i) {
    ++column;
    if (bytes[i] == '\n') ++line, column = 1;
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

const char* kind_of(const json& value) {
  if (value.is_number()) return "a number";
  if (value.is_string()) return "a string";
  if (value.is_array()) return "an array";
  if (value.is_object()) return "an object";
  if (value.is_boolean()) return "true or false";
  return "null";
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Depth, number of values and length of texts, before anything is allocated for them. Counts are those of a valid
// document; of broken ones the parser will say more. (nlohmann-json's own callback takes quadratic time on long
// arrays.)
class LimitScan {
 public:
  explicit LimitScan(const std::string& subject) : subject_(subject) {}

  void run(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t c : bytes) {
      if (in_text_)
        take_of_text(c);
      else
        take(c);
    }
  }

 private:
  void take(std::uint8_t c) {
    switch (c) {
      case '"': in_text_ = true, text_bytes_ = 0; break;
      case '[':
      case '{':
        if (++depth_ > kMaxJsonDepth) refuse("JSON may be nested at most 64 deep; flatten the document");
        count_value();
        break;
      case ']':
      case '}': --depth_; break;
      case ',': count_value(); break;
      default: break;
    }
  }

  void take_of_text(std::uint8_t c) {
    if (++text_bytes_ > kMaxJsonText) refuse("a text in JSON may have at most 1 MiB; shorten it");
    if (escaped_)
      escaped_ = false;
    else if (c == '\\')
      escaped_ = true;
    else if (c == '"')
      in_text_ = false;
  }

  void count_value() {
    if (++values_ > kMaxJsonValues) refuse("JSON may hold at most 1,000,000 values; send a smaller document");
  }

  [[noreturn]] void refuse(const char* message) const { throw Error(ErrorCode::LimitExceeded, subject_, message); }

  const std::string& subject_;
  bool in_text_ = false, escaped_ = false;
  int depth_ = 0;
  std::size_t values_ = 0, text_bytes_ = 0;
};

}  // namespace

bool looks_like_json(std::span<const std::uint8_t> bytes) {
  const auto first = std::find_if(bytes.begin(), bytes.end(), [](std::uint8_t c) { return c > ' '; });
  return first != bytes.end() && (*first == '{' || *first == '[');
}

json parse_json(std::span<const std::uint8_t> bytes, const std::string& subject) {
  if (bytes.size() > kMaxJsonBytes)
    throw Error(ErrorCode::LimitExceeded, subject, "JSON documents may have at most 64 MiB; send a smaller one");
  LimitScan(subject).run(bytes);
  try {
    return json::parse(bytes.begin(), bytes.end());
  } catch (const json::parse_error& error) {
    throw Error(
        ErrorCode::FileMalformed, subject,
        "not JSON: syntax error at " + line_and_column(bytes, error.byte) + "; correct it or export the file again");
  } catch (const json::exception&) {
    throw Error(ErrorCode::FileMalformed, subject, "not JSON: a number is too large; coordinates must be finite");
  }
}

std::string pointer_step(std::string_view key) {
  std::string step = "/";
  for (const char c : key) {
    if (c == '~')
      step += "~0";
    else if (c == '/')
      step += "~1";
    else
      step += c;
  }
  return step;
}

void JsonView::fail(const std::string& message, ErrorCode code) const {
  throw Error(code, pointer_.empty() ? "/" : pointer_, message);
}

bool JsonView::is_object() const {
  return value_->is_object();
}
bool JsonView::is_array() const {
  return value_->is_array();
}
bool JsonView::is_string() const {
  return value_->is_string();
}
bool JsonView::is_number() const {
  return value_->is_number();
}
bool JsonView::is_null() const {
  return value_->is_null();
}

std::optional<JsonView> JsonView::find(std::string_view key) const {
  if (!value_->is_object()) fail(std::string("expected an object, found ") + kind_of(*value_));
  const auto found = value_->find(std::string(key));
  if (found == value_->end() || found->is_null()) return std::nullopt;
  return JsonView(*found, pointer_ + pointer_step(key));
}

JsonView JsonView::at(std::string_view key) const {
  if (const auto found = find(key)) return *found;
  fail("the member \"" + std::string(key) + "\" is missing; add it");
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
  if (!value_->is_object()) fail(std::string("expected an object, found ") + kind_of(*value_));
  std::vector<std::pair<std::string, JsonView>> all;
  for (const auto& [key, member] : value_->items())
    all.emplace_back(key, JsonView(member, pointer_ + pointer_step(key)));
  return all;
}

void JsonView::require_only(std::initializer_list<std::string_view> keys) const {
  for (const auto& [key, member] : members()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string known;
    for (const auto& k : keys) known += (known.empty() ? "" : ", ") + std::string(k);
    member.fail("unknown member; known here are " + known);
  }
}

std::size_t JsonView::size() const {
  if (!value_->is_array()) fail(std::string("expected an array, found ") + kind_of(*value_));
  return value_->size();
}

JsonView JsonView::at(std::size_t index) const {
  if (index >= size()) fail("expected at least " + std::to_string(index + 1) + " elements");
  return JsonView((*value_)[index], pointer_ + "/" + std::to_string(index));
}

std::vector<JsonView> JsonView::elements(std::size_t most) const {
  if (size() > most)
    fail("at most " + std::to_string(most) + " elements are allowed, found " + std::to_string(size()),
         ErrorCode::LimitExceeded);
  std::vector<JsonView> all;
  for (std::size_t i = 0; i < size(); ++i) all.push_back(at(i));
  return all;
}

double JsonView::number(double least, double most) const {
  if (!value_->is_number()) fail(std::string("expected a number, found ") + kind_of(*value_));
  const double number = value_->get<double>();
  if (!(number >= least && number <= most))
    fail("must lie between " + short_number(least) + " and " + short_number(most) + ", found " + short_number(number));
  return number;
}

int JsonView::integer(int least, int most) const {
  const double value = number(least, most);
  if (value != std::floor(value)) fail("expected a whole number, found " + short_number(value));
  return static_cast<int>(value);
}

bool JsonView::boolean() const {
  if (!value_->is_boolean()) fail(std::string("expected true or false, found ") + kind_of(*value_));
  return value_->get<bool>();
}

std::string JsonView::text(std::size_t longest) const {
  if (!value_->is_string()) fail(std::string("expected a string, found ") + kind_of(*value_));
  const auto& text = value_->get_ref<const std::string&>();
  if (text.size() > longest)
    fail("at most " + std::to_string(longest) + " characters are allowed", ErrorCode::LimitExceeded);
  return text;
}

Vec2 JsonView::point(double bound) const {
  if (size() != 2) fail("expected [x, y]");
  return {at(0).number(-bound, bound), at(1).number(-bound, bound)};
}

Vec3 JsonView::vector3(double bound) const {
  if (size() != 3) fail("expected three numbers");
  return {at(std::size_t{0}).number(-bound, bound), at(1).number(-bound, bound), at(2).number(-bound, bound)};
}

}  // namespace toile

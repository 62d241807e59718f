// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/text_scanner.h"

#include <charconv>
#include <cmath>

#include "engine/core/error.h"

namespace toile {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// What is shown of a broken word: printable and short, since the text is untrusted.
std::string shown(std::string_view text) {
  std::string out;
  for (char c : text.substr(0, 24)) out += c >= 32 && c < 127 ? c : '?';
  return text.size() > 24 ? out + "..." : out;
}

// Tells an underflow from an overflow, which from_chars reports alike: by the exponent, or a leading "0." or ".".
bool is_below_one(std::string_view number) {
  if (number.starts_with('-')) number.remove_prefix(1);
  const std::size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number.substr(exponent + 1).starts_with('-');
  return number.starts_with("0.") || number.starts_with('.');
}

}  // namespace

TextScanner::TextScanner(std::span<const std::uint8_t> bytes, std::string subject, LineJoin join)
    : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), subject_(std::move(subject)), join_(join) {}

bool TextScanner::next_line() {
  if (line_ > 0) {
    std::string_view rest;
    while (next_word(rest)) {
    }
    if (cursor_ < text_.size()) ++cursor_;  // the line feed itself
  }
  ++line_;
  return cursor_ < text_.size();
}

std::size_t TextScanner::line_join_length() const {
  if (join_ == LineJoin::None || text_[cursor_] != '\\') return 0;
  if (cursor_ + 1 < text_.size() && text_[cursor_ + 1] == '\n') return 2;
  if (cursor_ + 2 < text_.size() && text_[cursor_ + 1] == '\r' && text_[cursor_ + 2] == '\n') return 3;
  return 0;
}

bool TextScanner::next_word(std::string_view& word) {
  while (cursor_ < text_.size()) {
    const std::size_t join = line_join_length();
    if (join > 0) {
      cursor_ += join;
      ++line_;
    } else if (is_blank(text_[cursor_])) {
      ++cursor_;
    } else {
      break;
    }
  }
  const std::size_t begin = cursor_;
  while (cursor_ < text_.size() && text_[cursor_] != '\n' && !is_blank(text_[cursor_]) && line_join_length() == 0)
    ++cursor_;
  word = text_.substr(begin, cursor_ - begin);
  return !word.empty();
}

std::string_view TextScanner::word(std::string_view what) {
  std::string_view found;
  if (!next_word(found)) fail(std::string(what) + " is missing; the file is cut short or broken, export it again");
  return found;
}

double TextScanner::number(std::string_view what) {
  return to_number(word(what), what);
}

std::int64_t TextScanner::integer(std::string_view what) {
  return to_integer(word(what), what);
}

double TextScanner::to_number(std::string_view text, std::string_view what) const {
  double value = 0;
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool tiny = error == std::errc::result_out_of_range && is_below_one(digits);  // a zero for our purpose
  if ((error != std::errc() && !tiny) || end != digits.data() + digits.size() || !std::isfinite(value))
    fail(std::string(what) + " '" + shown(text) + "' is not a finite number; export the file again");
  return value;
}

std::int64_t TextScanner::to_integer(std::string_view text, std::string_view what) const {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(std::string(what) + " '" + shown(text) + "' is not a whole number; export the file again");
  return value;
}

void TextScanner::fail(std::string_view message) const {
  throw Error(ErrorCode::FileMalformed, subject_, "line " + std::to_string(line_) + ": " + std::string(message));
}

}  // namespace toile

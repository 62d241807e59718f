// SPDX-License-Identifier: GPL-3.0-or-later
// Walks untrusted text line by line and word by word, and knows where it stands when something is wrong.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace toile {

enum class LineJoin { None, Backslash };  // whether a backslash at the end of a line joins the next one to it

// Lines end with LF or CRLF; words are separated by blanks.
// The bytes must outlive the scanner. Throws Error{FileMalformed} with the subject and the line.
class TextScanner {
 public:
  TextScanner(std::span<const std::uint8_t> bytes, std::string subject, LineJoin join = LineJoin::None);

  bool next_line();                        // to the start of the next line, empty or not; false at the end of the text
  bool next_word(std::string_view& word);  // next word of this line; false and empty at its end
  std::string_view word(std::string_view what);  // the same, but a missing word is an error ("`what` is missing")

  double number(std::string_view what);         // finite
  std::int64_t integer(std::string_view what);  // decimal, may be negative

  double to_number(std::string_view text, std::string_view what) const;
  std::int64_t to_integer(std::string_view text, std::string_view what) const;

  int line() const { return line_; }              // 1-based
  std::size_t offset() const { return cursor_; }  // bytes from the start
  const std::string& subject() const { return subject_; }
  [[noreturn]] void fail(std::string_view message) const;  // "line N: message"

 private:
  std::size_t line_join_length() const;

  std::string_view text_;
  std::string subject_;
  LineJoin join_;
  std::size_t cursor_ = 0;
  int line_ = 0;
};

}  // namespace toile

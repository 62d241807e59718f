// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/head_guard.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

#include "server/http/byte_range.h"

namespace toile::http {

namespace {

Problem refuse(int status, std::string code, std::string detail) {
  return {status, std::move(code), std::move(detail), {}, {}};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool is_token(std::string_view text) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || kMarks.find(static_cast<char>(c)) != std::string_view::npos);
  });
}

bool has_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return (c < 32 && c != '\t') || c == 127; });
}

void check_request_line(std::string_view line, const HeadLimits& limits) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last || has_control(line))
    throw refuse(400, "bad_request_line", "the first line is not METHOD TARGET HTTP/1.1");
  const std::string_view method = line.substr(0, first), target = line.substr(first + 1, last - first - 1);
  const std::string_view version = line.substr(last + 1);
  if (!is_token(method)) throw refuse(400, "bad_request_line", "the method is not a word");
  if (version != "HTTP/1.1" && version != "HTTP/1.0") throw refuse(505, "bad_version", "only HTTP/1.1 is spoken here");
  if (target.size() > limits.target_bytes) throw refuse(414, "target_too_long", "the address is too long");
  if (target.empty() || target.front() != '/' || target.find(' ') != std::string_view::npos)
    throw refuse(400, "bad_request_line", "the address must start with a slash");
  static const std::set<std::string_view> kMethods = {"GET", "HEAD", "POST", "DELETE"};
  if (!kMethods.contains(method)) {
    Problem problem = refuse(405, "method_not_allowed", "use GET, HEAD, POST or DELETE");
    problem.headers.emplace_back("Allow", "GET, HEAD, POST, DELETE");
    throw problem;
  }
}

void take_length(std::string_view value, Head& head, bool& seen) {
  std::int64_t length = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), length);
  const bool digits =
      !value.empty() && std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || error != std::errc() || end != value.data() + value.size() || seen)
    throw refuse(400, "bad_content_length", "Content-Length must be given once, as a decimal number");
  seen = true;
  head.content_length = length;
}

void check_header(std::string_view name, std::string_view value, Head& head, bool& length_seen) {
  const std::string key = lower_case(name);
  if (key == "transfer-encoding")
    throw refuse(411, "length_required", "send the body with Content-Length, not in chunks");
  if (key == "content-encoding" && lower_case(value) != "identity")
    throw refuse(415, "content_encoding", "send the body uncompressed");
  if (key == "range" && value.find(',') != std::string_view::npos)
    throw refuse(416, "many_ranges", "ask for one range at a time");
  if (key == "range" && !is_byte_range(value))
    throw refuse(416, "bad_range", "a range reads bytes=FROM-TO, bytes=FROM- or bytes=-COUNT");
  if (key == "content-length") take_length(value, head, length_seen);
  if (key == "expect") head.expects_continue = lower_case(value) == "100-continue";
}

HeadResult parse(std::string_view head_text, const HeadLimits& limits) {
  HeadResult result;
  result.state = HeadState::Complete;
  result.head.size = head_text.size();
  std::size_t begin = head_text.find("\r\n");
  check_request_line(head_text.substr(0, begin), limits);
  bool length_seen = false;
  std::size_t count = 0;
  for (begin += 2;;) {
    const std::size_t end = head_text.find("\r\n", begin);
    const std::string_view line = head_text.substr(begin, end - begin);
    begin = end + 2;
    if (line.empty()) break;
    if (++count > limits.headers) throw refuse(431, "too_many_headers", "too many header fields");
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon)) || has_control(line))
      throw refuse(400, "bad_header", "a header field is not `Name: value` on one line");
    check_header(line.substr(0, colon), trimmed(line.substr(colon + 1)), result.head, length_seen);
  }
  return result;
}

}  // namespace

HeadResult examine_head(std::string_view bytes, const HeadLimits& limits) {
  HeadResult result;
  const std::size_t end = bytes.substr(0, limits.head_bytes + 4).find("\r\n\r\n");
  try {
    if (end != std::string_view::npos) return parse(bytes.substr(0, end + 4), limits);
    if (bytes.size() > limits.head_bytes)
      throw refuse(431, "headers_too_large",
                   "the header is larger than " + std::to_string(limits.head_bytes) + " bytes");
    if (static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n')) > limits.headers + 1)
      throw refuse(431, "too_many_headers", "too many header fields");
  } catch (const Problem& problem) {
    result.state = HeadState::Refused;
    result.refusal = problem;
  }
  return result;
}

}  // namespace toile::http

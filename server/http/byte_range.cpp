// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/byte_range.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "server/http/problem.h"

namespace toile::http {

namespace {

constexpr std::size_t kMostDigits = 15;  // a petabyte; keeps sums far from overflow
constexpr std::int64_t kNone = -1;

struct Ends {
  std::int64_t from = kNone, to = kNone;  // as written; the last `to` bytes where `from` is missing
};

bool is_number(std::string_view text) {
  return text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::int64_t number_of(std::string_view digits) {
  std::int64_t value = kNone;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

std::optional<Ends> parse(std::string_view header) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return std::nullopt;
  header.remove_prefix(kUnit.size());
  const std::size_t dash = header.find('-');
  if (dash == header.npos || header.size() == 1) return std::nullopt;
  const std::string_view from = header.substr(0, dash), to = header.substr(dash + 1);
  if (!is_number(from) || !is_number(to)) return std::nullopt;
  const Ends ends{number_of(from), number_of(to)};
  if (ends.from != kNone && ends.to != kNone && ends.to < ends.from) return std::nullopt;
  return ends;
}

}  // namespace

bool is_byte_range(std::string_view header) {
  return parse(header).has_value();
}

ByteRange byte_range_of(std::string_view header, std::int64_t size) {
  const Ends ends = parse(header).value();
  ByteRange range{ends.from, ends.to == kNone ? size - 1 : std::min(ends.to, size - 1)};
  if (ends.from == kNone) range = {std::max<std::int64_t>(0, size - ends.to), size - 1};
  if (range.first <= range.last) return range;
  throw Problem{416,
                "no_such_range",
                "the file has " + std::to_string(size) + " bytes, none of them in this range",
                {},
                {{"Content-Range", "bytes */" + std::to_string(size)}}};
}

}  // namespace toile::http

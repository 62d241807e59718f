// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/multipart.h"

#include <algorithm>
#include <cctype>

namespace toile::http {

namespace {

[[noreturn]] void malformed(const std::string& detail) {
  throw Problem{400, "malformed_multipart", "the multipart body is broken: " + detail, {}, {}};
}

// The value of `name="..."` in a header line, or empty.
std::string quoted(std::string_view line, std::string_view name) {
  const std::string wanted = "; " + std::string(name) + "=\"";
  const std::size_t begin = line.find(wanted);
  if (begin == std::string_view::npos) return {};
  const std::size_t from = begin + wanted.size(), end = line.find('"', from);
  return end == std::string_view::npos ? std::string() : std::string(line.substr(from, end - from));
}

}  // namespace

MultipartReader::MultipartReader(std::string boundary, MultipartLimits limits, OnPart on_part, OnBytes on_bytes)
    : delimiter_("\r\n--" + std::move(boundary)),
      limits_(limits),
      on_part_(std::move(on_part)),
      on_bytes_(std::move(on_bytes)),
      buffer_("\r\n") {}  // the first boundary has no line before it

void MultipartReader::feed(std::span<const std::uint8_t> bytes) {
  if (state_ == State::End) return;  // the epilogue means nothing
  buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (step()) {
  }
}

void MultipartReader::finish() const {
  if (state_ != State::End) malformed("it ends before its closing boundary");
}

void MultipartReader::begin_part(std::string_view head) {
  if (++parts_ > limits_.parts) throw Problem{413, "limit_exceeded", "too many parts in the multipart body", {}, {}};
  PartHead part;
  for (std::size_t begin = 0; begin < head.size();) {
    const std::size_t end = std::min(head.find("\r\n", begin), head.size());
    const std::string_view line = head.substr(begin, end - begin);
    if (lower_case(line.substr(0, 20)) == "content-disposition:") {
      part.name = quoted(line, "name");
      part.filename = quoted(line, "filename");
    }
    begin = end + 2;
  }
  if (part.name.empty()) malformed("a part has no name");
  on_part_(part);
}

bool MultipartReader::step() {
  switch (state_) {
    case State::Preamble:
    case State::Body: {
      const std::size_t found = buffer_.find(delimiter_);
      const std::size_t safe =
          found != std::string::npos ? found : buffer_.size() - std::min(buffer_.size(), delimiter_.size());
      if (state_ == State::Body && safe > 0)
        on_bytes_(std::span(reinterpret_cast<const std::uint8_t*>(buffer_.data()), safe));
      buffer_.erase(0, found != std::string::npos ? found + delimiter_.size() : safe);
      if (found == std::string::npos) return false;
      state_ = State::AfterBoundary;
      return true;
    }
    case State::AfterBoundary:
      if (buffer_.size() < 2) return false;
      if (!buffer_.starts_with("--") && !buffer_.starts_with("\r\n")) malformed("a boundary is followed by other text");
      state_ = buffer_.starts_with("--") ? State::End : State::Head;
      if (state_ == State::Head) buffer_.erase(0, 2);
      return state_ == State::Head;
    case State::Head: {
      const std::size_t end = buffer_.find("\r\n\r\n");
      if (std::min(end, buffer_.size()) > limits_.head_bytes) malformed("a part's header is too long");
      if (end == std::string::npos) return false;
      begin_part(std::string_view(buffer_).substr(0, end));
      buffer_.erase(0, end + 4);
      state_ = State::Body;
      return true;
    }
    case State::End: return false;
  }
  return false;
}

std::string multipart_boundary(std::string_view content_type) {
  if (lower_case(content_type.substr(0, 19)) != "multipart/form-data") return {};
  const std::size_t at = lower_case(content_type).find("boundary=");
  if (at == std::string::npos) return {};
  std::string_view value = content_type.substr(at + 9);
  value = value.substr(0, value.find(';'));
  if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
  constexpr std::string_view kMarks = "'()+_,-./:=? ";
  const bool legal =
      !value.empty() && value.size() <= 70 && std::all_of(value.begin(), value.end(), [&](unsigned char c) {
        return (c < 128 && std::isalnum(c) != 0) || kMarks.find(static_cast<char>(c)) != std::string_view::npos;
      });
  return legal ? std::string(value) : std::string();
}

}  // namespace toile::http

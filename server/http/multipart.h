// SPDX-License-Identifier: GPL-3.0-or-later
// multipart/form-data as a stream: parts are handed on while they come, nothing is kept but a part's header.
#pragma once

#include "server/http/problem.h"

namespace toile::http {

struct PartHead {
  std::string name;
  std::string filename;  // as the client calls it; never a path to be used
};

struct MultipartLimits {
  std::size_t parts = 32;
  std::size_t head_bytes = 4096;
};

// Throws Problem 400 for a body that is not what its boundary promises, 413 for too many parts.
class MultipartReader {
 public:
  using OnPart = std::function<void(const PartHead&)>;
  using OnBytes = std::function<void(std::span<const std::uint8_t>)>;
  MultipartReader(std::string boundary, MultipartLimits limits, OnPart on_part, OnBytes on_bytes);

  void feed(std::span<const std::uint8_t> bytes);
  void finish() const;  // all has been fed: throws when the closing boundary is missing

 private:
  bool step();
  void begin_part(std::string_view head);

  enum class State { Preamble, AfterBoundary, Head, Body, End } state_ = State::Preamble;
  const std::string delimiter_;  // CR LF -- boundary
  const MultipartLimits limits_;
  const OnPart on_part_;
  const OnBytes on_bytes_;
  std::string buffer_;
  std::size_t parts_ = 0;
};

// The boundary of a Content-Type; empty when it is not multipart/form-data or the boundary is not a legal one.
std::string multipart_boundary(std::string_view content_type);

}  // namespace toile::http

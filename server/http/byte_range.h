// SPDX-License-Identifier: GPL-3.0-or-later
// The Range header of a download: one run of bytes [RFC 9110, Sec. 14].
#pragma once

#include <cstdint>
#include <string_view>

namespace toile::http {

// Both ends included.
struct ByteRange {
  std::int64_t first = 0, last = 0;

  std::int64_t size() const { return last - first + 1; }
};

// Whether the header reads bytes=FROM-TO, bytes=FROM- or bytes=-COUNT, with FROM <= TO.
bool is_byte_range(std::string_view header);

// What it means of a file of `size` bytes; a header that is_byte_range. Throws Problem 416 when none of them is there.
ByteRange byte_range_of(std::string_view header, std::int64_t size);

}  // namespace toile::http

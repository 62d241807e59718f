// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers out of untrusted binary bytes, of either byte order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <string>

#include "engine/core/error.h"

namespace toile {

class ByteReader {
 public:
  ByteReader(std::span<const std::uint8_t> bytes, std::size_t offset, bool big_endian, std::string subject)
      : bytes_(bytes),
        offset_(offset),
        swap_(big_endian != (std::endian::native == std::endian::big)),
        subject_(std::move(subject)) {}

  template <class T>
  T read() {
    require(sizeof(T));
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset_, sizeof(T));
    if (swap_) std::reverse(raw, raw + sizeof(T));
    offset_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  void skip(std::size_t count) {
    require(count);
    offset_ += count;
  }

  std::size_t offset() const { return offset_; }
  std::size_t remaining() const { return bytes_.size() - offset_; }
  std::string place() const { return "byte " + std::to_string(offset_); }

 private:
  void require(std::size_t count) const {
    if (count > remaining())
      throw Error(
          ErrorCode::FileMalformed, subject_,
          place() + ": the file ends here although more is announced; it is cut short, copy or export it again");
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t offset_;
  bool swap_;
  std::string subject_;
};

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 over values: names artifacts by their content and keys finished stages by their inputs.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "engine/core/types.h"

namespace toile {

class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  // Every piece is preceded by its length, so that ("ab","c") and ("a","bc") differ.
  ContentHash& add(std::span<const std::uint8_t> bytes);
  ContentHash& add(std::string_view text);

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> ContentHash& add(T value) {
    return add(std::span(reinterpret_cast<const std::uint8_t*>(&value), sizeof value));
  }

  template <class Derived>
  ContentHash& add(const Eigen::PlainObjectBase<Derived>& matrix) {
    add(static_cast<std::int64_t>(matrix.rows())).add(static_cast<std::int64_t>(matrix.cols()));
    return add(std::span(reinterpret_cast<const std::uint8_t*>(matrix.data()),
                         static_cast<std::size_t>(matrix.size()) * sizeof(typename Derived::Scalar)));
  }

  // 64 hexadecimal digits; ends the hash.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Plain SHA-256 of the bytes (as `sha256sum` prints it), 64 hexadecimal digits.
std::string sha256_hex(std::span<const std::uint8_t> bytes);
std::string sha256_hex(std::string_view text);

}  // namespace toile

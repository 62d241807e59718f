// SPDX-License-Identifier: GPL-3.0-or-later
// Values to bytes and back, exactly: how stage results are stored, resumed from and hashed. A type joins by one
// function
//   template <class A> void archive(A& a, MyType& value) { a(value.first, value.second); }
// found beside the type; the same function writes and reads. Little-endian, no padding, no pointers. A reader checks
// every count against the bytes that are left and throws Error{StorageFailed} instead of trusting them.
#pragma once

#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/ids.h"
#include "engine/core/types.h"

namespace toile {

template <class T>
concept ArchivedAsIs = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T>
concept EigenMatrix = std::is_base_of_v<Eigen::PlainObjectBase<T>, T>;

class ArchiveWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }
  const Bytes& bytes() const { return bytes_; }
  Bytes take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  void count(std::size_t n) { write(static_cast<std::uint64_t>(n)); }

  template <ArchivedAsIs T>
  void write(const T& value) {
    raw(&value, sizeof value);
  }
  template <class Tag>
  void write(const Id<Tag>& id) {
    write(id.value);
  }
  void write(const std::string& text) {
    count(text.size());
    raw(text.data(), text.size());
  }
  template <EigenMatrix M>
  void write(const M& matrix) {
    count(static_cast<std::size_t>(matrix.rows()));
    count(static_cast<std::size_t>(matrix.cols()));
    raw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(typename M::Scalar));
  }
  template <class T>
  void write(const std::vector<T>& values) {
    count(values.size());
    if constexpr (ArchivedAsIs<T> && !std::is_same_v<T, bool>) {
      raw(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) write(value);
    }
  }
  void write(const std::vector<bool>& values) {
    count(values.size());
    for (const bool value : values) write(static_cast<std::uint8_t>(value));
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    for (const T& value : values) write(value);
  }
  template <class A, class B>
  void write(const std::pair<A, B>& both) {
    write(both.first);
    write(both.second);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class K, class V>
  void write(const std::map<K, V>& values) {
    count(values.size());
    for (const auto& entry : values) write(std::pair<K, V>(entry));
  }
  template <class T>
  requires(!ArchivedAsIs<T> && !EigenMatrix<T>) void write(const T& value) {
    archive(*this, const_cast<T&>(value));  // `archive` serves reading too; writing changes nothing
  }

  Bytes bytes_;
};

class ArchiveReader {
 public:
  explicit ArchiveReader(const Bytes& bytes) : next_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }
  bool at_end() const { return next_ == end_; }

 private:
  [[noreturn]] static void fail() {
    throw Error(ErrorCode::StorageFailed, "artifact",
                "the stored stage result is damaged; delete it and run the job again");
  }
  void raw(void* data, std::size_t size) {
    if (size > static_cast<std::size_t>(end_ - next_)) fail();
    if (size) std::memcpy(data, next_, size);
    next_ += size;
  }
  // A count of elements of at least `least_size` bytes each.
  std::size_t count(std::size_t least_size) {
    std::uint64_t n = 0;
    read(n);
    if (n > static_cast<std::size_t>(end_ - next_) / least_size) fail();
    return static_cast<std::size_t>(n);
  }

  template <ArchivedAsIs T>
  void read(T& value) {
    raw(&value, sizeof value);
  }
  template <class Tag>
  void read(Id<Tag>& id) {
    read(id.value);
  }
  void read(std::string& text) {
    text.resize(count(1));
    raw(text.data(), text.size());
  }
  template <EigenMatrix M>
  void read(M& matrix) {
    std::uint64_t rows = 0, cols = 0;
    read(rows);
    read(cols);
    const std::size_t most = static_cast<std::size_t>(end_ - next_) / sizeof(typename M::Scalar);
    if (cols != 0 && rows > most / cols) fail();
    if (M::RowsAtCompileTime != Eigen::Dynamic && rows != static_cast<std::uint64_t>(M::RowsAtCompileTime)) fail();
    if (M::ColsAtCompileTime != Eigen::Dynamic && cols != static_cast<std::uint64_t>(M::ColsAtCompileTime)) fail();
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
    raw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(typename M::Scalar));
  }
  template <class T>
  void read(std::vector<T>& values) {
    if constexpr (ArchivedAsIs<T> && !std::is_same_v<T, bool>) {
      values.resize(count(sizeof(T)));
      raw(values.data(), values.size() * sizeof(T));
    } else {
      values.clear();
      for (std::size_t n = count(1); n > 0; --n) read(values.emplace_back());
    }
  }
  void read(std::vector<bool>& values) {
    values.clear();
    for (std::size_t n = count(1); n > 0; --n) {
      std::uint8_t value = 0;
      read(value);
      values.push_back(value != 0);
    }
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  template <class A, class B>
  void read(std::pair<A, B>& both) {
    read(both.first);
    read(both.second);
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool present = false;
    read(present);
    value.reset();
    if (present) read(value.emplace());
  }
  template <class K, class V>
  void read(std::map<K, V>& values) {
    values.clear();
    for (std::size_t n = count(1); n > 0; --n) {
      std::pair<K, V> entry;
      read(entry);
      values.insert(std::move(entry));
    }
  }
  template <class T>
  requires(!ArchivedAsIs<T> && !EigenMatrix<T>) void read(T& value) { archive(*this, value); }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

template <class T>
Bytes to_bytes(const T& value) {
  ArchiveWriter writer;
  writer(value);
  return writer.take();
}

// Throws Error{StorageFailed} where the bytes are not a whole T.
template <class T>
T from_bytes(const Bytes& bytes) {
  T value;
  ArchiveReader reader(bytes);
  reader(value);
  if (!reader.at_end())
    throw Error(ErrorCode::StorageFailed, "artifact", "the stored stage result has bytes left over");
  return value;
}

}  // namespace toile

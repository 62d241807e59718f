// SPDX-License-Identifier: GPL-3.0-or-later
// Files that survive a power cut: written aside, flushed, then linked under their name, then the folder flushed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "engine/core/types.h"

namespace toile {

// A file written aside, named by its content; removed with its owner. Its bytes are on the disk once prepared.
class PreparedBlob {
 public:
  PreparedBlob(std::string sha256, std::int64_t size, std::filesystem::path file);
  ~PreparedBlob();
  PreparedBlob(PreparedBlob&& other) noexcept;
  PreparedBlob& operator=(PreparedBlob&&) = delete;

  const std::string& sha256() const { return sha256_; }
  std::int64_t size() const { return size_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  std::string sha256_;
  std::int64_t size_;
  std::filesystem::path file_;
};

// Streams bytes into a new file of `folder`, hashing on the way. An unfinished file is removed.
// Throws Error{StorageFull} when the disk is full, Error{StorageFailed} for other failures of it.
class BlobWriter {
 public:
  explicit BlobWriter(const std::filesystem::path& folder);
  ~BlobWriter();
  BlobWriter(const BlobWriter&) = delete;
  BlobWriter& operator=(const BlobWriter&) = delete;

  void write(std::span<const std::uint8_t> bytes);
  std::int64_t size() const { return size_; }
  const std::filesystem::path& file() const { return file_; }
  PreparedBlob finish();

 private:
  struct Hash;
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
  std::unique_ptr<Hash> hash_;
};

// Takes over a finished file (hashes and flushes it).
PreparedBlob prepare_existing(const std::filesystem::path& file);

// Gives `prepared` a second name, `target`; an existing target is left as it is. The folder is flushed by the caller.
void link_blob(const PreparedBlob& prepared, const std::filesystem::path& target);
void flush_folder(const std::filesystem::path& folder);

// Throws Error{StorageFailed} when the file is not there.
Bytes read_whole_file(const std::filesystem::path& file);

}  // namespace toile

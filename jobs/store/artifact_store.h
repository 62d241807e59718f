// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes kept under the name of their content. A file is there before its row; it goes after its last user's row.
#pragma once

#include <span>
#include <vector>

#include "jobs/store/clock.h"
#include "jobs/store/database.h"
#include "jobs/store/durable_file.h"

namespace toile {

class ArtifactStore {
 public:
  // Uses the folders `blobs` and `tmp` of `data`, which it creates.
  ArtifactStore(const std::filesystem::path& data, Database& database, Clock clock);

  const std::filesystem::path& temporary_folder() const { return temporary_; }
  PreparedBlob prepare(std::span<const std::uint8_t> bytes);

  // Puts files under their content's name and flushes the folder; before the transaction that will own them.
  void publish(std::span<const PreparedBlob> blobs);
  // The row, in the transaction that also writes the row of the first user.
  void adopt(Transaction& transaction, const PreparedBlob& blob);
  // Gives up content whose user's row was deleted in this transaction; kept while anything else uses it.
  void release(Transaction& transaction, const std::string& sha256);
  // Removes the files of released content from the disk; after the transaction.
  void empty_trash();
  // Removes leftovers of killed processes: files without a row, and temporary files, last touched before
  // `older_than_ms`.
  void remove_orphans(std::int64_t older_than_ms);

  std::filesystem::path path_of(const std::string& sha256) const;
  // Throws Error{StorageFailed}: the file is missing or was changed on the disk.
  Bytes read(const std::string& sha256) const;

 private:
  std::filesystem::path blobs_;
  std::filesystem::path temporary_;
  Database& database_;
  Clock clock_;
};

}  // namespace toile

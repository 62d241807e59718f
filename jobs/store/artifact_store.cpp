// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/artifact_store.h"

#include <sys/stat.h>
#include <unistd.h>

#include "engine/core/content_hash.h"
#include "engine/core/error.h"
#include "jobs/store/fault_point.h"

namespace toile {

namespace fs = std::filesystem;

namespace {

std::int64_t touched_ms(const fs::path& file) {
  struct stat about {};
  if (::lstat(file.c_str(), &about) != 0) return 0;
  return static_cast<std::int64_t>(about.st_mtim.tv_sec) * 1000 + about.st_mtim.tv_nsec / 1000000;
}

std::vector<fs::path> files_older_than(const fs::path& folder, std::int64_t time_ms) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (touched_ms(entry.path()) < time_ms) files.push_back(entry.path());
  return files;
}

}  // namespace

ArtifactStore::ArtifactStore(const fs::path& data, Database& database, Clock clock)
    : blobs_(data / "blobs"), temporary_(data / "tmp"), database_(database), clock_(std::move(clock)) {
  fs::create_directories(blobs_);
  fs::create_directories(temporary_);
}

PreparedBlob ArtifactStore::prepare(std::span<const std::uint8_t> bytes) {
  BlobWriter writer(temporary_);
  writer.write(bytes);
  return writer.finish();
}

void ArtifactStore::publish(std::span<const PreparedBlob> blobs) {
  if (blobs.empty()) return;
  for (const PreparedBlob& blob : blobs) link_blob(blob, path_of(blob.sha256()));
  flush_folder(blobs_);
}

void ArtifactStore::adopt(Transaction& transaction, const PreparedBlob& blob) {
  // Between publish() and now another process may have emptied its trash of the same content.
  if (::access(path_of(blob.sha256()).c_str(), R_OK) != 0) {
    link_blob(blob, path_of(blob.sha256()));
    flush_folder(blobs_);
  }
  transaction->run("INSERT INTO blobs(sha256, size, created_ms) VALUES (?, ?, ?) ON CONFLICT DO NOTHING", blob.sha256(),
                   blob.size(), clock_());
  transaction->run("DELETE FROM trash WHERE sha256 = ?", blob.sha256());
}

void ArtifactStore::release(Transaction& transaction, const std::string& sha256) {
  const std::int64_t removed = transaction->run(
      "DELETE FROM blobs WHERE sha256 = ?1 AND NOT EXISTS (SELECT 1 FROM inputs WHERE sha256 = ?1)"
      " AND NOT EXISTS (SELECT 1 FROM artifacts WHERE sha256 = ?1)"
      " AND NOT EXISTS (SELECT 1 FROM stages WHERE sha256 = ?1)",
      sha256);
  if (removed > 0) transaction->run("INSERT INTO trash(sha256) VALUES (?) ON CONFLICT DO NOTHING", sha256);
}

void ArtifactStore::empty_trash() {
  // Files are removed under the writer's lock: adopt() looks for its file under the same lock.
  Transaction transaction(database_);
  std::vector<std::string> names;
  {
    Statement rows = transaction->query("SELECT sha256 FROM trash");
    while (rows.step()) names.push_back(rows.text(0));
  }
  if (names.empty()) return;
  for (const std::string& name : names) {
    fault_point("unlink");
    ::unlink(path_of(name).c_str());
  }
  flush_folder(blobs_);
  transaction->run("DELETE FROM trash");
  transaction.commit();
}

void ArtifactStore::remove_orphans(std::int64_t older_than_ms) {
  for (const fs::path& file : files_older_than(temporary_, older_than_ms)) fs::remove_all(file);
  for (const fs::path& file : files_older_than(blobs_, older_than_ms)) {
    {
      Reader reader(database_);
      Statement row = reader->query("SELECT 1 FROM blobs WHERE sha256 = ?", file.filename().string());
      if (row.step()) continue;
    }
    Transaction transaction(database_);
    Statement row = transaction->query("SELECT 1 FROM blobs WHERE sha256 = ?", file.filename().string());
    if (!row.step()) ::unlink(file.c_str());
  }
}

fs::path ArtifactStore::path_of(const std::string& sha256) const {
  return blobs_ / sha256;
}

Bytes ArtifactStore::read(const std::string& sha256) const {
  Bytes bytes = read_whole_file(path_of(sha256));
  if (sha256_hex(bytes) != sha256)
    throw Error(ErrorCode::StorageFailed, "artifacts", "a stored file was changed on the disk: restore a backup");
  return bytes;
}

}  // namespace toile

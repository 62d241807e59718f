// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/stage_store.h"

#include "engine/core/content_hash.h"

namespace toile {

namespace {

constexpr std::int64_t kTouchMs = 3600 * 1000;  // uses are noted once an hour: a read should not cost a write

}  // namespace

StageStore::StageStore(Database& database, ArtifactStore& artifacts, Clock clock)
    : database_(database), artifacts_(artifacts), clock_(std::move(clock)) {}

std::string StageStore::tenant_key(const std::string& tenant, const std::string& key) {
  ContentHash hash;
  return hash.add(std::string_view(tenant)).add(std::string_view(key)).hex();
}

std::optional<std::filesystem::path> StageStore::find(const std::string& key) {
  std::string sha256;
  std::int64_t used = 0;
  {
    Reader reader(database_);
    Statement row = reader->query("SELECT sha256, used_ms FROM stages WHERE key = ?", key);
    if (!row.step()) return std::nullopt;
    sha256 = row.text(0);
    used = row.integer(1);
  }
  if (clock_() - used > kTouchMs) {
    Transaction transaction(database_);
    transaction->run("UPDATE stages SET used_ms = ? WHERE key = ?", clock_(), key);
    transaction.commit();
  }
  return artifacts_.path_of(sha256);
}

void StageStore::add(const std::string& key, const PreparedBlob& blob, const std::vector<std::string>& source_inputs) {
  artifacts_.publish(std::span(&blob, 1));
  Transaction transaction(database_);
  for (const std::string& input : source_inputs) {
    Statement row = transaction->query("SELECT 1 FROM inputs WHERE id = ?", input);
    if (!row.step()) return;
  }
  artifacts_.adopt(transaction, blob);
  const std::int64_t added =
      transaction->run("INSERT INTO stages(key, sha256, size, used_ms) VALUES (?, ?, ?, ?) ON CONFLICT DO NOTHING", key,
                       blob.sha256(), blob.size(), clock_());
  for (const std::string& input : source_inputs)
    transaction->run("INSERT INTO stage_sources(key, input_id) VALUES (?, ?) ON CONFLICT DO NOTHING", key, input);
  if (added == 0) artifacts_.release(transaction, blob.sha256());
  transaction.commit();
}

void StageStore::forget(const std::string& key) {
  Transaction transaction(database_);
  std::string sha256;
  {
    Statement row = transaction->query("SELECT sha256 FROM stages WHERE key = ?", key);
    if (!row.step()) return;
    sha256 = row.text(0);
  }
  transaction->run("DELETE FROM stages WHERE key = ?", key);
  artifacts_.release(transaction, sha256);
  transaction.commit();
}

int StageStore::evict(std::int64_t before_ms, std::int64_t max_bytes) {
  std::vector<std::string> keys;
  {
    Reader reader(database_);
    std::int64_t kept = 0;
    Statement rows = reader->query("SELECT key, size, used_ms FROM stages ORDER BY used_ms DESC");
    while (rows.step()) {
      kept += rows.integer(1);
      if (rows.integer(2) < before_ms || kept > max_bytes) keys.push_back(rows.text(0));
    }
  }
  for (const std::string& key : keys) forget(key);
  return static_cast<int>(keys.size());
}

}  // namespace toile

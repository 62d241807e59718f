// SPDX-License-Identifier: GPL-3.0-or-later
// Finished stages kept under their key, each tied to the inputs it was made from, so that it goes when they go.
#pragma once

#include "jobs/store/artifact_store.h"

namespace toile {

class StageStore {
 public:
  StageStore(Database& database, ArtifactStore& artifacts, Clock clock);

  // Tenants do not share stages: a key of one never answers to another.
  static std::string tenant_key(const std::string& tenant, const std::string& key);

  // The file that holds the stage's bytes, if it is known; `key` of tenant_key().
  std::optional<std::filesystem::path> find(const std::string& key);
  // Keeps a stage; ignored when the key is known or a source was deleted meanwhile.
  void add(const std::string& key, const PreparedBlob& blob, const std::vector<std::string>& source_inputs);
  // Forgets stages not used since `before_ms`, and the longest unused ones beyond `max_bytes` in all.
  int evict(std::int64_t before_ms, std::int64_t max_bytes);

 private:
  void forget(const std::string& key);

  Database& database_;
  ArtifactStore& artifacts_;
  Clock clock_;
};

}  // namespace toile

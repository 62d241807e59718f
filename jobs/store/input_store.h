// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and garments a tenant has handed in. Equal bytes with equal fields are one input.
#pragma once

#include "jobs/store/artifact_store.h"
#include "jobs/store/job.h"

namespace toile {

enum class InputKind { Body, Garment };
std::string_view kind_name(InputKind kind);  // "body", "garment"

struct NewInput {
  std::string tenant;
  InputKind kind = InputKind::Body;
  std::string name;
  std::string fields = "{}";  // JSON: how the bytes are to be read (unit, up, landmarks, format)
  std::string about = "{}";   // JSON: what the import found (counts, measurements)
  std::vector<std::string> labels;
};

struct Input {
  std::int64_t sequence = 0;
  std::string id;
  std::string tenant;
  InputKind kind = InputKind::Body;
  std::string name;
  std::string fields;
  std::string about;
  std::string sha256;
  std::int64_t size = 0;
  std::int64_t created_ms = 0;
  std::vector<std::string> labels;
};

struct InputFilter {
  std::optional<std::string> label;
  std::int64_t before = 0;  // only inputs that came before this sequence number; 0: from the newest
  int limit = 50;
};

class InputStore {
 public:
  InputStore(Database& database, ArtifactStore& artifacts, Clock clock);

  // Hash of what makes two inputs one: the bytes and how they are read.
  static std::string identity(const NewInput& input, const std::string& sha256);

  // The known input, with `labels` added to it; or nothing.
  std::optional<Input> find_equal(const NewInput& input, const std::string& sha256);
  // The stored input; second: whether it is new. `blob` was published.
  std::pair<Input, bool> add(Transaction& transaction, const NewInput& input, const PreparedBlob& blob);

  std::optional<Input> find(const std::string& tenant, InputKind kind, const std::string& id) const;
  std::optional<Input> find(const std::string& tenant, const std::string& id) const;
  std::vector<Input> list(const std::string& tenant, InputKind kind, const InputFilter& filter) const;  // newest first

 private:
  Database& database_;
  ArtifactStore& artifacts_;
  Clock clock_;
};

}  // namespace toile

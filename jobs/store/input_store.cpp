// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/input_store.h"

#include "engine/core/content_hash.h"
#include "jobs/store/identifier.h"

namespace toile {

namespace {

#define TOILE_INPUT_COLUMNS "seq, id, tenant, kind, name, fields, about, sha256, size, created_ms"

Input input_of_row(const Statement& row) {
  Input input;
  input.sequence = row.integer(0);
  input.id = row.text(1);
  input.tenant = row.text(2);
  input.kind = row.text(3) == "body" ? InputKind::Body : InputKind::Garment;
  input.name = row.text(4);
  input.fields = row.text(5);
  input.about = row.text(6);
  input.sha256 = row.text(7);
  input.size = row.integer(8);
  input.created_ms = row.integer(9);
  return input;
}

void read_labels(Connection& connection, Input& input) {
  Statement rows = connection.query("SELECT label FROM input_labels WHERE input_id = ? ORDER BY label", input.id);
  while (rows.step()) input.labels.push_back(rows.text(0));
}

std::optional<Input> with_labels(Connection& connection, Statement rows) {
  if (!rows.step()) return std::nullopt;
  Input input = input_of_row(rows);
  read_labels(connection, input);
  return input;
}

}  // namespace

std::string_view kind_name(InputKind kind) {
  return kind == InputKind::Body ? "body" : "garment";
}

InputStore::InputStore(Database& database, ArtifactStore& artifacts, Clock clock)
    : database_(database), artifacts_(artifacts), clock_(std::move(clock)) {}

std::string InputStore::identity(const NewInput& input, const std::string& sha256) {
  ContentHash hash;
  return hash.add(kind_name(input.kind)).add(std::string_view(sha256)).add(std::string_view(input.fields)).hex();
}

std::optional<Input> InputStore::find_equal(const NewInput& input, const std::string& sha256) {
  Reader reader(database_);
  return with_labels(*reader.operator->(), reader->query("SELECT " TOILE_INPUT_COLUMNS
                                                         " FROM inputs WHERE tenant = ? AND kind = ? AND identity = ?",
                                                         input.tenant, kind_name(input.kind), identity(input, sha256)));
}

std::pair<Input, bool> InputStore::add(Transaction& transaction, const NewInput& input, const PreparedBlob& blob) {
  const std::string key = identity(input, blob.sha256());
  artifacts_.adopt(transaction, blob);
  const bool is_new =
      transaction->run(
          "INSERT INTO inputs(id, tenant, kind, identity, name, fields, about, sha256, size, created_ms)"
          " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT (tenant, kind, identity) DO NOTHING",
          random_identifier(kind_name(input.kind)), input.tenant, kind_name(input.kind), key, input.name, input.fields,
          input.about, blob.sha256(), blob.size(), clock_()) > 0;
  const auto stored = [&] {
    return *with_labels(*transaction, transaction->query("SELECT " TOILE_INPUT_COLUMNS
                                                         " FROM inputs WHERE tenant = ? AND kind = ? AND identity = ?",
                                                         input.tenant, kind_name(input.kind), key));
  };
  const std::string id = stored().id;
  for (const std::string& label : input.labels)
    transaction->run("INSERT INTO input_labels(input_id, label) VALUES (?, ?) ON CONFLICT DO NOTHING", id, label);
  return {stored(), is_new};
}

std::optional<Input> InputStore::find(const std::string& tenant, const std::string& id) const {
  Reader reader(database_);
  return with_labels(
      *reader.operator->(),
      reader->query("SELECT " TOILE_INPUT_COLUMNS " FROM inputs WHERE tenant = ? AND id = ?", tenant, id));
}

std::optional<Input> InputStore::find(const std::string& tenant, InputKind kind, const std::string& id) const {
  std::optional<Input> input = find(tenant, id);
  if (input && input->kind != kind) return std::nullopt;
  return input;
}

std::vector<Input> InputStore::list(const std::string& tenant, InputKind kind, const InputFilter& filter) const {
  Reader reader(database_);
  std::vector<Input> inputs;
  {
    Statement rows = reader->query(
        "SELECT " TOILE_INPUT_COLUMNS
        " FROM inputs WHERE tenant = ?1 AND kind = ?2 AND (?3 = 0 OR seq < ?3) AND (?4 IS NULL OR EXISTS"
        " (SELECT 1 FROM input_labels WHERE input_id = inputs.id AND label = ?4)) ORDER BY seq DESC LIMIT ?5",
        tenant, kind_name(kind), filter.before, filter.label, filter.limit);
    while (rows.step()) inputs.push_back(input_of_row(rows));
  }
  for (Input& input : inputs) read_labels(*reader.operator->(), input);
  return inputs;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/batch_store.h"

#include "jobs/store/identifier.h"
#include "jobs/store/json_text.h"

namespace toile {

namespace {

#define TOILE_BATCH_COLUMNS "seq, id, tenant, options, labels, garment, reference_body, created_ms"

Batch batch_of_row(const Statement& row) {
  return {row.integer(0), row.text(1),          row.text(2),   row.text(3), words_of_json(row.text(4)),
          row.text(5),    row.optional_text(6), row.integer(7)};
}

}  // namespace

std::string add_batch(Transaction& transaction, const Batch& batch, std::int64_t now_ms) {
  const std::string id = random_identifier("batch");
  transaction->run(
      "INSERT INTO batches(id, tenant, options, labels, garment, reference_body, created_ms) VALUES (?, ?, ?, ?, ?, ?, "
      "?)",
      id, batch.tenant, batch.options, json_of_words(batch.labels), batch.garment, batch.reference_body, now_ms);
  return id;
}

std::optional<Batch> find_batch(Database& database, const std::string& tenant, const std::string& id) {
  Reader reader(database);
  Statement row = reader->query("SELECT " TOILE_BATCH_COLUMNS " FROM batches WHERE id = ? AND tenant = ?", id, tenant);
  return row.step() ? std::optional(batch_of_row(row)) : std::nullopt;
}

std::vector<Batch> list_batches(Database& database, const std::string& tenant, std::int64_t before, int limit) {
  Reader reader(database);
  std::vector<Batch> batches;
  Statement rows = reader->query("SELECT " TOILE_BATCH_COLUMNS
                                 " FROM batches WHERE tenant = ?1 AND (?2 = 0 OR seq < ?2) ORDER BY seq DESC LIMIT ?3",
                                 tenant, before, limit);
  while (rows.step()) batches.push_back(batch_of_row(rows));
  return batches;
}

std::map<JobState, std::int64_t> count_batch_jobs(Database& database, const std::string& batch) {
  Reader reader(database);
  std::map<JobState, std::int64_t> counts;
  Statement rows = reader->query("SELECT state, count(*) FROM jobs WHERE batch_id = ? GROUP BY state", batch);
  while (rows.step()) counts[state_of_name(rows.text(0))] = rows.integer(1);
  return counts;
}

}  // namespace toile

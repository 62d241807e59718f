// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/request_memory.h"

namespace toile {

std::optional<RememberedRequest> recall_request(Database& database, const std::string& tenant, const std::string& key) {
  Reader reader(database);
  Statement row =
      reader->query("SELECT request_hash, status, resource FROM idempotency WHERE tenant = ? AND key = ?", tenant, key);
  if (!row.step()) return std::nullopt;
  return RememberedRequest{row.text(0), static_cast<int>(row.integer(1)), row.text(2)};
}

void remember_request(Transaction& transaction, const std::string& tenant, const std::string& key,
                      const RememberedRequest& request, std::int64_t now_ms) {
  transaction->run(
      "INSERT INTO idempotency(tenant, key, request_hash, status, resource, created_ms) VALUES (?, ?, ?, ?, ?, ?)",
      tenant, key, request.request_hash, request.status, request.resource, now_ms);
}

}  // namespace toile

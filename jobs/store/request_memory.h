// SPDX-License-Identifier: GPL-3.0-or-later
// Idempotency-Key: which request made which resource, written in the transaction that made it.
#pragma once

#include "jobs/store/clock.h"
#include "jobs/store/database.h"

namespace toile {

struct RememberedRequest {
  std::string request_hash;
  int status = 0;
  std::string resource;  // id of what was made
};

std::optional<RememberedRequest> recall_request(Database& database, const std::string& tenant, const std::string& key);
void remember_request(Transaction& transaction, const std::string& tenant, const std::string& key,
                      const RememberedRequest& request, std::int64_t now_ms);

}  // namespace toile

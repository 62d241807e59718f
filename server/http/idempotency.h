// SPDX-License-Identifier: GPL-3.0-or-later
// Idempotency-Key: one key makes one thing, however often it is sent.
#pragma once

#include "jobs/store/request_memory.h"
#include "server/http/service.h"

namespace toile::http {

// Holds the key while the request is worked on. Throws Problem: 400 bad key, 409 the same key is being worked on now,
// 422 the key was used for another payload.
class Idempotency {
 public:
  Idempotency(Service& service, const Request& request, const std::string& payload);
  ~Idempotency();
  Idempotency(const Idempotency&) = delete;
  Idempotency& operator=(const Idempotency&) = delete;

  // What the first request with this key made.
  const std::optional<RememberedRequest>& remembered() const { return remembered_; }
  // In the transaction that makes the thing; nothing happens without a key.
  void remember(Transaction& transaction, int status, const std::string& resource) const;

 private:
  Service& service_;
  std::string tenant_, key_, hash_;
  bool held_ = false;
  std::optional<RememberedRequest> remembered_;
};

}  // namespace toile::http

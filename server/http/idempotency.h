// SPDX-License-Identifier: GPL-3.0-or-later
// Idempotency-Key: one key makes one thing, however often it is sent.
#pragma once

#include "jobs/store/request_memory.h"
#include "server/http/service.h"

namespace toile::http {

// A key that is being worked on, until the end of its scope, however that is left. Throws Problem 409 when it is
// already.
class KeyInFlight {
 public:
  KeyInFlight(const std::string& tenant, const std::string& key);
  ~KeyInFlight();
  KeyInFlight(const KeyInFlight&) = delete;
  KeyInFlight& operator=(const KeyInFlight&) = delete;

 private:
  std::pair<std::string, std::string> names_;
};

// Holds the key while the request is worked on. Throws Problem: 400 bad key, 409 the same key is being worked on now,
// 422 the key was used for another payload.
class Idempotency {
 public:
  Idempotency(Service& service, const Request& request, const std::string& payload);

  // What the first request with this key made.
  const std::optional<RememberedRequest>& remembered() const { return remembered_; }
  // In the transaction that makes the thing; nothing happens without a key.
  void remember(Transaction& transaction, int status, const std::string& resource) const;

 private:
  Service& service_;
  std::string tenant_, key_, hash_;
  std::optional<KeyInFlight> held_;
  std::optional<RememberedRequest> remembered_;
};

}  // namespace toile::http

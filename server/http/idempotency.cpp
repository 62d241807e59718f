// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/idempotency.h"

#include "engine/core/content_hash.h"

namespace toile::http {

namespace {

constexpr std::size_t kMaxKeyBytes = 255;

std::mutex in_flight_lock;
std::set<std::pair<std::string, std::string>> in_flight;  // tenant and key

}  // namespace

KeyInFlight::KeyInFlight(const std::string& tenant, const std::string& key) : names_(tenant, key) {
  const std::lock_guard lock(in_flight_lock);
  if (!in_flight.insert(names_).second)
    throw Problem{
        409, "conflict", "a request with this Idempotency-Key is being worked on", {}, {{"Retry-After", "1"}}};
}

KeyInFlight::~KeyInFlight() {
  const std::lock_guard lock(in_flight_lock);
  in_flight.erase(names_);
}

Idempotency::Idempotency(Service& service, const Request& request, const std::string& payload)
    : service_(service), tenant_(request.tenant), key_(request.header("Idempotency-Key")) {
  if (key_.empty()) return;
  if (key_.size() > kMaxKeyBytes)
    throw Problem{400, "bad_usage", "an Idempotency-Key has at most 255 characters", {}, {}};
  hash_ = ContentHash().add(std::string_view(request.path)).add(std::string_view(payload)).hex();
  held_.emplace(tenant_, key_);
  remembered_ = recall_request(service.store.database, tenant_, key_);
  if (remembered_ && remembered_->request_hash != hash_)
    throw Problem{422, "conflict", "this Idempotency-Key was used for another request", {}, {}};
}

void Idempotency::remember(Transaction& transaction, int status, const std::string& resource) const {
  if (key_.empty()) return;
  remember_request(transaction, tenant_, key_, {hash_, status, resource}, service_.store.clock());
}

}  // namespace toile::http

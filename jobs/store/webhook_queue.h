// SPDX-License-Identifier: GPL-3.0-or-later
// Messages about ended jobs that still have to be delivered. Written in the transaction that ends the job, so that none
// is lost; delivered at least once under one message id.
#pragma once

#include "jobs/store/clock.h"
#include "jobs/store/database.h"

namespace toile {

struct WebhookMessage {
  std::string id;
  std::string job;
  std::string tenant;
  std::string url;
  int attempt = 0;  // deliveries tried before
};

class WebhookQueue {
 public:
  WebhookQueue(Database& database, Clock clock) : database_(database), clock_(std::move(clock)) {}

  // The next due message, kept from other senders for `hold_ms`.
  std::optional<WebhookMessage> take(std::int64_t hold_ms);
  void delivered(const std::string& id);
  // Waits 5 s, 5 min, 30 min, 2 h, 5 h, 10 h, 14 h, 20 h, 24 h after the tries; after the last the message is dropped.
  void failed(const WebhookMessage& message);

 private:
  Database& database_;
  Clock clock_;
};

}  // namespace toile

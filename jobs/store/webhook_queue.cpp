// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/webhook_queue.h"

#include <array>

namespace toile {

namespace {

constexpr std::array<std::int64_t, 9> kWaitsMs = {5000,     300000,   1800000,  7200000, 18000000,
                                                  36000000, 50400000, 72000000, 86400000};

}  // namespace

std::optional<WebhookMessage> WebhookQueue::take(std::int64_t hold_ms) {
  const std::int64_t now = clock_();
  {
    Reader reader(database_);
    Statement row = reader->query("SELECT 1 FROM webhooks WHERE next_ms <= ? LIMIT 1", now);
    if (!row.step()) return std::nullopt;
  }
  Transaction transaction(database_);
  WebhookMessage message;
  {
    Statement row = transaction->query(
        "SELECT webhooks.id, job_id, tenant, url, webhooks.attempt FROM webhooks JOIN jobs ON jobs.id = job_id"
        " WHERE next_ms <= ? ORDER BY next_ms LIMIT 1",
        now);
    if (!row.step()) return std::nullopt;
    message = {row.text(0), row.text(1), row.text(2), row.text(3), static_cast<int>(row.integer(4))};
  }
  transaction->run("UPDATE webhooks SET next_ms = ? WHERE id = ?", now + hold_ms, message.id);
  transaction.commit();
  return message;
}

void WebhookQueue::delivered(const std::string& id) {
  Transaction transaction(database_);
  transaction->run("DELETE FROM webhooks WHERE id = ?", id);
  transaction.commit();
}

void WebhookQueue::failed(const WebhookMessage& message) {
  if (message.attempt >= static_cast<int>(kWaitsMs.size())) return delivered(message.id);
  Transaction transaction(database_);
  transaction->run("UPDATE webhooks SET attempt = attempt + 1, next_ms = ? WHERE id = ?",
                   clock_() + kWaitsMs[static_cast<std::size_t>(message.attempt)], message.id);
  transaction.commit();
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
// Tells the world about ended jobs, as Standard Webhooks: webhook-id, webhook-timestamp, and webhook-signature
// "v1," + base64(HMAC-SHA256(secret, id.timestamp.body)). Delivered at least once; the id stays the same over retries.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/http/service.h"

namespace toile::http {

struct WebhookOptions {
  std::string secret;          // bytes of the key
  bool private_hosts = false;  // let messages go to private, loopback and link-local addresses
  int timeout_s = 10;
};

// "whsec_" + base64, as Standard Webhooks write it, or any other text taken as it is. Throws Error{OptionInvalid} when
// shorter than 16 bytes.
std::string webhook_key(const std::string& text);
std::string webhook_signature(const std::string& key, const std::string& id, std::int64_t timestamp,
                              const std::string& body);

// Throws Error{OptionInvalid} with subject "/webhook": not an http(s) URL, or (unless allowed) one of a private host.
void check_webhook_url(const std::string& url, bool private_hosts);

class WebhookSender {
 public:
  WebhookSender(Service& service, WebhookOptions options);
  ~WebhookSender();
  WebhookSender(const WebhookSender&) = delete;
  WebhookSender& operator=(const WebhookSender&) = delete;

 private:
  void run();
  bool deliver(const WebhookMessage& message) const;

  Service& service_;
  const WebhookOptions options_;
  std::mutex lock_;
  std::condition_variable stop_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace toile::http

// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/webhook_sender.h"

#include <array>

#include <arpa/inet.h>
#include <httplib.h>
#include <netdb.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include "server/http/documents.h"

namespace toile::http {

namespace {

constexpr std::chrono::milliseconds kSendEvery{200};
constexpr std::int64_t kHoldMs = 60000;  // longer than a delivery can take
constexpr std::size_t kMinKeyBytes = 16;

struct Target {
  std::string origin;  // scheme://host:port
  std::string host;
  std::string path;
};

Target target_of(const std::string& url) {
  const std::size_t scheme = url.starts_with("http://") ? 7 : url.starts_with("https://") ? 8 : 0;
  const std::size_t slash = url.find('/', scheme);
  const std::string authority = url.substr(scheme, slash == std::string::npos ? slash : slash - scheme);
  const bool plain = url.find_first_of(" \t\r\n\"<>\\@") == std::string::npos && url.size() <= 2000;
  if (scheme == 0 || authority.empty() || !plain)
    throw Error(ErrorCode::OptionInvalid, "/webhook", "a webhook is an http:// or https:// address without user name");
  const std::size_t colon = authority.rfind(':');
  const bool bracketed = authority.front() == '[';
  std::string host = authority;
  if (bracketed)
    host = authority.substr(1, authority.find(']') - 1);
  else if (colon != std::string::npos)
    host = authority.substr(0, colon);
  return {url.substr(0, scheme) + authority, host, slash == std::string::npos ? "/" : url.substr(slash)};
}

bool is_private_v4(std::uint32_t address) {
  const auto in = [&](std::uint32_t network, int bits) { return (address >> (32 - bits)) == (network >> (32 - bits)); };
  return in(0x00000000, 8) || in(0x0a000000, 8) || in(0x64400000, 10) || in(0x7f000000, 8) || in(0xa9fe0000, 16) ||
         in(0xac100000, 12) || in(0xc0a80000, 16) || in(0xe0000000, 3);
}

bool is_private(const sockaddr* address) {
  if (address->sa_family == AF_INET)
    return is_private_v4(ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr));
  const auto* bytes = reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr.s6_addr;
  const bool mapped =
      std::all_of(bytes, bytes + 10, [](auto b) { return b == 0; }) && bytes[10] == 0xff && bytes[11] == 0xff;
  if (mapped)
    return is_private_v4(static_cast<std::uint32_t>(bytes[12]) << 24 | static_cast<std::uint32_t>(bytes[13]) << 16 |
                         static_cast<std::uint32_t>(bytes[14]) << 8 | bytes[15]);
  return (bytes[0] & 0xe0) != 0x20;  // only 2000::/3 is the public network
}

// The addresses of a host; the first of them when all are public or private ones are allowed.
std::string usable_address(const std::string& host, bool private_hosts) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0 || !found)
    throw Error(ErrorCode::OptionInvalid, "/webhook", "the webhook's host has no address");
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  for (const addrinfo* one = found; one && !private_hosts; one = one->ai_next)
    if (is_private(one->ai_addr))
      throw Error(ErrorCode::OptionInvalid, "/webhook",
                  "webhooks to private addresses are off: the server needs --webhook-private");
  std::array<char, NI_MAXHOST> text{};
  ::getnameinfo(found->ai_addr, found->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
  return text.data();
}

std::string base64(const unsigned char* bytes, std::size_t count) {
  std::string text(4 * ((count + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes, static_cast<int>(count));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

}  // namespace

std::string webhook_key(const std::string& given) {
  std::string text = given;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  std::string key = text;
  if (text.starts_with("whsec_")) {
    const std::string encoded = text.substr(6);
    key.assign(encoded.size(), '\0');
    const int length =
        EVP_DecodeBlock(reinterpret_cast<unsigned char*>(key.data()),
                        reinterpret_cast<const unsigned char*>(encoded.data()), static_cast<int>(encoded.size()));
    if (length < 0) throw Error(ErrorCode::OptionInvalid, "webhook-secret", "what follows whsec_ is not base64");
    const std::size_t padding = encoded.size() - encoded.find_last_not_of('=') - 1;
    key.resize(static_cast<std::size_t>(length) - padding);
  }
  if (key.size() < kMinKeyBytes)
    throw Error(ErrorCode::OptionInvalid, "webhook-secret", "the secret must have at least 16 bytes");
  return key;
}

std::string webhook_signature(const std::string& key, const std::string& id, std::int64_t timestamp,
                              const std::string& body) {
  const std::string text = id + "." + std::to_string(timestamp) + "." + body;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), reinterpret_cast<const unsigned char*>(text.data()),
       text.size(), digest.data(), &length);
  return "v1," + base64(digest.data(), length);
}

void check_webhook_url(const std::string& url, bool private_hosts) {
  const Target target = target_of(url);
  if (!private_hosts) usable_address(target.host, false);
}

WebhookSender::WebhookSender(Service& service, WebhookOptions options)
    : service_(service), options_(std::move(options)), thread_([this] { run(); }) {}

WebhookSender::~WebhookSender() {
  {
    const std::lock_guard lock(lock_);
    stopping_ = true;
  }
  stop_.notify_all();
  thread_.join();
}

bool WebhookSender::deliver(const WebhookMessage& message) const {
  const std::optional<Job> job = service_.store.jobs.find(message.tenant, message.job);
  if (!job) return true;
  try {
    const Target target = target_of(message.url);
    const std::string address = usable_address(target.host, options_.private_hosts);
    const std::int64_t now = service_.store.clock() / 1000;
    const std::string body = text_of({{"type", "job." + std::string(state_name(job->state))},
                                      {"timestamp", iso_time(service_.store.clock())},
                                      {"data", job_document(*job)}});
    httplib::Client client(target.origin);
    // The address that was checked is the one that is called: a name may answer differently the next time.
    client.set_hostname_addr_map({{target.host, address}});
    client.set_connection_timeout(options_.timeout_s);
    client.set_read_timeout(options_.timeout_s);
    client.set_write_timeout(options_.timeout_s);
    client.set_follow_location(false);
    const httplib::Headers headers = {{"webhook-id", message.id},
                                      {"webhook-timestamp", std::to_string(now)},
                                      {"webhook-signature", webhook_signature(options_.secret, message.id, now, body)}};
    const httplib::Result result = client.Post(target.path, headers, body, "application/json");
    return result && result->status >= 200 && result->status < 300;
  } catch (const Error&) {
    return false;
  }
}

void WebhookSender::run() {
  for (;;) {
    {
      std::unique_lock lock(lock_);
      stop_.wait_for(lock, kSendEvery, [&] { return stopping_; });
      if (stopping_) return;
    }
    try {
      while (const auto message = service_.store.webhooks.take(kHoldMs)) {
        const bool delivered = deliver(*message);
        delivered ? service_.store.webhooks.delivered(message->id) : service_.store.webhooks.failed(*message);
        service_.metrics.count_webhook(delivered);
        service_.log("webhook",
                     {{"job", message->job}, {"message", message->id}, {"delivered", delivered ? "yes" : "no"}});
        const std::lock_guard lock(lock_);
        if (stopping_) return;
      }
    } catch (const Error& error) {
      service_.log("webhook_failed", {{"message", error.message}});
    }
  }
}

}  // namespace toile::http

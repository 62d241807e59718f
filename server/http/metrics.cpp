// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/metrics.h"

#include <algorithm>
#include <sstream>

namespace toile::http {

void Metrics::count_request(const std::string& method, const std::string& route, int status, double seconds) {
  const std::lock_guard lock(lock_);
  ++requests_[{method, route, status}];
  const auto* bound = std::lower_bound(kBounds.begin(), kBounds.end(), seconds);
  ++durations_[static_cast<std::size_t>(bound - kBounds.begin())];
  total_seconds_ += seconds;
}

void Metrics::count_refusal(const std::string& code) {
  const std::lock_guard lock(lock_);
  ++refusals_[code];
}

void Metrics::count_webhook(bool delivered) {
  const std::lock_guard lock(lock_);
  ++webhooks_[delivered ? 1 : 0];
}

std::string Metrics::text() const {
  const std::lock_guard lock(lock_);
  std::ostringstream out;
  out << "# HELP toile_http_requests_total Requests answered.\n# TYPE toile_http_requests_total counter\n";
  for (const auto& [key, count] : requests_)
    out << "toile_http_requests_total{method=\"" << std::get<0>(key) << "\",route=\"" << std::get<1>(key)
        << "\",status=\"" << std::get<2>(key) << "\"} " << count << '\n';
  out << "# HELP toile_http_refusals_total Requests refused at the door.\n# TYPE toile_http_refusals_total counter\n";
  for (const auto& [code, count] : refusals_)
    out << "toile_http_refusals_total{code=\"" << code << "\"} " << count << '\n';
  out << "# HELP toile_http_request_seconds Time to answer.\n# TYPE toile_http_request_seconds histogram\n";
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kBounds.size(); ++i) {
    sum += durations_[i];
    out << "toile_http_request_seconds_bucket{le=\"" << kBounds[i] << "\"} " << sum << '\n';
  }
  sum += durations_.back();
  out << "toile_http_request_seconds_bucket{le=\"+Inf\"} " << sum << "\ntoile_http_request_seconds_sum "
      << total_seconds_ << "\ntoile_http_request_seconds_count " << sum << '\n';
  out << "# HELP toile_webhooks_total Webhook deliveries tried.\n# TYPE toile_webhooks_total counter\n"
      << "toile_webhooks_total{delivered=\"false\"} " << webhooks_[0] << "\ntoile_webhooks_total{delivered=\"true\"} "
      << webhooks_[1] << '\n';
  return out.str();
}

}  // namespace toile::http

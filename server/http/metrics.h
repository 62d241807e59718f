// SPDX-License-Identifier: GPL-3.0-or-later
// Counters and a histogram of answer times, as Prometheus text.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace toile::http {

class Metrics {
 public:
  // `route` is the pattern, not the address: few values.
  void count_request(const std::string& method, const std::string& route, int status, double seconds);
  void count_refusal(const std::string& code);
  void count_webhook(bool delivered);
  std::string text() const;

 private:
  static constexpr std::array kBounds = {0.001, 0.005, 0.025, 0.1, 0.5, 2.5, 10.0, 60.0};

  mutable std::mutex lock_;
  std::map<std::tuple<std::string, std::string, int>, std::uint64_t> requests_;
  std::map<std::string, std::uint64_t> refusals_;
  std::array<std::uint64_t, kBounds.size() + 1> durations_{};
  double total_seconds_ = 0.0;
  std::array<std::uint64_t, 2> webhooks_{};
};

}  // namespace toile::http

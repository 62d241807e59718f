// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/waiting.h"

#include <algorithm>
#include <charconv>

namespace toile::http {

namespace {

using Steady = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLookEvery{40};

std::optional<int> number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end != text.data() && value >= 0 ? std::optional(value) : std::nullopt;
}

}  // namespace

Job wait_for_job(Service& service, const std::string& tenant, const std::string& id, double seconds,
                 const std::function<bool(const Job&)>& enough) {
  const auto until =
      Steady::now() + std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(seconds));
  const Seat seat(service.waiting, service.options.max_waiting);
  for (;;) {
    const std::optional<Job> job = service.store.jobs.find(tenant, id);
    if (!job) throw not_found("job");
    if (enough(*job) || !seat || service.stopping || Steady::now() >= until) return *job;
    std::this_thread::sleep_for(kLookEvery);
  }
}

int wait_seconds(const Service& service, const Request& request) {
  std::optional<int> wanted;
  if (const auto parameter = request.parameter("wait")) {
    wanted = number(*parameter);
    if (!wanted) throw invalid("wait", "`wait` is a whole number of seconds");
  } else {
    const std::string prefer = request.header("Prefer");
    const std::size_t at = prefer.find("wait=");
    if (at != std::string::npos) wanted = number(std::string_view(prefer).substr(at + 5));
  }
  return std::min(wanted.value_or(0), service.options.max_wait_s);
}

}  // namespace toile::http

// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/json_log.h"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "jobs/store/clock.h"
#include "server/http/documents.h"

namespace toile::app {

EventLog json_log() {
  return [](const std::string& event, const std::map<std::string, std::string>& details) {
    nlohmann::ordered_json line = {{"time", http::iso_time(system_clock_ms())}, {"event", event}};
    for (const auto& [name, value] : details)
      if (!value.empty()) line[name] = value;
    const std::string text = http::text_of(line) + "\n";
    // One write, so that lines of threads and processes do not mix; a full pipe loses a line rather than a job.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  };
}

}  // namespace toile::app

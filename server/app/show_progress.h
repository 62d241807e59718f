// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of a job on standard error: a bar on a terminal, one line a stage otherwise, or JSON lines.
#pragma once

#include <string_view>

namespace toile::app {

void show_progress(std::string_view stage, double fraction);
void log_progress_json(std::string_view stage, double fraction);

}  // namespace toile::app

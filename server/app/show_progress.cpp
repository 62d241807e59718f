// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/show_progress.h"

#include <array>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include <unistd.h>

namespace toile::app {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kWords = {{
    {"import_pattern", "reading the garment"},
    {"import_body", "reading the body"},
    {"mesh_panels", "laying out the panels"},
    {"drape", "putting it on"},
    {"import_target_body", "reading the target body"},
    {"register_bodies", "comparing the bodies"},
    {"transport_garment", "carrying it over"},
    {"drape_before", "trying it on unaltered"},
    {"derive_pattern", "finding the pattern"},
    {"alter_pattern", "choosing alterations"},
    {"drape_altered", "trying it on altered"},
}};

std::string_view words_of(std::string_view stage) {
  for (const auto& [name, words] : kWords)
    if (name == stage) return words;
  return stage;
}

}  // namespace

// Two stages may run at the same time and report in turn: each begins a line once, the last line tells how far all is.
void show_progress(std::string_view stage, double fraction) {
  static std::set<std::string, std::less<>> begun;
  static std::string words;
  static int last_percent = -1;
  const int percent = static_cast<int>(fraction * 100);
  const bool first = begun.find(stage) == begun.end();
  if (!first && percent == last_percent) return;
  if (first) {
    if (isatty(STDERR_FILENO) && !begun.empty() && last_percent < 100) std::fputc('\n', stderr);
    begun.emplace(stage);
    words = words_of(stage);
  }
  if (isatty(STDERR_FILENO)) {
    const std::string filled(static_cast<std::size_t>(percent) * 30 / 100, '#');
    std::fprintf(stderr, "\r%-24s [%-30s] %3d %%", words.c_str(), filled.c_str(), percent);
    if (percent >= 100) std::fputc('\n', stderr);
  } else if (first) {
    std::fprintf(stderr, "%s\n", words.c_str());
  }
  last_percent = percent;
}

void log_progress_json(std::string_view stage, double fraction) {
  std::fprintf(stderr, "{\"event\":\"progress\",\"stage\":\"%.*s\",\"fraction\":%.3f}\n",
               static_cast<int>(stage.size()), stage.data(), fraction);
}

}  // namespace toile::app

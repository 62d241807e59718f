// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include <unistd.h>

#include "engine/core/error.h"
#include "server/app/command.h"

namespace {

std::atomic<bool> g_cancelled{false};
void cancel_on_signal(int) {
  g_cancelled = true;
}

// A bar on a terminal, one line a stage otherwise.
void show_progress(std::string_view stage, double fraction) {
  static std::string last_stage;
  static int last_percent = -1;
  const int percent = static_cast<int>(fraction * 100);
  const bool new_stage = stage != last_stage;
  if (!new_stage && percent == last_percent) return;
  if (isatty(STDERR_FILENO)) {
    if (new_stage && !last_stage.empty()) std::fputc('\n', stderr);
    const std::string filled(static_cast<std::size_t>(percent) * 30 / 100, '#');
    std::fprintf(stderr, "\r%-20.*s [%-30s] %3d %%", static_cast<int>(stage.size()), stage.data(), filled.c_str(),
                 percent);
    if (percent >= 100) std::fputc('\n', stderr);
  } else if (new_stage) {
    std::fprintf(stderr, "%.*s\n", static_cast<int>(stage.size()), stage.data());
  }
  last_stage = percent >= 100 && isatty(STDERR_FILENO) ? std::string() : std::string(stage);
  last_percent = percent;
}

void log_progress_json(std::string_view stage, double fraction) {
  std::fprintf(stderr, "{\"event\":\"progress\",\"stage\":\"%.*s\",\"fraction\":%.3f}\n",
               static_cast<int>(stage.size()), stage.data(), fraction);
}

int report_error(const toile::Error& error) {
  std::fprintf(stderr, "toile: %s: %s\n", std::string(toile::error_name(error.code)).c_str(), error.what());
  return toile::exit_code(error.code);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace toile;
  // The rasteriser of pictures would start a thread for every core and spend more on sharing tiles out than it saves.
  setenv("LP_NUM_THREADS", "0", 0);
  std::signal(SIGINT, cancel_on_signal);
  std::signal(SIGTERM, cancel_on_signal);
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App app("Toile alters existing garments: from a pattern and two bodies to a tailor's work order.");
  app.require_subcommand(1);
  app.fallthrough();
  app::Context context;
  app.add_flag("--quiet", context.quiet, "no progress on stderr");
  app.add_flag("--json-log", context.json_log, "progress as JSON lines on stderr");
  app.add_option("--threads", context.threads, "threads to use; 0: all cores")
      ->envname("TOILE_THREADS")
      ->check(CLI::Range(0, 1024));
  context.progress.cancelled = &g_cancelled;
  context.progress.report = [&](std::string_view stage, double fraction) {
    if (context.quiet) return;
    context.json_log ? log_progress_json(stage, fraction) : show_progress(stage, fraction);
  };

  app::add_alter_command(app, context);
  app::add_batch_command(app, context);
  app::add_body_command(app, context);
  app::add_check_command(app, context);
  app::add_drape_command(app, context);
  app::add_register_command(app, context);
  app::add_version_command(app, context);
  app::add_serve_command(app, context);
  app::add_work_command(app, context);
  app::add_run_job_command(app, context);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  } catch (const Error& error) {
    return report_error(error);
  } catch (const std::bad_alloc&) {
    return report_error(Error(ErrorCode::ResourceLimit, "memory", "out of memory; use a smaller input or --triangles"));
  } catch (const std::exception& error) {
    return report_error(Error(ErrorCode::Internal, "toile", error.what()));
  }
  return 0;
}

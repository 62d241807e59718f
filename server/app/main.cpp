// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "engine/core/error.h"
#include "server/app/command.h"
#include "server/app/files.h"
#include "server/app/help.h"
#include "server/app/show_progress.h"
#include "server/app/usage.h"

namespace {

std::atomic<bool> g_cancelled{false};
void cancel_on_signal(int) {
  g_cancelled = true;
}

int report_error(const toile::Error& error) {
  std::fprintf(stderr, "toile: %s: %s\n", std::string(toile::error_name(error.code)).c_str(), error.what());
  return toile::exit_code(error.code);
}

void add_commands(CLI::App& app, toile::app::Context& context) {
  using namespace toile::app;
  add_alter_command(app, context);
  add_batch_command(app, context);
  add_drape_command(app, context);
  add_body_command(app, context);
  add_register_command(app, context);
  add_check_command(app, context);
  add_serve_command(app, context);
  add_work_command(app, context);
  add_version_command(app, context);
  add_run_job_command(app, context);
}

void add_global_options(CLI::App& app, toile::app::Context& context) {
  app.set_version_flag("--version", "toile " TOILE_VERSION, "Print the version");
  app.add_flag("--quiet", context.quiet, "Do not tell how far the work is");
  app.add_flag("--json-log", context.json_log, "Tell it as JSON lines, for programs");
  app.add_option("--threads", context.threads, "Processor cores to use; 0: all")
      ->envname("TOILE_THREADS")
      ->check(CLI::Range(0, 1024));
  context.progress.cancelled = &g_cancelled;
  context.progress.report = [&](std::string_view stage, double fraction) {
    if (context.quiet) return;
    context.json_log ? toile::app::log_progress_json(stage, fraction) : toile::app::show_progress(stage, fraction);
  };
}

// Says what is wrong before the library looks at values.
bool speaks_of_known_things(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) std::fputs(app.help().c_str(), stderr);
  const auto wrong = toile::app::find_wrong_word(app, words);
  if (wrong) std::fprintf(stderr, "toile: %s\n", wrong->c_str());
  return !words.empty() && !wrong;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace toile;
  // The rasteriser of pictures would start a thread for every core and spend more on sharing tiles out than it saves.
  setenv("LP_NUM_THREADS", "0", 0);
  std::signal(SIGINT, cancel_on_signal);
  std::signal(SIGTERM, cancel_on_signal);
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App app("Toile alters existing garments: from a pattern and two bodies to a tailor's work order.", "toile");
  app.formatter(std::make_shared<app::HelpText>());
  app.footer(
      "toile COMMAND --help tells what a command takes. Lengths are in the unit their name ends in.\n"
      "Exit codes: 0 done, 2 wrong flags, 3 a file that cannot be used (the message tells where and how to mend it),\n"
      "4 no result (the message tells why), 5 stopped by the user, 70 a defect of Toile.");
  app.failure_message(app::tell_usage);
  app.require_subcommand(1);
  app.fallthrough();
  app::Context context;
  add_global_options(app, context);
  add_commands(app, context);
  if (!speaks_of_known_things(app, {argv + 1, argv + argc})) return 2;

  try {
    app.parse(argc, argv);
    app::check_standard_output();
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

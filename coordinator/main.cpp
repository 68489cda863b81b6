// demecal: finds out why a robot misses its coordinates, from measured poses, and corrects it.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include "coordinator/commands.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "manual/manual.hpp"
#include "pieces/pieces.hpp"
#include "workflows/piece_threads.hpp"

namespace {

constexpr const char* kExitStatus =
    "0: done. 10: wrong arguments. 11: a file is missing or invalid; the message names file, line, value and rule. 12: "
    "the "
    "data and the robot file contradict each other; the message says what would fit, and --force goes on. 13: "
    "`check` finds that the robot has changed. 20: no "
    "worker "
    "came. 21: the run failed. 130: interrupted; what was reached is saved and named.";

/// CLI11 would only say that a command is missing.
void require_known_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::count(names, argv[1]) == 0)
    throw demecal::ArgumentError('\'' + std::string(argv[1]) + "' is no command; the nearest is '" +
                                 demecal::nearest_name(argv[1], names) + "' (demecal --help lists them)");
}

/// Matrices of every row of a long series come and go by the hundred: memory that went back to the system each time
/// would have to be cleared by it again, page by page.
void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

}  // namespace

int main(int argc, char** argv) {
  using demecal::ExitCode;
  keep_freed_memory();
  CLI::App app{"demecal: finds out why a robot misses its coordinates, from measured poses, and corrects it",
               "demecal"};
  app.require_subcommand(1);
  app.set_version_flag("--version", DEMECAL_VERSION);
  ExitCode exit_code = ExitCode::done;
  demecal::add_new(app, exit_code);
  demecal::add_template(app, exit_code);
  demecal::add_calibrate(app, exit_code);
  demecal::add_check(app, exit_code);
  demecal::add_compare(app, exit_code);
  demecal::add_diagnose(app, exit_code);
  demecal::add_evaluate(app, exit_code);
  demecal::add_apply(app, exit_code);
  demecal::add_certify(app, exit_code);
  demecal::add_fleet(app, exit_code);
  demecal::add_export(app, exit_code);
  demecal::add_plan(app, exit_code);
  demecal::add_prepare(app, exit_code);
  demecal::add_simulate(app, exit_code);
  demecal::add_report(app, exit_code);
  demecal::add_robot(app, exit_code);
  demecal::add_study(app, exit_code);
  demecal::add_monitor(app, exit_code);
  demecal::add_serve(app, exit_code);
  demecal::add_manual(app, kExitStatus, [](const std::string& text) { std::fputs(text.c_str(), stdout); });
  demecal::PieceThreads threads(0);
  const demecal::RunPiecesBy by_threads(threads);
  try {
    require_known_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? ExitCode::done : ExitCode::wrong_arguments;
  } catch (const demecal::ArgumentError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    exit_code = ExitCode::wrong_arguments;
  } catch (const demecal::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    exit_code = ExitCode::bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "the run failed: %s\n", error.what());
    exit_code = ExitCode::run_failed;
  }
  return static_cast<int>(exit_code);
}

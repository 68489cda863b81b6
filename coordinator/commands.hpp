// The verbs of `demecal`: each adds itself to the command line and leaves its exit code when it has run.
#pragma once

#include <CLI/CLI.hpp>

#include "coordinator/exit_codes.hpp"

namespace demecal {

/// Each of these adds a subcommand whose callback sets `exit_code`. User input that is wrong leaves it as InputError.
void add_calibrate(CLI::App& app, ExitCode& exit_code);
void add_apply(CLI::App& app, ExitCode& exit_code);
void add_compare(CLI::App& app, ExitCode& exit_code);
void add_diagnose(CLI::App& app, ExitCode& exit_code);
void add_evaluate(CLI::App& app, ExitCode& exit_code);
void add_export(CLI::App& app, ExitCode& exit_code);
void add_prepare(CLI::App& app, ExitCode& exit_code);
void add_simulate(CLI::App& app, ExitCode& exit_code);
void add_report(CLI::App& app, ExitCode& exit_code);
void add_study(CLI::App& app, ExitCode& exit_code);
void add_monitor(CLI::App& app, ExitCode& exit_code);

}  // namespace demecal

// The commands of `demecal`, and what they share: how they end, what interrupts them, how they take up a data set, and
// runs that begin with a model found before (--prior of calibrate and diagnose).
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "coordinator/workers.hpp"
#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "fitting/stations.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"

namespace demecal {

/// What a command's end means to scripts.
enum class ExitCode : int {
  done = 0,
  wrong_arguments = 10,
  bad_input = 11,      ///< a file is missing, unreadable or invalid
  contradiction = 12,  ///< the data and the robot's description contradict each other
  changed = 13,        ///< the robot has changed since its model was made
  no_worker = 20,
  run_failed = 21,
  interrupted = 130  ///< what was reached is saved and named
};

/// What a command cannot do as it was called: reported with exit code 10.
struct ArgumentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From now on SIGINT and SIGTERM set the returned flag; a second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

/// Each of these adds a subcommand whose callback sets `exit_code`. User input that is wrong leaves it as InputError.
void add_calibrate(CLI::App& app, ExitCode& exit_code);
void add_apply(CLI::App& app, ExitCode& exit_code);
void add_check(CLI::App& app, ExitCode& exit_code);
void add_certify(CLI::App& app, ExitCode& exit_code);
void add_compare(CLI::App& app, ExitCode& exit_code);
void add_diagnose(CLI::App& app, ExitCode& exit_code);
void add_evaluate(CLI::App& app, ExitCode& exit_code);
void add_fleet(CLI::App& app, ExitCode& exit_code);
void add_export(CLI::App& app, ExitCode& exit_code);
void add_plan(CLI::App& app, ExitCode& exit_code);
void add_prepare(CLI::App& app, ExitCode& exit_code);
void add_simulate(CLI::App& app, ExitCode& exit_code);
void add_report(CLI::App& app, ExitCode& exit_code);
void add_robot(CLI::App& app, ExitCode& exit_code);
void add_serve(CLI::App& app, ExitCode& exit_code);
void add_study(CLI::App& app, ExitCode& exit_code);
void add_monitor(CLI::App& app, ExitCode& exit_code);
void add_template(CLI::App& app, ExitCode& exit_code);
void add_new(CLI::App& app, ExitCode& exit_code);

/// Says on standard error that a fleet's mean is no calibrated robot.
void say_if_fleet(const CalibratedModel& model, const std::string& file);
/// Says on standard error that the data of the model had findings, none of which contradicts the arm.
void say_if_doubtful(const CalibratedModel& model, const std::string& file);

/// A data set as every command takes it up: read, checked against its robot, and what was found said first.
struct CheckedData {
  DataSet data;  ///< without copies of rows
  DataCheck check;
};

/// The data set of a file and what the check of it found. Throws InputError
/// where the file is invalid, or a joint stands outside its limits and no finding says why.
CheckedData load_checked(const std::string& path);
/// The same of several files, each a station's: every one is checked by itself, then they are joined. Unless forced,
/// the first that contradicts the arm is returned alone.
CheckedData load_checked(std::span<const std::string> paths, StationTools tools, bool force);
/// The same of a file from which nothing is fitted: whatever set a pose is of, it counts as every other.
CheckedData load_checked_as_one_set(const std::string& path);

/// YYYY-MM-DD, where this machine is.
std::string today();

/// Whether the data contradict the robot's description, and nobody forces the command to go on: said on standard error.
bool refuses(const CheckedData& checked, bool force, ShownFindings shown);

/// Throws InputError where poses touch something or were measured from several stations: `what` learns from measured
/// points of one alone.
void require_instrument(const DataSet& data, const std::string& what);

/// Throws InputError where poses touch something and `what` would take their agreement for accuracy.
void require_positions(const DataSet& data, const std::string& what);

/// Of options that hold a number: above 0; no less than `least` and no more than `most`; a whole number of 0 or more.
/// CLI::Range lets what is no number pass: no comparison with it holds.
CLI::Validator above_zero();
CLI::Validator number_from(double least, double most);
CLI::Validator not_negative();

/// The option --force of a command that fits or judges data.
void add_force(CLI::App& command, bool& force);

/// What the check found in the data, on standard error.
void say_findings(const CheckedData& checked);

/// Writes report.json and report.html of data that no model was fitted to, in place of the results of an earlier run.
void write_refusal(const std::string& folder, const std::string& job, const CheckedData& checked);

/// What `fit` returns. Where it throws InputError, since no model fits the data, what the check found in them is said
/// and reported before the error goes on.
template <typename Fit>
auto fit_or_report(const std::string& folder, const std::string& job, const CheckedData& checked, const Fit& fit) {
  try {
    return fit();
  } catch (const InputError&) {
    if (!checked.check.findings.empty()) {
      say_findings(checked);
      write_refusal(folder, job, checked);
    }
    throw;
  }
}

struct PriorRun {
  std::vector<std::string> prior_files;  ///< the model to bring up to date, then those that tell how the robot drifts
  std::string out;
  Job job;
  bool declared_stated = false;  ///< otherwise what is declared is the prior's
  WorkerArguments workers;       ///< of which none is started: they say where watchers are
  bool json = false, quiet = false, force = false;
};

/// Brings the model up to date by the poses of job.data_file and writes the folder of results.
ExitCode run_with_prior(PriorRun run);

}  // namespace demecal

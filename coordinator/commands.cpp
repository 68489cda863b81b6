#include "coordinator/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/keyboard.hpp"
#include "coordinator/result_folder.hpp"
#include "data/text.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "errors/input_error.hpp"
#include "html/page.hpp"
#include "prediction/measurement.hpp"
#include "report/evaluation.hpp"
#include "report/history.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

std::atomic<bool> interrupted{false};

/// Says on standard error, by what a signal's handler may call.
template <std::size_t N>
void say(const char (&text)[N]) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, N - 1);
}

void on_interrupt(int) {
  if (interrupted.exchange(true)) {
    give_keyboard_back();
    say("\nended at once; what was not written yet is lost\n");
    ::_exit(static_cast<int>(ExitCode::interrupted));
  }
  say("\nstopping after this step; once more ends at once\n");
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return interrupted;
}

CheckedData load_checked(std::span<const std::string> paths, StationTools tools, bool force) {
  std::vector<DataSet> sets;
  DataCheck check;
  for (const std::string& path : paths) {
    DescribedDataSet described = load_described_data_set(path);
    for (const std::string& sentence : described.recognised) fmt::print(stderr, "{}\n", sentence);
    DataCheck own = check_without_copies(described.data);
    if (paths.size() > 1)
      for (Finding& finding : own.findings) finding.sentence = described.data.name + ": " + finding.sentence;
    std::ranges::move(own.findings, std::back_inserter(check.findings));
    for (const DataSet& other : sets) {
      if (other.sha256 == described.data.sha256)
        throw InputError({path, 0}, described.data.name,
                         "has the very poses of " + other.name + ": a station is given once");
    }
    sets.push_back(std::move(described.data));
    if (check.verdict() == DataVerdict::contradiction && !force) return {std::move(sets.back()), std::move(check)};
  }
  const auto timed = [](const DataSet& set) {
    return std::ranges::any_of(set.poses, [](const MeasuredPose& pose) { return pose.time_s.has_value(); });
  };
  const bool times_given = std::ranges::any_of(sets, timed);
  CheckedData checked{joined_stations(std::move(sets), tools), std::move(check)};
  if (times_given && !timed(checked.data))
    fmt::print(
        stderr,
        "{}: times are left out, since those of two stations overlap and clocks may differ: drift is looked for in "
        "the order of the rows alone\n",
        checked.data.file);
  for (Finding& finding : check_stations(checked.data)) checked.check.findings.push_back(std::move(finding));
  if (paths.size() > 1) checked.data.sha256 = sha256(checked.data.sha256);
  return checked;
}

CheckedData load_checked(const std::string& path) {
  return load_checked(std::span(&path, 1), StationTools::own, true);
}

CheckedData load_checked_as_one_set(const std::string& path) {
  DescribedDataSet described = load_described_data_set(path);
  for (const std::string& sentence : described.recognised) fmt::print(stderr, "{}\n", sentence);
  for (MeasuredPose& pose : described.data.poses) pose.set = PoseSet::calibration;
  DataCheck check = check_without_copies(described.data);
  return {std::move(described.data), std::move(check)};
}

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm day{};
  ::localtime_r(&now, &day);
  return fmt::format("{:04}-{:02}-{:02}", day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
}

bool refuses(const CheckedData& checked, bool force, ShownFindings shown) {
  if (force || checked.check.verdict() != DataVerdict::contradiction) return false;
  fmt::print(
      stderr,
      "{}: the data and the robot's description contradict each other:\n{}Nothing was fitted. Correct the files, or "
      "go on all the same with --force.\n",
      checked.data.file, to_terminal(data_check_entry(checked.check), shown));
  return true;
}

void require_instrument(const DataSet& data, const std::string& what) {
  if (!data.stations.empty())
    throw InputError({data.file, 0}, data.name, what + " learns from one station: give a single data set");
  if (!has_contacts(data)) return;
  throw InputError({data.file, 0}, "contact",
                   what + " learns from measured points alone: use calibrate with the method direct, or diagnose");
}

void require_positions(const DataSet& data, const std::string& what) {
  if (!has_contacts(data)) return;
  throw InputError({data.file, 0}, "contact",
                   what +
                       " needs measured positions: poses that touch something tell how well they agree with one "
                       "another, not where the tool is (`demecal evaluate` says how well)");
}

CLI::Validator above_zero() {
  return CLI::Validator(
      [](std::string& text) {
        const std::optional<double> value = parse_number(text);
        return value && *value > 0.0 ? std::string() : '\'' + text + "' must be a number above 0, without a unit";
      },
      "");
}

CLI::Validator number_from(double least, double most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        const std::optional<double> value = parse_number(text);
        return value && *value >= least && *value <= most
                   ? std::string()
                   : fmt::format("'{}' must be a number from {:g} to {:g}, without a unit", text, least, most);
      },
      "");
}

CLI::Validator not_negative() {
  return CLI::Validator(
      [](std::string& text) {
        const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        return whole ? std::string() : '\'' + text + "' must be a whole number, 0 or more";
      },
      "");
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag(
      "--force", force,
      "go on although the data and the robot's description contradict each other, and overwrite files that demecal did "
      "not write, or that were changed since");
}

void say_findings(const CheckedData& checked) {
  fmt::print(stderr, "{}: what was found in the data:\n{}", checked.data.file,
             to_terminal(data_check_entry(checked.check), ShownFindings::ten));
}

void write_refusal(const std::string& folder, const std::string& job, const CheckedData& checked) {
  const Report report = refusal_report(checked.data, job, checked.check);
  remove_earlier_results(folder, {"report.json", "report.html"});
  write_result(folder, "report.json", to_json(report));
  write_result(folder, "report.html", report_html(report, {}));
}

void say_if_doubtful(const CalibratedModel& model, const std::string& file) {
  if (model.data_findings.empty() || contradicts(model.data_findings.front())) return;
  fmt::print(
      stderr,
      "{}: the check of the data that it was made from found what may be wrong with them ({}): see data_check in "
      "its report.json\n",
      file, fmt::join(model.data_findings, ", "));
}

}  // namespace demecal

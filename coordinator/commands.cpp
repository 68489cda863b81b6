#include "coordinator/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <string>
#include <utility>

#include "config/data_set_file.hpp"
#include "coordinator/result_folder.hpp"
#include "data_check/check_data.hpp"
#include "errors/input_error.hpp"
#include "html/page.hpp"
#include "prediction/measurement.hpp"
#include "report/evaluation.hpp"
#include "report/history.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "terminal/report_text.hpp"

namespace demecal {
namespace {

std::atomic<bool> interrupted{false};

void on_signal(int) {
  if (interrupted.exchange(true)) ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return interrupted;
}

CheckedData load_checked(const std::filesystem::path& path) {
  DescribedDataSet described = load_described_data_set(path);
  CheckedData checked{std::move(described.data), {}};
  for (const std::string& sentence : described.recognised) fmt::print(stderr, "{}\n", sentence);
  checked.check = check_without_copies(checked.data);
  return checked;
}

bool refuses(const CheckedData& checked, bool force) {
  if (force || checked.check.verdict() != DataVerdict::contradiction) return false;
  fmt::print(
      stderr,
      "{}: the data and the robot's description contradict each other:\n{}Nothing was fitted. Correct the files, or "
      "go on all the same with --force.\n",
      checked.data.file, to_terminal(data_check_entry(checked.check)));
  return true;
}

void require_instrument(const DataSet& data, const std::string& what) {
  if (!has_contacts(data)) return;
  throw InputError({data.file, 0}, "contact",
                   what + " learns from measured points alone: use calibrate with the method direct, or diagnose");
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag(
      "--force", force,
      "go on although the data and the robot's description contradict each other, and overwrite files that demecal did "
      "not write, or that were changed since");
}

void write_refusal(const std::string& folder, const std::string& job, const CheckedData& checked) {
  if (checked.check.verdict() != DataVerdict::contradiction)
    fmt::print(stderr, "{}: what was found in the data:\n{}", checked.data.file,
               to_terminal(data_check_entry(checked.check)));
  const Report report = refusal_report(checked.data, job, checked.check);
  write_result(folder, "report.json", to_json(report));
  write_result(folder, "report.html", report_html(report, {}));
}

}  // namespace demecal

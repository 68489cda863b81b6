#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "acceptance/certificate.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "html/page.hpp"
#include "kinematics/units.hpp"
#include "report/evaluation.hpp"
#include "studies/change_report.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "updating/change.hpp"
#include "updating/fleet_model.hpp"
#include "updating/implausible_change.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct CheckRequest {
  std::string model_file, data_file, history;
  bool json = false, force = false;
};

/// The names of poses that the check of the data found to be wrong by themselves.
std::set<std::string> suspects(const DataCheck& check) {
  std::set<std::string> names;
  for (const Finding& finding : check.findings)
    if (finding.kind == FindingKind::typing_error || finding.kind == FindingKind::rows_exchanged ||
        finding.kind == FindingKind::outlier)
      names.insert(finding.poses.begin(), finding.poses.end());
  return names;
}

constexpr const char *kHistoryTable = "check-history.csv", *kHistoryPage = "check-history.html";

/// The folder's record so far, which must be of the model's robot.
std::vector<CheckRecord> history_of(const CheckRequest& request, const CalibratedModel& model) {
  const std::string path = request.history + '/' + kHistoryTable;
  if (request.history.empty() || !std::filesystem::exists(path)) return {};
  std::vector<CheckRecord> records = read_check_history(read_file(path), path);
  for (const CheckRecord& one : records)
    if (!one.robot.empty() && one.robot != checked_robot(model))
      throw InputError({path, 0}, one.robot,
                       "is the robot of this record, not " + checked_robot(model) + ": give every robot its folder");
  return records;
}

/// Adds the check to the folder's record, and draws it.
void keep(const CheckRequest& request, CheckRecord check, std::vector<CheckRecord> records) {
  make_writable(request.history, {kHistoryTable, kHistoryPage}, request.force);
  records.push_back(std::move(check));
  write_result(request.history, kHistoryTable, check_history_csv(records));
  write_result(request.history, kHistoryPage, check_history_html(records));
  const auto of_this =
      std::ranges::count_if(records, [&](const CheckRecord& one) { return one.of_model_of(records.back()); });
  const bool of_others = of_this < std::ssize(records);
  fmt::print(stderr, "{}/{}: {}{}\n", request.history, kHistoryPage, counted(records.size(), "check"),
             of_others ? fmt::format(", {} of them by this model", of_this) : "");
}

/// The finding that the data are of another robot, if nothing else is wrong with them as a whole.
const Finding* other_robot_alone(const DataCheck& check) {
  const Finding* other = nullptr;
  for (const Finding& finding : check.findings) {
    if (!contradicts(finding.kind)) continue;
    if (finding.kind != FindingKind::other_robot) return nullptr;
    other = &finding;
  }
  return other;
}

/// The check of the data knows the robot's description, not its model, and no zero that is off by degrees: where those
/// of `other` are a change of the model's robot that can be named, this is it.
std::optional<ChangeReport> change_in_place_of(const Finding& other, const CalibratedModel& model,
                                               const CheckedData& checked) {
  try {
    ChangeReport change = find_change(model, checked.data, suspects(checked.check));
    if (!explains_implausible(change, metres(other.as_given_mm))) return std::nullopt;
    change.implausible = true;
    return change;
  } catch (const InputError&) {  // too few poses
    return std::nullopt;
  }
}

/// Without it every error that is larger than noise is a change.
void require_posterior(const CalibratedModel& model, const std::string& file) {
  if (model.posterior) return;
  throw InputError(
      {file, 0}, "posterior",
      "is missing: nothing says how sure the model's numbers are, so that what they were wrong by all along "
      "would be called a change of the robot; calibrate again, or use --force");
}

ExitCode run_check(const CheckRequest& request) {
  const CalibratedModel model = load_model(request.model_file);
  require_one_robot(model, request.model_file, "check");
  if (!request.force) require_posterior(model, request.model_file);
  const CheckedData checked = load_checked_as_one_set(request.data_file);
  const DataSet& data = checked.data;
  require_positions(data, "check");
  require_same_nominal_arm(model, data);
  std::vector<std::size_t> rows(data.poses.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  if (is_calibrated_with(model, data))
    fmt::print(stderr, "{}: the model was made from these very poses: they tell nothing of the robot as it is now\n",
               request.data_file);
  else if (const std::string known = known_poses_sentence(model, data, rows); !known.empty())
    fmt::print(stderr, "{}: {}: they tell nothing of the robot as it is now\n", request.data_file, known);
  const Finding* other = other_robot_alone(checked.check);
  std::optional<ChangeReport> instead = other == nullptr ? std::nullopt : change_in_place_of(*other, model, checked);
  DataCheck shown = checked.check;
  if (instead)
    std::erase_if(shown.findings, [](const Finding& one) { return one.kind == FindingKind::other_robot; });
  else if (refuses(checked, request.force, ShownFindings::all))
    return ExitCode::contradiction;
  fmt::print(stderr, "{}", to_terminal(data_check_entry(shown), ShownFindings::all));
  const std::vector<CheckRecord> history = history_of(request, model);
  const ChangeReport change = instead ? *std::move(instead) : find_change(model, data, suspects(checked.check));
  if (!request.history.empty()) {
    const std::string digest = sha256(read_file(request.model_file));
    keep(request, check_record(change, data, model, request.model_file, digest, today()), history);
  }
  fmt::print("{}",
             request.json ? to_json(change, data, request.model_file) : change_text(change, data, request.model_file));
  return change.verdict == ChangeVerdict::changed ? ExitCode::changed : ExitCode::done;
}

}  // namespace

void add_check(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<CheckRequest>();
  CLI::App* command = app.add_subcommand("check", "whether the robot has changed since it was calibrated, and how");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command->add_option("data", request->data_file, "DATASET.yaml of a few new poses, 12 or more")->required();
  command->add_flag("--json", request->json, "the answer as one line of JSON");
  command->add_option("--history", request->history,
                      "folder that keeps the record of checks: a line is added, and its control chart drawn");
  add_force(*command, request->force);
  command->callback([request, &exit_code] { exit_code = run_check(*request); });
}

}  // namespace demecal

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "data_files/data_set_file.hpp"
#include "html/page.hpp"
#include "report/change_report.hpp"
#include "updating/change.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct CheckRequest {
  std::string model_file, data_file, history;
  bool json = false, force = false;
};

/// Adds the check to the folder's record, and draws it.
void keep(const CheckRequest& request, const ChangeReport& change, const DataSet& data) {
  constexpr const char *kTable = "check-history.csv", *kPage = "check-history.html";
  make_writable(request.history, {kTable, kPage}, request.force);
  const std::string path = request.history + '/' + kTable;
  std::vector<CheckRecord> records;
  if (std::filesystem::exists(path)) records = read_check_history(read_file(path), path);
  records.push_back(check_record(change, data, request.model_file, today()));
  write_result(request.history, kTable, check_history_csv(records));
  write_result(request.history, kPage, check_history_html(records));
  fmt::print(stderr, "{}/{}: {} checks\n", request.history, kPage, records.size());
}

ExitCode run(const CheckRequest& request) {
  const CalibratedModel model = load_model(request.model_file);
  require_one_robot(model, request.model_file, "check");
  const DataSet data = load_data_set(request.data_file);
  require_positions(data, "check");
  require_same_nominal_arm(model, data);
  const ChangeReport change = find_change(model, data);
  if (!request.history.empty()) keep(request, change, data);
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
  command->add_flag("--force", request->force, "overwrite a record that was changed since demecal wrote it");
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal

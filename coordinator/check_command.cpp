#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "config/data_set_file.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "report/change_report.hpp"
#include "updating/change.hpp"
#include "workflows/workflows.hpp"

namespace demecal {
namespace {

struct CheckRequest {
  std::string model_file, data_file;
  bool json = false;
};

ExitCode run(const CheckRequest& request) {
  const CalibratedModel model = load_model(request.model_file);
  const DataSet data = load_data_set(request.data_file);
  require_same_nominal_arm(model, data);
  const ChangeReport change = find_change(model, data);
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
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal

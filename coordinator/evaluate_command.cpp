#include <fmt/format.h>

#include <memory>
#include <string>

#include "config/model_file.hpp"
#include "coordinator/checked_data.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/known_arm.hpp"
#include "data_check/check_data.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "terminal/report_text.hpp"

namespace demecal {
namespace {

struct EvaluateRequest {
  std::string model_file, data_file;
  bool json = false, refit_base = false, force = false;
};

/// The model in the data's own frame: base and tool fitted on the calibration poses, everything else as it is.
CorrectedRobot registered(const CalibratedModel& model, const DataSet& data) {
  const DeclaredModel base_and_tool{.registration = true, .tool = true};
  const Fit fit = fit_registration(data, poses_of(data, PoseSet::calibration), base_and_tool, model.robot);
  if (fit.status != FitStatus::converged) throw InputError({data.file, 0}, "", fit.sentence);
  return fit.robot;
}

ExitCode run(const EvaluateRequest& request) {
  const CalibratedModel model = load_model(request.model_file);
  CheckedData checked = load_checked(request.data_file);
  const DataSet& data = checked.data;
  require_same_arm(model, data);
  if (refuses(checked, request.force)) return ExitCode::contradiction;
  const CorrectedRobot robot = request.refit_base ? registered(model, data) : model.robot;
  check_fitted(data, robot, checked.check);
  Evaluation evaluation{errors_by_set(robot, data),
                        pose_errors(data, model, robot, nullptr),
                        data_check_entry(checked.check),
                        unapplied_effects(robot, data),
                        {}};
  if (model.interval) evaluation.prediction = prediction_entry(*model.interval);
  fmt::print(stderr, "{}", to_terminal(evaluation.data_check));
  for (const UnappliedEffect& one : evaluation.effects_not_applied)
    fmt::print(stderr, "{}: {}\n", data.file, one.sentence);
  fmt::print("{}", request.json ? to_json(evaluation) : to_terminal(evaluation));
  return ExitCode::done;
}

}  // namespace

void add_evaluate(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<EvaluateRequest>();
  CLI::App* command = app.add_subcommand("evaluate", "position error of a model on a data set");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command->add_option("data", request->data_file, "DATASET.yaml")->required();
  command->add_flag("--json", request->json, "one line of JSON");
  add_force(*command, request->force);
  command->add_flag("--refit-base", request->refit_base,
                    "fit base and tool to the data first, where the instrument or the tool was moved");
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal

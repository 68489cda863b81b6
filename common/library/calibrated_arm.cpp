#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "expression/bound.hpp"
#include "expression/text.hpp"
#include "fitting/stations.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "languages/languages.hpp"
#include "library/conversion.hpp"
#include "library/demecal.hpp"
#include "parameters/declared_model.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "programs/command_model.hpp"
#include "programs/correct_program.hpp"
#include "programs/summary.hpp"
#include "programs/target_correction.hpp"
#include "report/evaluation.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"
#include "trials/finding.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal::inline library {
namespace {

/// The bounds that the model states of its joint corrections.
std::vector<double> stated_bounds(const CalibratedModel& model) {
  std::vector<double> bounds(model.joints.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (model.joints[i].kept && model.joints[i].bound_rad > 0.0) bounds[i] = model.joints[i].bound_rad;
  }
  return bounds;
}

const Language& recognized_language(const std::string& text, const std::string& file) {
  const Language* const language = recognize_language(text, file);
  if (language == nullptr)
    throw InputError({file, 0}, "", "is in no language that can be told by its ending or its words");
  return *language;
}

}  // namespace

CommandModel to_command_model(const CalibratedModel& model, const std::optional<Eigen::Vector3d>& stated_tool_m) {
  const bool registration = model.declared.registration;
  const CorrectedRobot robot = registration ? without_base(model.robot, model.nominal.chain) : model.robot;
  CommandModel commands = with_posterior(command_model(model.nominal, robot, stated_bounds(model)), robot,
                                         model.posterior, model.measured, registration);
  commands.interval = model.interval;
  commands.gaps = model.measured_gaps;
  const bool corrected = !std::ranges::all_of(commands.robot.corrections, &JointCorrection::is_neutral);
  if (!model.data_findings.empty() && contradicts(model.data_findings.front()))
    commands.notes.insert(commands.notes.begin(),
                          "the data that the model was made from contradict the arm (" + model.data_findings.front() +
                              "): unless that is known to be wrong, do not correct programs; data_check in the "
                              "model's report.json says what would fit");
  if (!model.approach_recorded && (corrected || !commands.robot.effects.empty()))
    commands.notes.emplace_back(
        "the model was measured without the sides that joints came from (no approach columns, or one side only): lost "
        "motion, if the arm has any, stands in it as gears, elasticity or joint corrections, and is corrected wrongly "
        "where a joint comes from the other side");
  return stated_tool_m ? with_stated_tool(std::move(commands), *stated_tool_m) : commands;
}

CalibratedArm::CalibratedArm(std::shared_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}

CalibratedArm CalibratedArm::load(const std::filesystem::path& model_file) {
  std::string text = read_file(model_file);
  CalibratedModel model = read_model(text, model_file.string());
  require_one_robot(model, model_file.string(), "a calibrated arm");
  return CalibratedArm(std::make_shared<Implementation>(Implementation{std::move(model), std::move(text)}));
}

void CalibratedArm::save(const std::filesystem::path& model_file) const {
  write_file(model_file, implementation_->text);
}

Arm CalibratedArm::nominal() const {
  return Arm(std::make_shared<Arm::Implementation>(Arm::Implementation{implementation_->model.nominal}));
}

ToolPose CalibratedArm::predict(const JointCommand& command) const {
  const CorrectedRobot& robot = implementation_->model.robot;
  return to_tool_pose(robot.predict(to_stop(command, robot.chain), ""));
}

std::vector<double> CalibratedArm::correct(const JointCommand& command) const {
  const CommandModel commands = to_command_model(implementation_->model);
  const Chain& chain = commands.nominal.chain;
  const Stop stop = to_stop(command, chain);
  return to_deg_or_mm(correct_target({}, commands, stop).command, chain);
}

double CalibratedArm::error95_mm(const JointCommand& command) const {
  const CommandModel commands = to_command_model(implementation_->model);
  const std::optional<double> radius_m = error95_m(commands, to_stop(command, commands.nominal.chain));
  return radius_m ? millimetres(*radius_m) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> CalibratedArm::widened_by(const JointCommand& command) const {
  const CommandModel commands = to_command_model(implementation_->model);
  return widening_at(commands, to_stop(command, commands.nominal.chain)).sentences();
}

std::string CalibratedArm::correct_program(const std::string& text, const std::string& file,
                                           std::vector<std::string>* warnings) const {
  const CalibratedModel& model = implementation_->model;
  if (const std::optional<std::size_t> line = marked_line(text))
    throw InputError({file, *line}, "",
                     "says that this program was corrected already; start from the original program");
  const CommandModel commands = to_command_model(model);
  const Language& language = recognized_language(text, file);
  const Circumstances circumstances{.near = model.nominal.home};
  const ControllerData controller{.pulses_per_deg = model.nominal.pulses_per_deg};
  const CorrectedProgram corrected = demecal::correct_program(
      text, read_program(language, ProgramSource(text, file), commands.nominal.chain, controller), commands,
      circumstances);
  if (warnings != nullptr) {
    for (const Remark& warning : corrected.warnings) warnings->push_back(warning_text(corrected, warning));
  }
  if (corrected.text == text) return text;
  return with_mark(corrected.text, language, correction_mark(model.version, model.job, model.data_sha256));
}

PositionErrors CalibratedArm::errors(const Measurements& measured, PoseUse use) const {
  const CalibratedModel& model = implementation_->model;
  const DataSet& data = measured.implementation().data;
  const CorrectedRobot robot = seen_from_stations(model.robot, model.stations, data);
  require_same_arm(robot, data);
  const ErrorFigures figures = error_figures(robot, data, poses_of(data, to_pose_set(use)));
  return {figures.mean_mm, figures.rms_mm, figures.p95_mm, figures.max_mm};
}

std::vector<PoseError> CalibratedArm::pose_errors(const Measurements& measured) const {
  const CalibratedModel& model = implementation_->model;
  const DataSet& data = measured.implementation().data;
  const CorrectedRobot robot = seen_from_stations(model.robot, model.stations, data);
  require_same_arm(robot, data);
  const std::vector<PoseErrorEntry> entries = demecal::pose_errors(data, model, robot, nullptr);
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<PoseError> errors;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    errors.push_back({entries[i].id, to_pose_use(data.poses[i].set), entries[i].after_mm.value_or(kUnknown),
                      entries[i].interval95_mm.value_or(kUnknown)});
  }
  return errors;
}

std::vector<AddedEffect> CalibratedArm::effects() const {
  const CorrectedRobot& robot = implementation_->model.robot;
  std::vector<AddedEffect> effects;
  for (const Effect& effect : robot.effects)
    effects.push_back({effect.kind, effect.joint + 1, law_of(effect).diagnosis(effect, robot.described)});
  return effects;
}

std::string CalibratedArm::correction(int joint) const {
  const std::vector<JointCorrection>& corrections = implementation_->model.robot.corrections;
  if (joint < 1 || joint > std::ssize(corrections))
    throw InputError({}, std::to_string(joint), "is no joint of this arm; joints count from 1");
  const JointCorrection& correction = corrections[static_cast<std::size_t>(joint) - 1];
  return correction.is_neutral() ? "0" : to_string(correction.formula());
}

}  // namespace demecal::inline library

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "acceptance/certificate.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/model_export.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "data/certificate_fields.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "fitting/stations.hpp"
#include "kinematics/chain.hpp"
#include "library/conversion.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "parameters/symbolic_radius.hpp"
#include "prediction/corrected_arm.hpp"
#include "prediction/corrected_robot.hpp"
#include "programs/command_model.hpp"
#include "report/evaluation.hpp"
#include "report/length_entries.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"
#include "symbolic/algebra.hpp"
#include "symbolic/code.hpp"
#include "symbolic/printing.hpp"
#include "symbolic/radius_code.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

struct ExportRequest {
  std::string file, out, target, urdf, format = "text";
  int derivative = 0;  ///< by this joint, from 1; 0: none
  bool force = false;
};

const std::map<std::string, CodeLanguage>& code_languages() {
  static const std::map<std::string, CodeLanguage> all{{"text", CodeLanguage::text},
                                                       {"c", CodeLanguage::c},
                                                       {"python", CodeLanguage::python},
                                                       {"matlab", CodeLanguage::matlab}};
  return all;
}

void require_target(const ExportRequest& request, const CorrectedRobot& robot) {
  if (robot.tools.contains(request.target)) return;
  std::string known;
  for (const auto& [target, tool] : robot.tools) {
    if (!target.empty()) known += (known.empty() ? "'" : ", '") + target + '\'';
  }
  throw InputError({request.file, 0}, request.target,
                   known.empty() ? "is no target of this model, which has but one tool point"
                                 : "is no target of this model; it has " + known);
}

/// A robot as its maker describes it.
CorrectedRobot as_drawn(const Robot& robot) {
  DataSet none;
  none.robot = robot;
  return nominal_robot(none);
}

/// What is exported: the listing, and the arm as described that its inverse in C corrects for.
struct ExportedListing {
  Listing listing;
  std::optional<Listing> described{};
  std::optional<RadiusListing> radius{};
};

ExportedListing listing_of_robot(Algebra& algebra, const ExportRequest& request, const CorrectedRobot& robot,
                                 const std::string& title, PoseFrame frame) {
  require_target(request, robot);
  const CorrectedArm arm = corrected_arm(algebra, robot, request.target);
  for (const std::string& note : arm.notes) fmt::print(stderr, "{}: {}\n", request.file, note);
  const Eigen::Isometry3d& identified = robot.tool(request.target);
  const Eigen::Isometry3d believed =
      request.target.empty() ? believed_tool(robot.described.chain.tool_m, identified) : identified;
  return {listing_of(arm, robot, title, frame), described_listing(algebra, robot, believed)};
}

/// Of the robot's own tool, of models that state how sure they are.
std::optional<RadiusListing> radius_of(Algebra& algebra, const ExportRequest& request, const CalibratedModel& model,
                                       double reference_celsius) {
  if (!request.target.empty() || model.fleet) return std::nullopt;
  const CommandModel commands = to_command_model(model);
  if (!commands.posterior || !commands.interval) return std::nullopt;
  return symbolic_radius(algebra, *commands.interval, *commands.posterior, commands.robot,
                         {commands.measured, commands.gaps}, reference_celsius);
}

/// By what the file says that it is: a model, a robot, or matrices.
ExportedListing listing_asked(Algebra& algebra, const ExportRequest& request) {
  const YamlNode file = read_yaml(request.file);
  if (file.find("demecal_matrices") != nullptr) return {load_matrices(algebra, request.file)};
  if (file.find("demecal_robot") != nullptr) {
    const Robot robot = load_robot(request.file);
    return listing_of_robot(algebra, request, as_drawn(robot), robot.name + " as its maker describes it",
                            PoseFrame::own_base);
  }
  const CalibratedModel model = load_model(request.file);
  say_if_fleet(model, request.file);
  const std::string title =
      fmt::format("{} as calibrated by the job {} (demecal {})", model.nominal.name, model.job, model.version);
  ExportedListing exported =
      listing_of_robot(algebra, request, model.robot, title,
                       model.declared.registration ? PoseFrame::measurements : PoseFrame::own_base);
  exported.radius = radius_of(algebra, request, model, *exported.listing.reference_celsius);
  return exported;
}

void write_or_print(const ExportRequest& request, const std::string& text) {
  if (request.out.empty()) {
    fmt::print("{}", text);
  } else {
    write_named(request.out, text, request.file, request.force);
  }
}

/// A robot file is taken as a model of which nothing was identified.
CalibratedModel model_asked(const ExportRequest& request) {
  if (read_yaml(request.file).find("demecal_robot") == nullptr) return load_model(request.file);
  CalibratedModel model;
  model.nominal = load_robot(request.file);
  model.robot = as_drawn(model.nominal);
  return model;
}

ExitCode run_links(const ExportRequest& request) {
  const CalibratedModel model = model_asked(request);
  say_if_fleet(model, request.file);
  const ExportedArm exported = request.format == "urdf"          ? calibrated_urdf(model, request.urdf)
                               : request.format == "ros2-params" ? ros2_parameters(model, request.urdf)
                                                                 : ur_calibration(model);
  for (const std::string& note : exported.notes) fmt::print(stderr, "{}: {}\n", request.file, note);
  write_or_print(request, exported.text);
  return ExitCode::done;
}

ExitCode run_export(const ExportRequest& request) {
  if (!code_languages().contains(request.format)) return run_links(request);
  Algebra algebra;
  auto [listing, described, radius] = listing_asked(algebra, request);
  if (request.derivative > static_cast<int>(listing.actual.size())) {
    throw InputError({request.file, 0}, std::to_string(request.derivative),
                     "is no joint of this arm, which has " + std::to_string(listing.actual.size()));
  }
  if (request.derivative > 0) listing = derivative(listing, request.derivative);
  const CodeLanguage language = code_languages().at(request.format);
  const bool with_inverse = described && language == CodeLanguage::c && request.derivative == 0;
  std::string text_of_radius;
  if (radius && request.derivative == 0) text_of_radius = radius_code(*radius, listing, language);
  if (!text_of_radius.empty()) {
    listing.also = radius->expressions();
    listing.with_radius = true;
  }
  const std::string text = code_of(listing, language);
  write_or_print(request, text + (with_inverse ? inverse_in_c(listing, *described) : "") + text_of_radius);
  return ExitCode::done;
}

struct EvaluateRequest {
  std::string model_file;
  std::vector<std::string> data_files;
  bool json = false, refit_base = false, force = false;
};

/// The model in the data's own frame: base and tool fitted on the calibration poses, everything else as it is.
CorrectedRobot registered(const CalibratedModel& model, const DataSet& data) {
  const DeclaredModel base_and_tool{.registration = true, .tool = true};
  CorrectedRobot start = model.robot;
  if (model.fleet) start.tools = nominal_robot(data).tools;
  const Fit fit = fit_registration(data, poses_of(data, PoseSet::calibration), base_and_tool, start);
  if (fit.status != FitStatus::converged) throw InputError({data.file, 0}, "", fit.sentence);
  return fit.robot;
}

/// What is known of the numbers of `robot`, whose base and tools were `refitted` to the data or stand where they stood.
Posterior posterior_of(const CalibratedModel& model, const CorrectedRobot& robot, const DataSet& data, bool refitted) {
  return refitted && model.interval ? registered_posterior(*model.posterior, *model.interval, robot, data,
                                                           poses_of(data, PoseSet::calibration))
                                    : posterior_seen(*model.posterior, model.robot, robot, model.stations, data);
}

ExitCode run_evaluate(const EvaluateRequest& request) {
  CalibratedModel model = load_model(request.model_file);
  say_if_fleet(model, request.model_file);
  CheckedData checked = load_checked(request.data_files, StationTools::own, request.force);
  const DataSet& data = checked.data;
  if (refuses(checked, request.force, ShownFindings::all)) return ExitCode::contradiction;
  if (request.refit_base && !model.fleet) require_same_arm(model.robot, data);
  // A fleet stands nowhere: base and tool are those of the data.
  const CorrectedRobot robot = request.refit_base || model.fleet
                                   ? registered(model, data)
                                   : seen_from_stations(model.robot, model.stations, data);
  require_same_arm(robot, data);
  if (!request.force) require_alike_arm(model, data);
  if (!request.force && !request.refit_base && !model.fleet) require_alike_tool(model, data);
  if (model.posterior) model.posterior = posterior_of(model, robot, data, request.refit_base || model.fleet);
  model.robot = robot;
  check_fitted(data, robot, model.posterior, model.interval, checked.check);
  Evaluation evaluation{errors_by_set(robot, data),
                        pose_errors(data, model, robot, nullptr),
                        data_check_entry(checked.check),
                        unapplied_effects(robot, data),
                        {},
                        uncertainty_of(model, data, judged_poses(data), model.certificate.instrument_uncertainty_m)};
  evaluation.beyond_radii = beyond_radii_sentence(evaluation.pose_errors);
  if (model.posterior && model.interval) {
    std::vector<std::size_t> rows(data.poses.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    evaluation.widened_by = widened_sentences(model, data, rows);
  }
  if (!evaluation.beyond_radii.empty()) evaluation.uncertainty.reset();
  evaluation.touches = has_contacts(data);
  if (evaluation.touches && !has_instrument(data)) {
    evaluation.uncertainty.reset();
    evaluation.of_one_contact = model.of_one_contact;
    if (!model.of_one_contact) evaluation.workspace_error = workspace_entry(model, false);
  }
  evaluation.length_errors = length_error_entries(data, robot, nullptr);
  if (model.interval) evaluation.prediction = prediction_entry(*model.interval);
  fmt::print(stderr, "{}", to_terminal(evaluation.data_check, ShownFindings::all));
  if (std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return pose.orientation.has_value(); })) {
    evaluation.orientations_judged = false;
    fmt::print(stderr, "{}: orientations are not judged, only positions are\n", data.file);
  }
  for (const UnappliedEffect& one : evaluation.effects_not_applied)
    fmt::print(stderr, "{}: {}\n", data.file, one.sentence);
  if (const std::string untold = untold_lengths_sentence(data); !untold.empty())
    fmt::print(stderr, "{}: {}\n", data.file, untold);
  fmt::print("{}", request.json ? to_json(evaluation) : to_terminal(evaluation));
  return ExitCode::done;
}

}  // namespace

void add_export(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<ExportRequest>();
  CLI::App* command =
      app.add_subcommand("export", "the corrected forward model as formulas or code, or the arm for ROS");
  command->add_option("model", request->file, "MODEL.yaml; or a ROBOT.yaml, or matrices of text")->required();
  command->add_option("--format", request->format, "text, c, python, matlab, urdf, ros2-params or ur-calibration")
      ->check(CLI::IsMember({"text", "c", "python", "matlab", "urdf", "ros2-params", "ur-calibration"}))
      ->capture_default_str();
  command->add_option("--out", request->out, "file to write; without it, standard output");
  add_force(*command, request->force);
  command->add_option("--target", request->target, "the tool point, where the model has several");
  command->add_option("--urdf", request->urdf, "the URDF that the robot was imported from, where it has moved");
  command->add_option("--derivative", request->derivative, "the pose's derivative by this joint, instead of the pose")
      ->check(CLI::Range(1, kMaxJoints));
  command->callback([request, &exit_code] { exit_code = run_export(*request); });
}

void add_evaluate(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<EvaluateRequest>();
  CLI::App* command = app.add_subcommand("evaluate", "position error of a model on a data set");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command->add_option("data", request->data_files, "DATASET.yaml; several: one of each station")->required();
  command->add_flag("--json", request->json, "one line of JSON");
  add_force(*command, request->force);
  command->add_flag("--refit-base", request->refit_base,
                    "fit base and tool to the data first, where the instrument or the tool was moved");
  command->callback([request, &exit_code] { exit_code = run_evaluate(*request); });
}

}  // namespace demecal

#include "acceptance/certificate.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "acceptance/touched_lengths.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "parameters/posterior.hpp"
#include "prediction/measurement.hpp"
#include "report/evaluation.hpp"

namespace demecal::inline acceptance {
namespace {

using CertifiedRows = std::vector<std::size_t>;

/// The least and largest of what the judged poses state; nothing where one of them states nothing.
Condition condition(const DataSet& data, const CertifiedRows& rows, std::string name, std::string unit,
                    const std::function<std::optional<double>(const MeasuredPose&)>& value) {
  Condition range{std::move(name), {}, {}, std::move(unit)};
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (const std::size_t row : rows) {
    const std::optional<double> one = value(data.poses[row]);
    if (!one) return range;
    lower = std::min(lower, *one);
    upper = std::max(upper, *one);
  }
  range.lower = lower;
  range.upper = upper;
  return range;
}

std::vector<Condition> conditions(const DataSet& data, const CertifiedRows& rows) {
  std::vector<Condition> all{
      condition(data, rows, "payload", "kg", [](const MeasuredPose& pose) { return pose.payload_kg; }),
      condition(data, rows, "temperature", "°C", [](const MeasuredPose& pose) { return pose.temperature_celsius; }),
      condition(data, rows, "time", "s", [](const MeasuredPose& pose) { return pose.time_s; })};
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    const bool turns = data.robot.chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
    all.push_back(condition(data, rows, fmt::format("joint {}", joint + 1), turns ? "deg" : "mm",
                            [joint, turns](const MeasuredPose& pose) -> std::optional<double> {
                              return turns ? degrees(pose.joints[joint]) : millimetres(pose.joints[joint]);
                            }));
  }
  for (int axis = 0; axis < 3; ++axis) {
    all.push_back(condition(data, rows, std::string("measured ") + "xyz"[axis], "mm",
                            [axis](const MeasuredPose& pose) -> std::optional<double> {
                              if (!pose.position_m) return std::nullopt;
                              return millimetres((*pose.position_m)[axis]);
                            }));
  }
  return all;
}

CertifiedView view_of(const DataSet& data, const std::vector<AttainedPose>& poses, const CorrectedRobot& robot) {
  CertifiedView view;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const AttainedPose& pose : poses) {
    if (!pose.has_position) continue;
    view.points_m.emplace_back(pose.attained_m, pose.accuracy_m);
    centre += pose.attained_m;
  }
  if (view.points_m.empty()) return view;
  centre /= static_cast<double>(view.points_m.size());
  const auto nearest = std::ranges::min_element(poses, {}, [&](const AttainedPose& pose) {
    return pose.has_position ? (pose.attained_m - centre).norm() : std::numeric_limits<double>::infinity();
  });
  view.arm = arm_points(robot, data.poses[nearest->rows.front()]);
  return view;
}

SetErrors errors_of(const CorrectedRobot& robot, const DataSet& data, const CertifiedRows& rows) {
  return set_errors(error_figures(robot, data, rows));
}

/// The standard deviation of a pose's mean measurement, m per axis: what its repeats show, shared out among them.
double mean_noise_m(const CalibratedModel& model, const std::vector<AttainedPose>& poses) {
  if (!model.interval) return 0.0;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const AttainedPose& pose : poses) fewest = std::min(fewest, pose.rows.size());
  const double noise_m = poses.front().has_position ? model.interval->noise_m : model.interval->distance_noise_m;
  return noise_m / std::sqrt(static_cast<double>(fewest));
}

std::vector<double> accuracies(const std::vector<AttainedPose>& poses) {
  std::vector<double> errors_m;
  for (const AttainedPose& pose : poses) errors_m.push_back(pose.accuracy_m);
  return errors_m;
}

struct BothArms {
  const CorrectedRobot& before;
  const CorrectedRobot& after;
};

std::vector<CertifiedPose> certified_poses(const CalibratedModel& model, const DataSet& data, const CertifiedRows& rows,
                                           const BothArms& arms, double tolerance_m) {
  const std::vector<AttainedPose> before = attained_poses(data, rows, arms.before);
  const std::vector<AttainedPose> after = attained_poses(data, rows, arms.after);
  std::vector<CertifiedPose> poses;
  for (std::size_t i = 0; i < after.size(); ++i) {
    CertifiedPose pose{.id = after[i].id, .target = after[i].target, .measurements = after[i].rows.size()};
    pose.before_mm = i < before.size() ? if_finite(millimetres(before[i].accuracy_m)) : std::nullopt;
    pose.after_mm = if_finite(millimetres(after[i].accuracy_m));
    pose.beyond = after[i].accuracy_m > tolerance_m;
    if (model.posterior && model.interval) {
      pose.uncertainty_mm = if_finite(millimetres(
          radius95_m(*model.interval, *model.posterior, arms.after, data, data.poses[after[i].rows.front()],
                     extrapolation(data.robot.chain, model.measured, data.poses[after[i].rows.front()].joints))));
    }
    poses.push_back(std::move(pose));
  }
  std::ranges::stable_sort(poses, std::ranges::greater{}, [](const CertifiedPose& pose) { return *pose.after_mm; });
  return poses;
}

void add_remarks(const CalibratedModel& model, const DataSet& data, const CertifiedRun& run, Certificate& certificate) {
  std::vector<std::string>& remarks = certificate.remarks;
  const std::string& set = certificate.judged_set;
  if (set != "accept") {
    remarks.push_back("The data hold no accept poses: the " + set + " poses are judged, " +
                      (set == "validation" ? "which took part in the choice of the model."
                                           : "to which the model was fitted: its error elsewhere may be larger."));
  }
  if (set == "accept" && data.sha256 != model.data_sha256)
    remarks.emplace_back("These poses were not measured in the data set that the model was calibrated with.");
  const bool touches = certificate.words.of_one == kJudgedLengths.of_one;
  if (touches)
    remarks.emplace_back(
        "No instrument saw the tool: judged are known lengths between points that the arm touched, one posture at each "
        "end. Errors that leave lengths as they are, such as where the arm stands, are not seen.");
  if (!touches && !run.fields.instrument_uncertainty_m)
    remarks.emplace_back(
        "The instrument's uncertainty is not stated (instrument_uncertainty_mm): errors of the instrument that all "
        "poses share are not in the guard band.");
  if (certificate.judgement.assumes_normal) {
    remarks.push_back(
        fmt::format("With fewer than {} poses the upper limit assumes that errors are normally distributed along one "
                    "line.",
                    fewest_without_assumption()));
  }
  if (run.refit_base)
    remarks.emplace_back(
        "Base and tool were fitted to this data set's poses that are not judged before anything else.");
  if (certificate.date_is_of_run)
    remarks.push_back("The date of measurement is not stated; the date of this document, " + run.today +
                      ", stands in its place.");
  for (const UnappliedEffect& one : unapplied_effects(model.robot, data)) remarks.push_back(one.sentence + ".");
  if (!model.posterior || !model.interval)
    remarks.emplace_back("The model file is of an older version and states no uncertainty.");
  if (data.excluded.size() > 0)
    remarks.push_back(
        fmt::format("{} measurements are excluded by name in the data set's file.", data.excluded.size()));
}

}  // namespace

std::vector<Eigen::Vector3d> arm_points(const CorrectedRobot& robot, const MeasuredPose& pose) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Isometry3d flange = walk(
      robot.chain, pose.joints, [](int, LinkParameter, const Screw&) {},
      [&](int, const Eigen::Isometry3d& frame) { points.push_back(robot.sensor_from_base * frame.translation()); });
  points.push_back(robot.sensor_from_base * (flange * robot.tool(pose.target)).translation());
  return points;
}

std::vector<std::size_t> judged_poses(const DataSet& data) {
  for (const PoseSet set : {PoseSet::accept, PoseSet::validation, PoseSet::calibration}) {
    std::vector<std::size_t> rows = poses_of(data, set);
    if (!rows.empty()) return rows;
  }
  return {};
}

CorrectedRobot refitted(const DataSet& data, const DeclaredModel& base_and_tool, const CorrectedRobot& robot) {
  constexpr std::size_t kFewest = 4;
  const PoseSet judged = data.poses[judged_poses(data).front()].set;
  CertifiedRows rows = poses_of(data, PoseSet::calibration);
  if (rows.size() < kFewest && judged == PoseSet::accept) rows = poses_of(data, PoseSet::validation);
  if (rows.size() < kFewest) rows = judged_poses(data);
  const Fit fit = fit_registration(data, rows, base_and_tool, robot);
  if (fit.status != FitStatus::converged) throw InputError({data.file, 0}, "", fit.sentence);
  return fit.robot;
}

namespace {

/// What does not depend on what was measured.
Certificate stated(const CalibratedModel& model, const DataSet& data, const CertifiedRows& rows,
                   const CertifiedRun& run) {
  Certificate certificate{.fields = run.fields,
                          .robot = run.fields.text("robot").empty() ? model.nominal.name : run.fields.text("robot"),
                          .job = model.job,
                          .model_version = model.version,
                          .version = DEMECAL_VERSION,
                          .data_name = data.name,
                          .data_sha256 = data.sha256,
                          .model_sha256 = run.model_sha256,
                          .model_data_sha256 = model.data_sha256,
                          .measured_on = run.fields.text("date").empty() ? run.today : run.fields.text("date"),
                          .issued_on = run.today,
                          .date_is_of_run = run.fields.text("date").empty(),
                          .judged_set = std::string(to_string(data.poses[rows.front()].set)),
                          .judged_rows = rows.size(),
                          .conditions = conditions(data, rows)};
  for (const CertificateField& field : kCertificateFields) {
    if (field.expected && run.fields.text(field.key).empty()) certificate.missing.emplace_back(field.title);
  }
  return certificate;
}

/// Fills in what measured positions, or lengths from fixed points, tell.
void judge_positions(const CalibratedModel& model, const DataSet& data, const CertifiedRows& rows,
                     const CertifiedRun& run, Certificate& certificate) {
  const DeclaredModel base_and_tool{.registration = true, .tool = model.declared.tool};
  const CorrectedRobot after =
      run.refit_base ? refitted(data, {.registration = true, .tool = true}, model.robot) : model.robot;
  const CorrectedRobot before = refitted(data, base_and_tool, nominal_robot(data));
  const std::vector<AttainedPose> poses = attained_poses(data, rows, after);
  if (poses.empty()) throw InputError({data.file, 0}, "", "holds neither positions nor lengths: nothing can be judged");
  certificate.before = errors_of(before, data, rows);
  certificate.after = errors_of(after, data, rows);
  certificate.before_words =
      base_and_tool.tool ? "as its maker describes it, base and tool fitted" : "as its maker describes it, base fitted";
  certificate.characteristics = characteristics(data, poses, after);
  if (!run.fields.instrument_uncertainty_m) certificate.missing.emplace_back("Uncertainty of the instrument");
  const double instrument_m = run.fields.instrument_uncertainty_m.value_or(0.0) / kCoverageFactor;
  certificate.judgement = judge(accuracies(poses), run.tolerance_m, instrument_m, mean_noise_m(model, poses));
  certificate.poses_to_decide = poses_to_decide(accuracies(poses), certificate.judgement);
  certificate.poses = certified_poses(model, data, rows, {before, after}, run.tolerance_m);
  certificate.uncertainty = uncertainty_of(model, data, rows, run.fields.instrument_uncertainty_m);
  certificate.view = view_of(data, poses, after);
}

}  // namespace

Certificate make_certificate(const CalibratedModel& model, const DataSet& data, const CertifiedRun& run) {
  const CertifiedRows rows = judged_poses(data);
  if (rows.empty()) throw InputError({data.file, 0}, "", "holds no pose to judge");
  Certificate certificate = stated(model, data, rows, run);
  if (touch_alone(data, rows)) {
    judge_lengths(model, data, rows, run, certificate);
  } else {
    judge_positions(model, data, rows, run, certificate);
  }
  add_remarks(model, data, run, certificate);
  return certificate;
}

}  // namespace demecal::inline acceptance

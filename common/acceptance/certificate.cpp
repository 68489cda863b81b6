#include "acceptance/certificate.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <string_view>

#include "acceptance/attained_pose.hpp"
#include "acceptance/remarks.hpp"
#include "acceptance/touched_lengths.hpp"
#include "data_check/searches.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
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

/// Of one measurement, m per axis: what repeats of the judged poses show from one side; nothing without any.
std::optional<double> noise_of_repeats_m(const DataSet& data, const std::vector<AttainedPose>& poses) {
  double squares_m2 = 0.0, freedom = 0.0;
  for (const AttainedPose& pose : poses) {
    if (!pose.has_position || pose.rows.size() < 2) continue;
    for (const std::size_t row : pose.rows) squares_m2 += (*data.poses[row].position_m - pose.attained_m).squaredNorm();
    freedom += 3.0 * static_cast<double>(pose.rows.size() - 1);
  }
  if (freedom == 0.0) return std::nullopt;
  return std::sqrt(squares_m2 / freedom);
}

/// The standard deviation of a pose's mean measurement, m per axis. Without repeats it is what the model's fit left,
/// which holds the model's own error too.
double mean_noise_m(const CalibratedModel& model, const DataSet& data, const std::vector<AttainedPose>& poses) {
  if (!model.interval) return 0.0;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const AttainedPose& pose : poses) fewest = std::min(fewest, pose.rows.size());
  const double left_m = poses.front().has_position ? model.interval->noise_m : model.interval->distance_noise_m;
  return noise_of_repeats_m(data, poses).value_or(left_m) / std::sqrt(static_cast<double>(fewest));
}

struct BothArms {
  const std::optional<CorrectedRobot>& before;  ///< none: the poses do not tell where it stands
  const CorrectedRobot& after;
};

std::vector<CertifiedPose> certified_poses(const CalibratedModel& model, const DataSet& data, const CertifiedRows& rows,
                                           const BothArms& arms, double tolerance_m) {
  const std::vector<AttainedPose> before =
      arms.before ? attained_poses(data, rows, *arms.before) : std::vector<AttainedPose>{};
  const std::vector<AttainedPose> after = attained_poses(data, rows, arms.after);
  std::vector<CertifiedPose> poses;
  for (std::size_t i = 0; i < after.size(); ++i) {
    CertifiedPose pose{.id = after[i].id, .target = after[i].target, .measurements = after[i].rows.size()};
    pose.before_mm = i < before.size() ? if_finite(millimetres(before[i].accuracy_m)) : std::nullopt;
    pose.after_mm = if_finite(millimetres(after[i].accuracy_m));
    pose.single_mm = if_finite(millimetres(after[i].single_m));
    pose.beyond = after[i].single_m > tolerance_m;
    pose.payload_kg = data.poses[after[i].rows.front()].payload_kg;
    pose.temperature_celsius = data.poses[after[i].rows.front()].temperature_celsius;
    pose.approach = after[i].approach;
    if (model.posterior && model.interval) {
      pose.uncertainty_mm = if_finite(
          millimetres(radius95_m(*model.interval, *model.posterior, arms.after, data, data.poses[after[i].rows.front()],
                                 widening_at(model, Stop(data.poses[after[i].rows.front()])))));
    }
    poses.push_back(std::move(pose));
  }
  std::ranges::stable_sort(poses, std::ranges::greater{}, [](const CertifiedPose& pose) { return *pose.single_mm; });
  return poses;
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

std::vector<std::size_t> placing_poses(const DataSet& data) {
  const PoseSet judged = data.poses[judged_poses(data).front()].set;
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation}) {
    if (set == judged) break;
    std::vector<std::size_t> rows = poses_of(data, set);
    if (rows.size() >= kFewestPlacingPoses) return rows;
  }
  return {};
}

namespace {

/// Nothing where the poses are too few to tell base and tool.
std::optional<CorrectedRobot> refitted_if_told(const DataSet& data, const DeclaredModel& base_and_tool,
                                               const CorrectedRobot& robot) {
  const CertifiedRows placing = placing_poses(data);
  const Fit fit = fit_registration(data, placing.empty() ? judged_poses(data) : placing, base_and_tool, robot);
  if (fit.status == FitStatus::too_few_poses) return std::nullopt;
  if (fit.status != FitStatus::converged) throw InputError({data.file, 0}, "", fit.sentence);
  return fit.robot;
}

}  // namespace

CorrectedRobot refitted(const DataSet& data, const DeclaredModel& base_and_tool, const CorrectedRobot& robot) {
  if (const std::optional<CorrectedRobot> told = refitted_if_told(data, base_and_tool, robot)) return *told;
  throw InputError({data.file, 0}, "", "holds too few poses to fit base and tool to: measure more of them");
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
  if (run.refit_base && placing_poses(data).empty())
    throw InputError(
        {data.file, 0}, "--refit-base",
        fmt::format("needs {} poses beside those that are judged, and the data hold none or fewer: what is "
                    "fitted to the judged poses proves nothing of others",
                    kFewestPlacingPoses));
  const DeclaredModel base_and_tool{.registration = true, .tool = model.declared.tool};
  const CorrectedRobot after =
      run.refit_base ? refitted(data, {.registration = true, .tool = true}, model.robot) : model.robot;
  const std::vector<AttainedPose> poses = attained_poses(data, rows, after);
  if (poses.empty()) throw InputError({data.file, 0}, "", "holds neither positions nor lengths: nothing can be judged");
  // Base and tool that are fitted to three positions bring the arm to all of them, however it errs.
  const bool told = !placing_poses(data).empty() || poses.size() >= kFewestPlacingPoses;
  const std::optional<CorrectedRobot> before =
      told ? refitted_if_told(data, base_and_tool, nominal_robot(data)) : std::nullopt;
  if (before) certificate.before = errors_of(*before, data, rows);
  certificate.after = errors_of(after, data, rows);
  certificate.before_words =
      base_and_tool.tool ? "as its maker describes it, base and tool fitted" : "as its maker describes it, base fitted";
  certificate.characteristics = characteristics(data, poses, after);
  if (!run.fields.instrument_uncertainty_m) certificate.missing.emplace_back("Uncertainty of the instrument");
  const double instrument_m = run.fields.instrument_uncertainty_m.value_or(0.0) / kCoverageFactor;
  const ErrorsByPlace errors = errors_by_place(poses);
  certificate.judgement =
      judge(errors.single_m, errors.mean_m, run.tolerance_m, instrument_m, mean_noise_m(model, data, poses));
  const PoseSet set = data.poses[rows.front()].set;
  if (const std::string known = known_poses_sentence(model, data, rows); !known.empty()) {
    withhold(certificate.judgement, known + ", and their errors say nothing of other places");
  } else if (set != PoseSet::calibration && find_shared_poses(data, set)) {
    withhold(certificate.judgement, "the " + certificate.judged_set +
                                        " poses stand at the joints of calibration poses, and their errors say nothing "
                                        "of other places");
  } else {
    certificate.poses_to_decide = poses_to_decide(errors.single_m, errors.mean_m, certificate.judgement);
  }
  CalibratedModel placed = model;
  if (placed.posterior && placed.interval && run.refit_base)
    placed.posterior = registered_posterior(*placed.posterior, *placed.interval, after, data, placing_poses(data));
  placed.robot = after;
  certificate.poses = certified_poses(placed, data, rows, {before, after}, run.tolerance_m);
  if (beyond_radii_sentence(certificate).empty())
    certificate.uncertainty = uncertainty_of(placed, data, rows, run.fields.instrument_uncertainty_m);
  certificate.view = view_of(data, poses, after);
}

/// Of poses that had no part in a model none is fitted to or chosen by, whatever set was drawn for it.
DataSet all_judged(DataSet data) {
  for (MeasuredPose& pose : data.poses) pose.set = PoseSet::accept;
  return data;
}

Certificate certificate_of_sets(const CalibratedModel& model, const DataSet& data, const CertifiedRun& run) {
  const CertifiedRows rows = judged_poses(data);
  if (rows.empty()) throw InputError({data.file, 0}, "", "holds no pose to judge");
  Certificate certificate = stated(model, data, rows, run);
  if (touch_alone(data, rows)) {
    judge_lengths(model, data, rows, run, certificate);
  } else {
    judge_positions(model, data, rows, run, certificate);
  }
  certificate.remarks = remarks_on(certificate, model, data, run);
  return certificate;
}

}  // namespace

Certificate make_certificate(const CalibratedModel& model, const DataSet& data, const CertifiedRun& run) {
  const bool as_drawn = run.sets_stated || run.refit_base || is_calibrated_with(model, data);
  return as_drawn ? certificate_of_sets(model, data, run) : certificate_of_sets(model, all_judged(data), run);
}

}  // namespace demecal::inline acceptance

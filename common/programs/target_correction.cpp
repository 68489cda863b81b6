#include "programs/target_correction.hpp"

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "parameters/posterior.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program_text.hpp"
#include "prediction/corrected_robot.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal::inline programs {
namespace {

constexpr double kExact = 1e-9;                ///< m
constexpr double kPositionWorthSaying = 5e-5;  ///< m
constexpr double kTurnWorthSaying = 3.5e-4;    ///< rad: 0.02 deg

/// "z of the flange", or the direction's numbers where it is near to no axis.
std::string axis_name(const Eigen::Vector3d& direction, const Eigen::Matrix3d& flange) {
  constexpr double kAlong = 0.97;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, static_cast<char>('X' + axis));
    if (std::abs(direction[axis]) > kAlong) return letter + " of the base frame";
    if (std::abs(direction.dot(flange.col(axis))) > kAlong) return letter + " of the flange";
  }
  return "(" + fixed_text(direction.x(), 2) + ", " + fixed_text(direction.y(), 2) + ", " +
         fixed_text(direction.z(), 2) + ") of the base frame";
}

std::string left_sentence(const std::string& what, const DeterminedPart& part, const std::string& deviation,
                          const Eigen::Matrix3d& flange) {
  return what + axis_name(part.omitted, flange) + " is not determined by the calibration (standard deviation " +
         deviation + "): left as programmed";
}

/// Where the model's tool is to go: the nominal pose, as far as the correction to it is determined.
Eigen::Isometry3d goal_of(const Target& target, const CommandModel& model, CorrectedTarget& corrected) {
  if (!model.posterior) return corrected.nominal_tool;
  Eigen::Isometry3d goal = model.robot.predict(corrected.stop, "");
  const PoseError correction = pose_error(goal, corrected.nominal_tool);
  const Widening there_by = widening_at(model, corrected.stop);
  const PoseCovariance covariance =
      std::pow(there_by.factor, 2) * pose_covariance(*model.posterior, model.robot, corrected.stop) +
      there_by.held_covariance;
  const DeterminedPart position =
      determined_part(correction.head<3>(), covariance.topLeftCorner<3, 3>(), kPositionWorthSaying);
  const DeterminedPart turn =
      determined_part(correction.tail<3>(), covariance.bottomRightCorner<3, 3>(), kTurnWorthSaying);
  const Eigen::Matrix3d& flange = corrected.nominal_tool.linear();
  corrected.left_m = (correction.head<3>() - position.applied).norm();
  if (position.deviation > 0.0) {
    const std::string deviation = fixed_text(millimetres(position.deviation), 2) + " mm";
    corrected.remarks.push_back(left_sentence("position along ", position, deviation, flange));
    corrected.left.push_back(corrected.remarks.back());
  }
  if (turn.deviation > 0.0 && !(target.is_pose() && keeps_orientation(target))) {
    const std::string deviation = fixed_text(degrees(turn.deviation), 3) + " deg";
    corrected.left.push_back(left_sentence("orientation about ", turn, deviation, flange));
  }
  goal.translation() += position.applied;
  goal.linear() = (rotation_of(turn.applied) * goal.linear()).eval();
  return goal;
}

/// Where the orientation is kept, moves the position until the model predicts the tool point at the goal's.
void settle_position(const Target& target, const CommandModel& model, const Eigen::Vector3d& goal_m,
                     CorrectedTarget& corrected) {
  constexpr int kMostRepetitions = 10;
  constexpr double kLargestMotion = 0.05;  ///< rad or m
  if (!keeps_orientation(target) || corrected.command == corrected.nominal) return;
  Eigen::Isometry3d tool(corrected.nominal_tool.linear());
  tool.translation() = corrected.command_tool.translation();
  JointVector joints = corrected.command;
  for (int repetition = 0; repetition < kMostRepetitions; ++repetition) {
    const auto solved = nominal_joints(model.nominal.chain, tool, {.near = joints}, joints, target.held());
    if (!solved || (*solved - corrected.nominal).cwiseAbs().maxCoeff() > kLargestMotion) return;
    joints = *solved;
    const Eigen::Vector3d error = goal_m - model.robot.predict(corrected.stop.with_joints(joints), "").translation();
    const bool first = repetition == 0;
    if (first || error.norm() <= corrected.residual_m) {
      corrected.command = joints;
      corrected.command_tool = tool;
      corrected.residual_m = error.norm();
    }
    if (error.norm() < kExact) {
      corrected.outcome = CorrectionOutcome::corrected;
      return;
    }
    tool.translation() += error;
  }
}

}  // namespace

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return {buffer.data(), end.ptr};
}

std::string joint_amount(const Joint& joint, double value) {
  if (!is_revolute(joint)) return fixed_text(millimetres(value), 3) + " mm";
  return fixed_text(degrees(value), 4) + " deg";
}

std::string joint_label(int joint) {
  return "joint " + std::to_string(joint + 1);
}

Widening widening_at(const CommandModel& model, const Stop& stop) {
  return widening(model.robot, {model.measured, model.gaps}, stop);
}

std::optional<double> error95_m(const CommandModel& model, const Stop& stop) {
  if (!model.posterior || !model.interval) return std::nullopt;
  return real_radius95_m(*model.interval, *model.posterior, model.robot, stop, widening_at(model, stop));
}

CorrectedTarget correct_target(const Target& target, const CommandModel& model, const Stop& stop) {
  CorrectedTarget corrected;
  corrected.stop = stop;
  corrected.held = target.held();
  corrected.nominal = stop.joints;
  corrected.nominal_tool = model.nominal_tool(stop.joints);
  const Eigen::Isometry3d goal = corrected.goal = goal_of(target, model, corrected);
  const InverseSolution solution = nearby_command(model.robot, goal, stop, target.held());
  corrected.inverse = corrected.command = solution.q;
  corrected.outcome =
      solution.status == InverseStatus::converged ? CorrectionOutcome::corrected : CorrectionOutcome::nearest;
  corrected.residual_m = solution.position_residual_m;
  corrected.residual_rad = solution.orientation_residual_rad;
  corrected.command_tool = model.nominal_tool(corrected.command);
  if (target.is_pose()) settle_position(target, model, goal.translation(), corrected);
  corrected.error95_m = error95_m(model, stop);
  if (corrected.error95_m) corrected.widened_by = widening_at(model, stop).sentences();
  if (corrected.error95_m) *corrected.error95_m += corrected.left_m + corrected.residual_m;
  return corrected;
}

std::vector<std::string> cell_texts(const Target& target, const CorrectedTarget& corrected) {
  std::vector<std::string> texts;
  const bool changed = !corrected.is_uncorrected() && corrected.command != corrected.nominal;
  const auto add = [&](const Cell& cell, double value) {
    texts.push_back(changed ? rewritten(cell, value).value_or("") : "");
  };
  if (corrected.is_uncorrected()) return texts;
  for (std::size_t i = 0; i < target.joints.size(); ++i) {
    add(target.joints[i], corrected.command[target.held() + static_cast<Eigen::Index>(i)]);
  }
  const Eigen::Isometry3d in_frame = target.frames.base_from_frame.inverse() * corrected.command_tool;
  for (std::size_t i = 0; i < target.position.size(); ++i) {
    add(target.position[i], in_frame.translation()[static_cast<Eigen::Index>(i)]);
  }
  if (keeps_orientation(target)) return texts;
  const std::vector<double> numbers =
      numbers_of(in_frame.linear() * tool_axes(target), target.form, inside(target.orientation));
  for (std::size_t i = 0; i < numbers.size(); ++i) add(target.orientation[i], numbers[i]);
  return texts;
}

double rounding_m(const Target& target, const CommandModel& model, const CorrectedTarget& corrected) {
  const auto written = [&](const Cell& cell, std::size_t text) {
    const auto number = parse_number(corrected.texts[text]);
    return number ? *number * cell.unit : cell.inside();
  };
  if (corrected.texts.empty() || corrected.command == corrected.nominal) return 0.0;
  if (target.is_pose()) {
    Eigen::Vector3d in_frame = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < target.position.size(); ++i)
      in_frame[static_cast<Eigen::Index>(i)] = written(target.position[i], i);
    return (target.frames.base_from_frame * in_frame - corrected.command_tool.translation()).norm();
  }
  JointVector joints = corrected.command;
  for (std::size_t i = 0; i < target.joints.size(); ++i)
    joints[target.held() + static_cast<Eigen::Index>(i)] = written(target.joints[i], i);
  return (model.nominal_tool(joints).translation() - corrected.command_tool.translation()).norm();
}

}  // namespace demecal::inline programs

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "fitting/base_search.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

std::string axis_letter(int axis) {
  return std::string(1, "xyz"[axis]);
}

/// The signed permutation within a tenth of `map`, if there is one.
std::optional<Eigen::Matrix3d> signed_permutation(const Eigen::Matrix3d& map) {
  const Eigen::Matrix3d rounded = map.array().round().matrix();
  if ((map - rounded).cwiseAbs().maxCoeff() > 0.1) return std::nullopt;
  if ((rounded.cwiseAbs().rowwise().sum().array() != 1.0).any()) return std::nullopt;
  return rounded;
}

Explanation named_axes(const Eigen::Matrix3d& permutation) {
  std::string reading;
  bool exchanged = false;
  for (int axis = 0; axis < 3; ++axis) {
    int from = 0;
    permutation.col(axis).cwiseAbs().maxCoeff(&from);
    exchanged = exchanged || from != axis;
    reading += fmt::format("{}{} is {}{}", axis == 0 ? "" : ", ", axis_letter(axis),
                           permutation(from, axis) < 0 ? "-" : "", axis_letter(from));
  }
  const std::string clause = "the columns of the position are read so: " + reading;
  return {exchanged ? FindingKind::axes_exchanged : FindingKind::mirrored, -1, clause, nullptr};
}

/// The cosine of the angle between the base's z axis and the instrument's where axes `one` and `other` are exchanged
/// in place of y negated.
double upright_if_exchanged(const Eigen::Matrix3d& base, int one, int other) {
  Eigen::Vector3d z = base.col(2);
  z.y() = -z.y();
  std::swap(z[one], z[other]);
  return std::abs(z.z());
}

constexpr double kTurnedTool_m = 3e-3;  ///< within which a tool stands where a turn of the last joint puts it

double median_error_m(const TrialFit& fit, const Trial& trial) {
  std::vector<double> errors;
  for (const TrialRow& row : trial.rows) errors.push_back((row.point_m - predicted_point(fit, row)).norm());
  return median(std::move(errors));
}

/// The quarter turns of a last revolute joint that put the nominal tool where it was found, if any do.
std::optional<double> turn_of_last_joint(const Chain& chain, const Eigen::Vector3d& nominal,
                                         const Eigen::Vector3d& found) {
  const Joint& last = chain.joints.back();
  const double radius_m = nominal.head<2>().norm();
  // A link that follows the last axis on a slant has no such simple form.
  const bool along_axis = chain.convention == Convention::modified_dh || (last.a_m == 0.0 && last.alpha_rad == 0.0);
  if (!is_revolute(last) || !along_axis || !chain.flange.matrix().isIdentity(0.0) || radius_m < 4.0 * kTurnedTool_m)
    return std::nullopt;
  for (const double turn_deg : {90.0, -90.0, 180.0}) {
    const Eigen::Vector3d turned = rotation_of(Eigen::Vector3d(0, 0, radians(turn_deg))) * nominal;
    if ((turned - found).norm() < kTurnedTool_m) return turn_deg;
  }
  return std::nullopt;
}

bool is_elsewhere(const TrialFit& fit, int target, const Eigen::Vector3d& nominal) {
  const Eigen::Vector3d change = fit.tools_m[static_cast<std::size_t>(target)] - nominal;
  return nominal.norm() > 0.0 && fit.has_links() && is_another_tool(change, fit.tool_covariance(target));
}

Finding other_tool(const Trial& trial, int target, const TrialFit& fit, const std::string& which) {
  const auto at = static_cast<std::size_t>(target);
  const Eigen::Vector3d nominal = trial.tools_m[at], found = fit.tools_m[at];
  TrialFit given = fit;
  given.tools_m[at] = nominal;
  Finding finding{.as_given_mm = millimetres(median_error_m(given, trial)), .if_changed_mm = millimetres(fit.median_m)};
  if (const auto turn_deg = turn_of_last_joint(trial.chain, nominal, found)) {
    finding.kind = FindingKind::joint_offset;
    finding.joint = trial.chain.size() - 1;
    finding.sentence = fmt::format(
        "{} lies where {:+g} deg of joint {} would put it: the joint's zero, or the way the tool is "
        "mounted, is not that of the robot file. Correct the data or the file.",
        which, *turn_deg, trial.chain.size());
    return finding;
  }
  finding.kind = FindingKind::wrong_tool;
  finding.sentence = fmt::format(
      "{} lies {} from where the robot file has it, at ({:.1f}, {:.1f}, {:.1f}) mm: another tool, or another point of "
      "it, was measured. Correct tool_mm, or tools_mm of the data set.",
      which, distance_text((found - nominal).norm()), millimetres(found.x()), millimetres(found.y()),
      millimetres(found.z()));
  return finding;
}

}  // namespace

bool is_another_tool(const Eigen::Vector3d& change_m, const Eigen::Matrix3d& covariance_m2) {
  constexpr double kSureDeviations = 5.0;
  return change_m.norm() >= kOtherTool_m &&
         change_m.dot(solve_pivoted(covariance_m2, change_m)) >= kSureDeviations * kSureDeviations * 3.0;
}

Explanation axes_explanation(const Eigen::Isometry3d& sensor_from_base, bool is_base) {
  constexpr double kUpright = 0.87;
  const Eigen::Matrix3d base = sensor_from_base.linear();
  if (is_base) {
    const Eigen::Matrix3d map = Eigen::Vector3d(1, -1, 1).asDiagonal() * base;
    if (const auto permutation = signed_permutation(map)) return named_axes(*permutation);
  }
  if (std::abs(base(2, 2)) < kUpright) {
    for (const auto& [one, other] : {std::pair(1, 2), std::pair(0, 2)}) {
      if (upright_if_exchanged(base, one, other) < kUpright) continue;
      return {FindingKind::axes_exchanged, -1,
              fmt::format("the columns {} and {} of the position are exchanged: the base then stands upright",
                          axis_letter(one), axis_letter(other)),
              nullptr};
    }
  }
  return {FindingKind::mirrored, -1,
          "one axis of the positions is negated, or two are exchanged (the instrument's frame is left-handed as given)",
          nullptr};
}

std::optional<Explanation> base_frame_explanation(const Eigen::Isometry3d& sensor_from_base) {
  constexpr double kTurn_rad = radians(5.0), kShift_m = 0.05;
  const Eigen::Vector3d turn = vector_of(sensor_from_base.linear());
  if (turn.norm() < kTurn_rad && sensor_from_base.translation().norm() < kShift_m) return std::nullopt;
  const double quarters = turn.norm() / (std::numbers::pi / 2);
  const bool about_z = std::abs(turn.normalized().z()) > 0.99 && std::abs(quarters - std::round(quarters)) < 0.06;
  if (about_z && turn.norm() > 1.0 && sensor_from_base.translation().norm() < kShift_m)
    return Explanation{
        FindingKind::joint_offset, 0,
        fmt::format("{:+g} deg are added to joint 1", 90.0 * std::round(turn.z() / (std::numbers::pi / 2))), nullptr};
  const auto permutation = signed_permutation(sensor_from_base.linear());
  if (permutation && turn.norm() > 1.0 && sensor_from_base.translation().norm() < kShift_m)
    return named_axes(*permutation);
  return Explanation{FindingKind::set_in_other_frame, -1,
                     fmt::format("the base stands {:.0f} mm and {:.1f} deg from where `frame: base` puts it (if the "
                                 "positions are in the instrument's frame, say `frame: sensor`)",
                                 millimetres(sensor_from_base.translation().norm()), degrees(turn.norm())),
                     nullptr};
}

std::vector<Finding> find_other_base(const DataSet& data, const TrialFit& fit) {
  if (data.frame != Frame::base) return {};
  const auto explanation = base_frame_explanation(fit.sensor_from_base.front());
  if (!explanation) return {};
  return {{.kind = explanation->kind,
           .joint = explanation->joint,
           .sentence = contradicts(explanation->kind)
                           ? "The data, said to be in the base's frame, fit if " + explanation->clause +
                                 ". Correct the data or the robot file."
                           : "The data are not in the base's frame: " + explanation->clause + "."}};
}

std::vector<Finding> find_other_tools(const Trial& trial, const std::map<std::string, int>& target_of,
                                      const TrialFit& fit) {
  std::vector<Finding> found;
  for (const auto& [name, target] : target_of) {
    if (!is_elsewhere(fit, target, trial.tools_m[static_cast<std::size_t>(target)])) continue;
    found.push_back(
        other_tool(trial, target, fit, name.empty() ? "The tool point" : "The tool point of target " + name));
  }
  return found;
}

}  // namespace demecal::inline data_check

#include "data_check/tools_and_base.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <optional>

#include "data_check/axes.hpp"
#include "fitting/median.hpp"
#include "kinematics/rotation_vector.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

constexpr double kOtherTool_m = 0.01;    ///< as CommandModel's: farther off another tool was measured
constexpr double kSureDeviations = 5.0;  ///< by which the tool is known to be elsewhere
constexpr double kTurnedTool_m = 3e-3;   ///< within which a tool stands where a turn of the last joint puts it

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
  if (!is_revolute(last) || !along_axis || radius_m < 4.0 * kTurnedTool_m) return std::nullopt;
  for (const double turn_deg : {90.0, -90.0, 180.0}) {
    const Eigen::Vector3d turned = rotation_of(Eigen::Vector3d(0, 0, radians(turn_deg))) * nominal;
    if ((turned - found).norm() < kTurnedTool_m) return turn_deg;
  }
  return std::nullopt;
}

bool is_elsewhere(const TrialFit& fit, int target, const Eigen::Vector3d& nominal) {
  const Eigen::Vector3d change = fit.tools_m[static_cast<std::size_t>(target)] - nominal;
  if (nominal.norm() == 0.0 || change.norm() < kOtherTool_m || !fit.has_links()) return false;
  return change.dot(fit.tool_covariance(target).ldlt().solve(change)) >= kSureDeviations * kSureDeviations * 3.0;
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

}  // namespace demecal

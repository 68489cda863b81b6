#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/written_steps.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "prediction/only_places.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kComputedShare = 1e-5;      ///< of the reach, which no instrument and no arm keeps
constexpr double kMostRoundingShare = 8e-5;  ///< of the reach: coarser rounding could hide the errors of a good arm
constexpr double kOverRounding = 1.0;        ///< median error over the root mean square of rounding
constexpr double kFewestPosesTold = 12.0;    ///< different ones, below which base and tool explain too much

/// The error that rounding to the table's last places alone leaves, root mean square.
double rounding_m(const Trial& trial, const TrialFit& placed) {
  std::vector<double> positions;
  std::vector<JointVector> joints;
  for (const TrialRow& row : trial.rows) {
    positions.insert(positions.end(), row.point_m.begin(), row.point_m.end());
    joints.push_back(row.joints);
  }
  const JointSteps steps = joint_steps(trial.chain, joints);
  const double position_m = decimal_step(positions, metres(1.0));
  double squares = 0.0;
  for (const TrialRow& row : trial.rows)
    squares += position_m * position_m / 4.0 +
               rounding_m2(placed.chain, row.joints, placed.tools_m[static_cast<std::size_t>(row.target)], steps);
  return std::sqrt(squares / static_cast<double>(trial.rows.size()));
}

}  // namespace

std::optional<Finding> find_computed_positions(const Trial& trial, const TrialFit& placed) {
  if (static_cast<double>(trial.rows.size()) < kFewestPosesTold * placed.rows_per_pose) return std::nullopt;
  const double reach_m = trial.reach_m(), rounded_m = rounding_m(trial, placed);
  const bool by_rounding = rounded_m < kMostRoundingShare * reach_m && placed.median_m < kOverRounding * rounded_m;
  if (!by_rounding && placed.median_m > kComputedShare * reach_m) return std::nullopt;
  return Finding{
      .kind = FindingKind::computed_positions,
      .as_given_mm = millimetres(placed.median_m),
      .sentence = fmt::format(
          "With base and tool alone the nominal arm reaches half of the points to within {:.2g} mm{}: these are "
          "positions "
          "that "
          "the controller (or a simulation) computed from the joints, not measured ones. Measure the points with an "
          "instrument: computed ones say nothing about the arm.",
          std::max(millimetres(placed.median_m), 1e-4),
          by_rounding ? ", the rounding of the file" : ", as no arm does")};
}

std::optional<Finding> find_computed_contacts(const DataSet& data, const CorrectedRobot& stiff) {
  constexpr std::size_t kFewestPosesTouching = 12;  ///< besides those that only place a contact
  constexpr double kComputedTouch = 2e-5;           ///< of the reach, to which plans reach contacts and no arm does
  std::vector<JointVector> joints;
  std::vector<std::size_t> told;
  double reach_m = 0.1;
  for (const auto& [group, members] : contact_groups(data)) {
    if (only_places(data.contacts.form_of(group.contact), members.size())) continue;
    told.insert(told.end(), members.begin(), members.end());
  }
  for (const std::size_t pose : told) {
    joints.push_back(data.poses[pose].joints);
    reach_m = std::max(reach_m, touch_of(stiff, data.poses[pose]).point_m.norm());
  }
  if (told.size() < kFewestPosesTouching) return std::nullopt;
  const JointSteps steps = joint_steps(stiff.chain, joints);
  double squares_m2 = 0.0;
  for (const std::size_t pose : told)
    squares_m2 +=
        rounding_m2(stiff.chain, data.poses[pose].joints, stiff.tool(data.poses[pose].target).translation(), steps);
  const double rounded_m = std::sqrt(squares_m2 / static_cast<double>(told.size()));
  const double left_m = median(tool_errors_m(stiff, data, told));
  const bool by_rounding = rounded_m < kMostRoundingShare * reach_m && left_m < kOverRounding * rounded_m;
  if (!by_rounding && left_m > kComputedTouch * reach_m) return std::nullopt;
  return Finding{
      .kind = FindingKind::computed_positions,
      .as_given_mm = millimetres(left_m),
      .sentence = fmt::format(
          "With its tool alone fitted the nominal arm holds half of the poses to within {:.2g} mm of what they "
          "touch{}: "
          "these are joint values that a plan (or a simulation) computed, not those of an arm that touched something. "
          "Replace them by what the controller shows once the tool is seated: computed ones say nothing about the arm.",
          std::max(millimetres(left_m), 1e-4), by_rounding ? ", the rounding of the file" : ", as no arm does")};
}

}  // namespace demecal::inline data_check

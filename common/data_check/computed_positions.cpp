#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/written_steps.hpp"
#include "data_check/finding.hpp"
#include "data_check/searches.hpp"
#include "data_check/trial_fit.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"

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

}  // namespace demecal::inline data_check

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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

/// The coarsest decimal place of a unit that all values are written to; 0 where they are written finer than 1e-5 units.
double decimal_step(const std::vector<double>& values, double unit) {
  for (int decimals = 0; decimals <= 5; ++decimals) {
    const double step = unit * std::pow(10.0, -decimals);
    const auto is_multiple = [step](double value) { return std::abs(value / step - std::round(value / step)) < 1e-3; };
    if (std::ranges::all_of(values, is_multiple)) return step;
  }
  return 0.0;
}

/// The last places of a table: of joints that turn, rad, of those that slide, m, and of positions, m.
struct TableSteps {
  double angle_rad = 0.0, slide_m = 0.0, position_m = 0.0;
};

TableSteps steps_of(const Trial& trial) {
  std::vector<double> angles, slides, positions;
  for (const TrialRow& row : trial.rows) {
    for (int joint = 0; joint < trial.chain.size(); ++joint)
      (is_revolute(trial.chain, joint) ? angles : slides).push_back(row.joints[joint]);
    positions.insert(positions.end(), row.point_m.begin(), row.point_m.end());
  }
  return {std::max(decimal_step(angles, radians(1.0)), decimal_step(angles, 1.0)), decimal_step(slides, metres(1.0)),
          decimal_step(positions, metres(1.0))};
}

/// The error that rounding to the table's last places alone leaves, root mean square.
double rounding_m(const Trial& trial, const TrialFit& placed) {
  constexpr double kStep = 1e-6;
  const TableSteps steps = steps_of(trial);
  double squares = 0.0;
  for (const TrialRow& row : trial.rows) {
    squares += 3.0 * steps.position_m * steps.position_m;
    for (int joint = 0; joint < trial.chain.size(); ++joint) {
      TrialRow moved = row;
      moved.joints[joint] += kStep;
      const double lever = (predicted_point(placed, moved) - predicted_point(placed, row)).norm() / kStep;
      const double step = is_revolute(trial.chain, joint) ? steps.angle_rad : steps.slide_m;
      squares += lever * lever * step * step;
    }
  }
  return std::sqrt(squares / 12.0 / static_cast<double>(trial.rows.size()));
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

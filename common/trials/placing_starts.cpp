#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "fitting/base_search.hpp"
#include "trials/placed_rows.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

constexpr int kPlacingTurns = 60;  ///< orientations of the base that a search starts from

/// Tools and the base's translation at least squares for its orientation, in which they are linear.
void place_tools(const Trial& trial, const PlacedRows& placed, const Eigen::Matrix3d& turn, TrialFit& fit) {
  const auto rows = static_cast<Eigen::Index>(trial.rows.size());
  const auto size = static_cast<Eigen::Index>(3 + 3 * trial.tools_m.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(3 * rows, size);
  Eigen::VectorXd points(3 * rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const TrialRow& row = trial.rows[at];
    const Eigen::Isometry3d& flange = placed.flange(at);
    slopes.block<3, 3>(3 * i, 0).setIdentity();
    slopes.block<3, 3>(3 * i, 3 + 3 * row.target) = turn * flange.linear();
    points.segment<3>(3 * i) = row.point_m - turn * flange.translation();
  }
  const Eigen::VectorXd places_m = least_norm_solution(slopes, points);
  fit.sensor_from_base.front().linear() = turn;
  fit.sensor_from_base.front().translation() = places_m.head<3>();
  for (std::size_t i = 0; i < fit.tools_m.size(); ++i)
    fit.tools_m[i] = places_m.segment<3>(3 + 3 * static_cast<Eigen::Index>(i));
}

}  // namespace

TrialFit search_base_and_tools(const Trial& trial, const TrialFit& placed) {
  const PlacedRows described(trial.chain, trial.rows, false), rows(placed.chain, trial.rows, false);
  TrialFit best = placed;
  for (int turn = 0; turn < kPlacingTurns; ++turn) {
    TrialFit start = placed;
    place_tools(trial, described, spread_rotation(turn, kPlacingTurns), start);
    TrialFit fit = refit_base_and_tools(trial, std::move(start), rows);
    if (fit.median_m < best.median_m) best = std::move(fit);
  }
  return best;
}

}  // namespace demecal::inline trials

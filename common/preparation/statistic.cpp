#include "preparation/statistic.hpp"

#include <algorithm>
#include <cmath>

#include "effects/measurement.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

using Members = std::vector<std::size_t>;

Members members_of(const Prepared& prepared, PoseSet set) {
  Members members;
  for (std::size_t i = 0; i < prepared.poses.size(); ++i) {
    if (prepared.poses[i].commanded.set == set) members.push_back(i);
  }
  return members;
}

std::optional<FrameFigures> figures_in(const Prepared& prepared, const Members& members, FrameKind kind) {
  if (!prepared.frame(kind)) return std::nullopt;
  const std::vector<Eigen::Vector3d> all_m = differences(prepared, kind);
  FrameFigures figures;
  std::vector<double> errors_mm;
  for (const std::size_t i : members) {
    errors_mm.push_back(millimetres(all_m[i].norm()));
    figures.mean_difference_mm += 1e3 * all_m[i] / static_cast<double>(members.size());
  }
  figures.error = error_figures(std::move(errors_mm));
  return figures;
}

SetStatistic statistic_of_set(const Prepared& prepared, PoseSet set, const Members& members) {
  SetStatistic statistic{.set = set,
                         .poses = members.size(),
                         .three_points = figures_in(prepared, members, FrameKind::three_points),
                         .best_fit = figures_in(prepared, members, FrameKind::best_fit)};
  double squares_m2 = 0.0, variances_m2 = 0.0;
  bool stated = true;
  for (const std::size_t i : members) {
    const AveragedReading& measured = prepared.poses[i].measured;
    statistic.readings += measured.rows.size();
    squares_m2 += measured.squares_m2;
    stated = stated && measured.standard_error_m;
    if (stated) variances_m2 += measured.standard_error_m->squaredNorm();
  }
  const std::size_t beyond_first = statistic.readings - statistic.poses;
  if (beyond_first > 0) statistic.spread_mm = millimetres(std::sqrt(squares_m2 / static_cast<double>(beyond_first)));
  if (stated) {
    statistic.standard_error_mm = millimetres(std::sqrt(variances_m2 / static_cast<double>(members.size())));
  }
  return statistic;
}

std::optional<FramesApart> apart(const Prepared& prepared) {
  if (!prepared.three_points || !prepared.best_fit) return std::nullopt;
  FramesApart found;
  for (const PreparedPose& pose : prepared.poses) {
    const Eigen::Vector3d point_m = pose.measured.point_m;
    const double distance_mm = millimetres((*prepared.three_points * point_m - *prepared.best_fit * point_m).norm());
    found.mean_mm += distance_mm / static_cast<double>(prepared.poses.size());
    found.max_mm = std::max(found.max_mm, distance_mm);
  }
  const Eigen::Quaterniond one(prepared.three_points->linear()), other(prepared.best_fit->linear());
  found.turn_deg = degrees(one.angularDistance(other));
  return found;
}

}  // namespace

Statistic statistic_of(const RawMeasurements& raw, const Prepared& prepared) {
  Statistic statistic{.apart = apart(prepared), .fitted_to_calibration = prepared.fitted_to_calibration};
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept}) {
    const Members members = members_of(prepared, set);
    if (!members.empty()) statistic.sets.push_back(statistic_of_set(prepared, set, members));
  }
  if (raw.local_frame) statistic.taught_difference_mm = millimetres(largest_difference_m(*raw.local_frame));
  return statistic;
}

}  // namespace demecal

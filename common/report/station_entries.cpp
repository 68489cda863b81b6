#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "fitting/least_squares.hpp"
#include "kinematics/units.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/evaluation.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"

namespace demecal::inline report {
namespace {

/// Of measured positions about the model that was fitted to them; nothing where none were.
std::optional<double> fitted_noise_mm(const DataSet& data, const CorrectedRobot& robot, bool with_validation) {
  std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  if (with_validation) std::ranges::copy(poses_of(data, PoseSet::validation), std::back_inserter(fitted));
  const double deviation_m = median_deviations(data, robot, observe(data, fitted, robot))[kPosition];
  return deviation_m > 0.0 ? std::optional(millimetres(deviation_m)) : std::nullopt;
}

}  // namespace

std::vector<StationEntry> station_entries(const Conclusions& run) {
  std::vector<StationEntry> entries;
  for (const Station& station : run.data.stations) {
    const bool is_first = &station == run.data.stations.data();
    DataSet own = run.data;
    std::erase_if(own.poses, [&](const MeasuredPose& pose) { return pose.station != (is_first ? "" : station.name); });
    entries.push_back({.name = station.name,
                       .poses = own.poses.size(),
                       .registered = errors_by_set(run.preparation.registered.robot, own),
                       .before = errors_by_set(run.before, own),
                       .after = errors_by_set(run.model.robot, own),
                       .noise_mm = fitted_noise_mm(own, run.model.robot, run.calibration.unseen.has_value()),
                       .noise_floor_mm = noise_floor_mm(own)});
  }
  return entries;
}

}  // namespace demecal::inline report

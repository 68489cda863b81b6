#include "acceptance/attained_pose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "acceptance/verdict.hpp"
#include "data/same_places.hpp"
#include "effects/arm_state.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline acceptance {
namespace {

constexpr double kSamePayload_kg = 0.1, kSameTemperature_celsius = 4.0;

std::string approach_text(const MeasuredPose& pose) {
  std::string text;
  if (!pose.approach) return text;
  for (int joint = 0; joint < pose.approach->size(); ++joint)
    text += (*pose.approach)[joint] > 0 ? '+' : (*pose.approach)[joint] < 0 ? '-' : '0';
  return text;
}

/// Mean and three standard deviations of the distances from the barycentre.
double repeatability_m(const std::vector<Eigen::Vector3d>& attained_m) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : attained_m) centre += point / static_cast<double>(attained_m.size());
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : attained_m) distances.push_back((point - centre).norm());
  const double mean_m = mean(distances);
  double squares = 0.0;
  for (const double distance : distances) squares += (distance - mean_m) * (distance - mean_m);
  return mean_m + 3.0 * std::sqrt(squares / static_cast<double>(distances.size() - 1));
}

/// The error that the accepted share of them keeps within: of fewer than twenty the largest.
double error_of_share(std::vector<double> errors_m) {
  std::ranges::sort(errors_m);
  const auto rank = static_cast<std::size_t>(std::ceil(kAcceptedShare * static_cast<double>(errors_m.size())));
  return errors_m[std::max<std::size_t>(rank, 1) - 1];
}

void add_repeatability(const DataSet& data, AttainedPose& pose) {
  for (const std::vector<std::size_t>& series : in_series(data, pose.rows)) {
    if (series.size() < 2) continue;
    std::vector<Eigen::Vector3d> attained_m;
    for (const std::size_t row : series) attained_m.push_back(*data.poses[row].position_m);
    pose.repeatability_m = std::max(pose.repeatability_m.value_or(0.0), repeatability_m(attained_m));
    pose.fewest_repeats = pose.fewest_repeats == 0 ? series.size() : std::min(pose.fewest_repeats, series.size());
  }
}

/// Fills what follows from the rows of the pose.
void evaluate(const DataSet& data, const CorrectedRobot& robot, AttainedPose& pose) {
  std::vector<double> errors_m;
  double squares = 0.0;
  const auto count = static_cast<double>(pose.rows.size());
  pose.has_position = std::ranges::all_of(pose.rows, [&](std::size_t row) { return !!data.poses[row].position_m; });
  for (const std::size_t row : pose.rows) {
    const MeasuredPose& measured = data.poses[row];
    errors_m.push_back(tool_error_m(robot, data, measured));
    squares += std::pow(errors_m.back(), 2);
    if (!pose.has_position) continue;
    pose.attained_m += *measured.position_m;
    pose.commanded_m += robot.predict(Stop(measured), measured.target).translation();
  }
  pose.single_m = error_of_share(errors_m);
  if (!pose.has_position) {
    pose.accuracy_m = std::sqrt(squares / count);
    return;
  }
  pose.attained_m /= count;
  pose.commanded_m /= count;
  pose.accuracy_m = (pose.attained_m - pose.commanded_m).norm();
  add_repeatability(data, pose);
}

/// Numbers from 1 of values that differ by more than `width`, ascending; 0 of what is not stated.
std::vector<std::size_t> numbered(const std::vector<std::optional<double>>& values, double width) {
  std::vector<std::size_t> ascending, numbers(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i]) ascending.push_back(i);
  std::ranges::stable_sort(ascending, {}, [&](std::size_t i) { return *values[i]; });
  std::size_t number = 0;
  double lowest = 0.0;
  for (const std::size_t i : ascending) {
    if (number == 0 || *values[i] > lowest + width) {
      ++number;
      lowest = *values[i];
    }
    numbers[i] = number;
  }
  return numbers;
}

std::vector<std::size_t> numbered(const DataSet& data, std::span<const std::size_t> rows,
                                  std::optional<double> MeasuredPose::*value, double width) {
  std::vector<std::optional<double>> values;
  for (const std::size_t row : rows) values.push_back(data.poses[row].*value);
  return numbered(values, width);
}

}  // namespace

std::vector<AttainedPose> attained_poses(const DataSet& data, std::span<const std::size_t> rows,
                                         const CorrectedRobot& robot) {
  std::vector<std::size_t> seen;
  for (const std::size_t row : rows)
    if (std::isfinite(tool_error_m(robot, data, data.poses[row]))) seen.push_back(row);
  const std::vector<std::size_t> places = places_of(data, seen),
                                 payloads = numbered(data, seen, &MeasuredPose::payload_kg, kSamePayload_kg),
                                 temperatures =
                                     numbered(data, seen, &MeasuredPose::temperature_celsius, kSameTemperature_celsius);
  std::vector<AttainedPose> poses;
  std::map<std::tuple<std::size_t, std::string, std::string, std::size_t, std::size_t>, std::size_t> known;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const MeasuredPose& measured = data.poses[seen[i]];
    const std::string approach = approach_text(measured);
    const auto [entry, is_new] =
        known.try_emplace({places[i], measured.target, approach, payloads[i], temperatures[i]}, poses.size());
    if (is_new)
      poses.push_back({.id = measured.pose_id,
                       .target = measured.target,
                       .approach = approach,
                       .place = places[i],
                       .payload = payloads[i],
                       .temperature = temperatures[i],
                       .rows = {}});
    poses[entry->second].rows.push_back(seen[i]);
  }
  for (AttainedPose& pose : poses) evaluate(data, robot, pose);
  return poses;
}

std::vector<std::vector<std::size_t>> in_series(const DataSet& data, std::vector<std::size_t> rows) {
  constexpr double kLeastGap_s = 600.0, kMedianGaps = 5.0;
  const auto has_time = [&](std::size_t row) { return data.poses[row].time_s.has_value(); };
  if (rows.size() < 2 || !std::ranges::all_of(rows, has_time)) return {std::move(rows)};
  const auto time_s = [&data](std::size_t row) { return *data.poses[row].time_s; };
  std::ranges::stable_sort(rows, {}, time_s);
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < rows.size(); ++i) gaps_s.push_back(time_s(rows[i]) - time_s(rows[i - 1]));
  const double least_s = std::max(kLeastGap_s, kMedianGaps * median(gaps_s));
  std::vector<std::vector<std::size_t>> series(1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && gaps_s[i - 1] >= least_s) series.emplace_back();
    series.back().push_back(rows[i]);
  }
  return series;
}

AttainedPose with_rows(const DataSet& data, const CorrectedRobot& robot, const AttainedPose& pose,
                       std::vector<std::size_t> rows) {
  AttainedPose other{.id = pose.id,
                     .target = pose.target,
                     .approach = pose.approach,
                     .place = pose.place,
                     .payload = pose.payload,
                     .temperature = pose.temperature,
                     .rows = std::move(rows)};
  evaluate(data, robot, other);
  return other;
}

ErrorsByPlace errors_by_place(const std::vector<AttainedPose>& poses) {
  ErrorsByPlace errors;
  for (const AttainedPose& pose : poses) {
    if (pose.place >= errors.single_m.size()) {
      errors.single_m.resize(pose.place + 1, 0.0);
      errors.mean_m.resize(pose.place + 1, 0.0);
    }
    errors.single_m[pose.place] = std::max(errors.single_m[pose.place], pose.single_m);
    errors.mean_m[pose.place] = std::max(errors.mean_m[pose.place], pose.accuracy_m);
  }
  return errors;
}

}  // namespace demecal::inline acceptance

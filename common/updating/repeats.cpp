#include "updating/repeats.hpp"

#include "kinematics/chain.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace demecal::inline updating {
namespace {

bool same_temperature(const std::optional<double>& one, const std::optional<double>& other) {
  constexpr double kSame_K = 1.0;
  return one.has_value() == other.has_value() && (!one || std::abs(*one - *other) < kSame_K);
}

/// Logged joints scatter where the same pose was commanded: of rows of one name more is allowed.
bool is_repeat(const MeasuredPose& one, const MeasuredPose& other) {
  constexpr double kSamePlace = 2e-4, kSameName = 2e-3;  // rad or m
  const double allowed = one.pose_id == other.pose_id ? kSameName : kSamePlace;
  return (one.joints - other.joints).cwiseAbs().maxCoeff() <= allowed && one.target == other.target &&
         one.contact == other.contact && one.station == other.station && one.approach == other.approach &&
         one.payload_kg == other.payload_kg && same_temperature(one.temperature_celsius, other.temperature_celsius) &&
         one.position_m.has_value() == other.position_m.has_value() &&
         one.orientation.has_value() == other.orientation.has_value() &&
         one.distances_m.size() == other.distances_m.size();
}

/// `mean` is that of `count` repeats, and becomes that of one more.
void take_in(MeasuredPose& mean, const MeasuredPose& pose, double count) {
  const double share = 1.0 / (count + 1.0);
  mean.joints += share * (pose.joints - mean.joints);
  if (pose.position_m) *mean.position_m += share * (*pose.position_m - *mean.position_m);
  if (pose.orientation) mean.orientation = mean.orientation->slerp(share, *pose.orientation).normalized();
  for (std::size_t i = 0; i < pose.distances_m.size(); ++i)
    mean.distances_m[i] += share * (pose.distances_m[i] - mean.distances_m[i]);
  if (pose.temperature_celsius)
    *mean.temperature_celsius += share * (*pose.temperature_celsius - *mean.temperature_celsius);
}

}  // namespace

DistinctPoses distinct_poses(const DataSet& data) {
  DistinctPoses distinct{data, {}, {}};
  std::vector<MeasuredPose>& kept = distinct.data.poses;
  kept.clear();
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    const MeasuredPose& pose = data.poses[i];
    const auto first =
        std::ranges::find_if(distinct.measured, [&](std::size_t other) { return is_repeat(data.poses[other], pose); });
    if (first == distinct.measured.end()) {
      kept.push_back(pose);
      distinct.measured.push_back(i);
      distinct.repeats.push_back({i});
      continue;
    }
    const auto place = static_cast<std::size_t>(first - distinct.measured.begin());
    take_in(kept[place], pose, static_cast<double>(distinct.repeats[place].size()));
    distinct.repeats[place].push_back(i);
  }
  return distinct;
}

}  // namespace demecal::inline updating

#include "acceptance/iso9283.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "data/text.hpp"
#include "kinematics/units.hpp"
#include "random/distributions.hpp"

namespace demecal::inline acceptance {
namespace {

using AttainedPoses = std::vector<AttainedPose>;

constexpr std::size_t kCyclesOfStandard = 30;
constexpr std::size_t kCyclesThatTell = 10;  ///< of fewer, mean and deviation come out too small: of two by two thirds

Characteristic pose_accuracy(const AttainedPoses& poses) {
  Characteristic one{"AP", "Pose accuracy (position), largest", "7.2.1", {}, "no position was measured"};
  if (poses.empty()) return one;
  std::vector<double> values;
  std::size_t fewest = poses.front().rows.size(), most = 0;
  for (const AttainedPose& pose : poses) {
    values.push_back(pose.accuracy_m);
    fewest = std::min(fewest, pose.rows.size());
    most = std::max(most, pose.rows.size());
  }
  one.value_mm = millimetres(std::ranges::max(values));
  const std::string repeats =
      fewest == most ? counted(most, "measurement") : fmt::format("{} to {} measurements", fewest, most);
  one.basis =
      fmt::format("{}, {} each; mean {:.3f} mm", counted(poses.size(), "pose"), repeats, millimetres(mean(values)));
  return one;
}

Characteristic pose_repeatability(const AttainedPoses& poses) {
  Characteristic one{"RP", "Pose repeatability (position), largest", "7.2.2", {}, "no pose was measured repeatedly"};
  std::vector<double> values;
  std::size_t fewest = SIZE_MAX;
  for (const AttainedPose& pose : poses) {
    if (!pose.repeatability_m) continue;
    values.push_back(*pose.repeatability_m);
    fewest = std::min(fewest, pose.fewest_repeats);
  }
  if (values.empty()) return one;
  one.value_mm = millimetres(std::ranges::max(values));
  one.basis = fmt::format("{}, at least {} each; mean {:.3f} mm", counted(values.size(), "pose"),
                          counted(fewest, "measurement"), millimetres(mean(values)));
  if (fewest < kCyclesThatTell)
    one.basis += fmt::format("; so few tell less than the whole: the standard has {} cycles", kCyclesOfStandard);
  return one;
}

/// The poses under the same conditions, each with its attained poses of all approaches.
using PoseAndConditions = std::tuple<std::size_t, std::string, std::size_t, std::size_t>;
std::map<PoseAndConditions, std::vector<const AttainedPose*>> by_pose(const AttainedPoses& poses) {
  std::map<PoseAndConditions, std::vector<const AttainedPose*>> all;
  for (const AttainedPose& pose : poses) {
    if (pose.has_position) all[{pose.place, pose.target, pose.payload, pose.temperature}].push_back(&pose);
  }
  return all;
}

Characteristic direction_variation(const AttainedPoses& poses) {
  Characteristic one{"vAP",
                     "Multi-directional pose accuracy variation, largest",
                     "7.2.3",
                     {},
                     "no pose was approached from several sides"};
  double largest_m = 0.0;
  std::size_t count = 0, fewest = SIZE_MAX;
  for (const auto& [pose, sides] : by_pose(poses)) {
    if (sides.size() < 2) continue;
    ++count;
    for (const AttainedPose* side : sides) fewest = std::min(fewest, side->rows.size());
    for (const AttainedPose* a : sides) {
      for (const AttainedPose* b : sides) largest_m = std::max(largest_m, (a->attained_m - b->attained_m).norm());
    }
  }
  if (count == 0) return one;
  one.value_mm = millimetres(largest_m);
  one.basis = fmt::format("{} approached from two sides or more, at least {} from each", counted(count, "pose"),
                          counted(fewest, "measurement"));
  if (fewest < kCyclesThatTell) one.basis += "; the noise of so few is in it";
  return one;
}

Characteristic distance_accuracy(const AttainedPoses& poses) {
  constexpr std::size_t kMostPoses = 500;
  Characteristic one{"AD", "Distance accuracy, largest", "7.3.2", {}, "fewer than two positions were measured"};
  std::vector<const AttainedPose*> taken;
  const std::size_t step = (poses.size() + kMostPoses - 1) / kMostPoses;
  for (std::size_t i = 0; i < poses.size(); i += std::max<std::size_t>(step, 1)) {
    if (poses[i].has_position) taken.push_back(&poses[i]);
  }
  double largest_m = 0.0, squares_m2 = 0.0, longest_m = 0.0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (taken[i]->place == taken[k]->place) continue;
      const double commanded_m = (taken[i]->commanded_m - taken[k]->commanded_m).norm();
      const double error_m = std::abs((taken[i]->attained_m - taken[k]->attained_m).norm() - commanded_m);
      largest_m = std::max(largest_m, error_m);
      longest_m = std::max(longest_m, commanded_m);
      squares_m2 += error_m * error_m;
      ++pairs;
    }
  }
  if (pairs == 0) return one;
  one.value_mm = millimetres(largest_m);
  one.basis =
      fmt::format("{} up to {:.0f} mm between {}; rms {:.3f} mm", counted(pairs, "distance"), millimetres(longest_m),
                  counted(taken.size(), "pose"), millimetres(std::sqrt(squares_m2 / static_cast<double>(pairs))));
  return one;
}

/// Series of the repeats of one pose, at whatever temperature, that are long enough to be compared.
std::vector<AttainedPose> series_of(const DataSet& data, const AttainedPose& pose, const CorrectedRobot& robot) {
  std::vector<AttainedPose> series;
  for (std::vector<std::size_t>& rows : in_series(data, pose.rows))
    if (rows.size() >= kCyclesThatTell) series.push_back(with_rows(data, robot, pose, std::move(rows)));
  return series;
}

/// The poses with the repeats of all temperatures: an arm that warms up is what drift is about.
AttainedPoses at_all_temperatures(const AttainedPoses& poses) {
  AttainedPoses all;
  std::map<std::tuple<std::size_t, std::string, std::string, std::size_t>, std::size_t> known;
  for (const AttainedPose& pose : poses) {
    if (!pose.has_position) continue;
    const auto [entry, is_new] = known.try_emplace({pose.place, pose.target, pose.approach, pose.payload}, all.size());
    if (is_new) {
      all.push_back(pose);
    } else {
      std::vector<std::size_t>& rows = all[entry->second].rows;
      rows.insert(rows.end(), pose.rows.begin(), pose.rows.end());
    }
  }
  return all;
}

std::string no_series() {
  return fmt::format("no pose was measured in two series of {} repeats or more, ten minutes or more apart",
                     kCyclesThatTell);
}

struct SeriesDrift {
  double accuracy_m = 0.0, repeatability_m = 0.0, longest_s = 0.0;
  std::size_t poses = 0;
};

SeriesDrift drift_of(const DataSet& data, const AttainedPoses& poses, const CorrectedRobot& robot) {
  SeriesDrift drift;
  for (const AttainedPose& pose : at_all_temperatures(poses)) {
    const AttainedPoses series = series_of(data, pose, robot);
    if (series.size() < 2) continue;
    ++drift.poses;
    const double begin_s = *data.poses[series.front().rows.front()].time_s;
    for (const AttainedPose& later : series) {
      drift.accuracy_m = std::max(drift.accuracy_m, std::abs(later.accuracy_m - series.front().accuracy_m));
      drift.repeatability_m =
          std::max(drift.repeatability_m, std::abs(*later.repeatability_m - *series.front().repeatability_m));
      drift.longest_s = std::max(drift.longest_s, *data.poses[later.rows.back()].time_s - begin_s);
    }
  }
  return drift;
}

}  // namespace

std::vector<Characteristic> characteristics(const DataSet& data, const std::vector<AttainedPose>& poses,
                                            const CorrectedRobot& robot) {
  const SeriesDrift drift = drift_of(data, poses, robot);
  const auto drifted = [&drift](const char* symbol, const char* title, double value_m) {
    Characteristic one{symbol, title, "7.6", {}, no_series()};
    if (drift.poses == 0) return one;
    one.value_mm = millimetres(value_m);
    one.basis = fmt::format("{}, over {:.1f} h", counted(drift.poses, "pose"), drift.longest_s / 3600.0);
    return one;
  };
  return {pose_accuracy(poses),
          pose_repeatability(poses),
          direction_variation(poses),
          distance_accuracy(poses),
          drifted("dAP", "Drift of pose accuracy, largest", drift.accuracy_m),
          drifted("dRP", "Drift of pose repeatability, largest", drift.repeatability_m)};
}

std::string not_implemented() {
  return "Of ISO 9283:1998, the criteria of position in 7.2.1 (AP), 7.2.2 (RP), 7.2.3 (vAP), 7.3.2 (AD) and 7.6 (dAP, "
         "dRP) are computed by the definitions of these clauses, at the poses that were measured: the standard's own "
         "five poses of a cube with 30 cycles each are used only where they were measured. Criteria of orientation, "
         "distance repeatability (7.3.3), time, overshoot, exchangeability and paths (7.4, 7.5, 7.7, 8) are not.";
}

}  // namespace demecal::inline acceptance

#include "acceptance/iso9283.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "data/text.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline acceptance {
namespace {

using AttainedPoses = std::vector<AttainedPose>;

constexpr std::size_t kCyclesOfStandard = 30;
constexpr std::size_t kCyclesThatTell = 10;  ///< of fewer, mean and deviation come out too small: of two by two thirds

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

/// Fills what follows from the rows of the pose.
void evaluate(const DataSet& data, const CorrectedRobot& robot, AttainedPose& pose) {
  std::vector<Eigen::Vector3d> attained_m;
  double squares = 0.0;
  for (const std::size_t row : pose.rows) {
    const MeasuredPose& measured = data.poses[row];
    squares += std::pow(tool_error_m(robot, data, measured), 2);
    if (!measured.position_m) continue;
    attained_m.push_back(*measured.position_m);
    pose.attained_m += *measured.position_m;
    pose.commanded_m += robot.predict(Stop(measured), measured.target).translation();
  }
  pose.has_position = attained_m.size() == pose.rows.size();
  if (!pose.has_position) {
    pose.accuracy_m = std::sqrt(squares / static_cast<double>(pose.rows.size()));
    return;
  }
  pose.attained_m /= static_cast<double>(attained_m.size());
  pose.commanded_m /= static_cast<double>(attained_m.size());
  pose.accuracy_m = (pose.attained_m - pose.commanded_m).norm();
  if (attained_m.size() > 1) pose.repeatability_m = repeatability_m(attained_m);
}

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
    fewest = std::min(fewest, pose.rows.size());
  }
  if (values.empty()) return one;
  one.value_mm = millimetres(std::ranges::max(values));
  one.basis = fmt::format("{}, at least {} each; mean {:.3f} mm", counted(values.size(), "pose"),
                          counted(fewest, "measurement"), millimetres(mean(values)));
  if (fewest < kCyclesThatTell)
    one.basis += fmt::format("; so few tell less than the whole: the standard has {} cycles", kCyclesOfStandard);
  return one;
}

/// The poses by id and target, each with its attained poses of all approaches.
std::map<std::pair<std::string, std::string>, std::vector<const AttainedPose*>> by_pose(const AttainedPoses& poses) {
  std::map<std::pair<std::string, std::string>, std::vector<const AttainedPose*>> all;
  for (const AttainedPose& pose : poses) {
    if (pose.has_position) all[{pose.id, pose.target}].push_back(&pose);
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
      if (taken[i]->id == taken[k]->id) continue;
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

/// Series of the repeats of one pose, apart in time: a gap longer than a fifth of the whole time parts them.
std::vector<AttainedPose> series_of(const DataSet& data, const AttainedPose& pose, const CorrectedRobot& robot) {
  constexpr double kGap = 0.2;
  std::vector<std::size_t> rows = pose.rows;
  if (rows.size() < 4 ||
      !std::ranges::all_of(rows, [&](std::size_t row) { return data.poses[row].time_s.has_value(); }))
    return {};
  const auto time_s = [&data](std::size_t row) { return *data.poses[row].time_s; };
  std::ranges::stable_sort(rows, {}, time_s);
  const double span_s = time_s(rows.back()) - time_s(rows.front());
  std::vector<AttainedPose> series(1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && time_s(rows[i]) - time_s(rows[i - 1]) > kGap * span_s) series.emplace_back();
    series.back().rows.push_back(rows[i]);
  }
  std::erase_if(series, [](const AttainedPose& one) { return one.rows.size() < 2; });
  for (AttainedPose& one : series) evaluate(data, robot, one);
  return series;
}

struct SeriesDrift {
  double accuracy_m = 0.0, repeatability_m = 0.0, longest_s = 0.0;
  std::size_t poses = 0;
};

SeriesDrift drift_of(const DataSet& data, const AttainedPoses& poses, const CorrectedRobot& robot) {
  SeriesDrift drift;
  for (const AttainedPose& pose : poses) {
    const std::vector<AttainedPose> series = pose.has_position ? series_of(data, pose, robot) : AttainedPoses{};
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

std::vector<AttainedPose> attained_poses(const DataSet& data, std::span<const std::size_t> rows,
                                         const CorrectedRobot& robot) {
  std::vector<AttainedPose> poses;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> places;
  for (const std::size_t row : rows) {
    const MeasuredPose& measured = data.poses[row];
    if (!std::isfinite(tool_error_m(robot, data, measured))) continue;
    const std::string approach = approach_text(measured);
    const auto [place, is_new] = places.try_emplace({measured.pose_id, measured.target, approach}, poses.size());
    if (is_new) poses.push_back({.id = measured.pose_id, .target = measured.target, .approach = approach, .rows = {}});
    poses[place->second].rows.push_back(row);
  }
  for (AttainedPose& pose : poses) evaluate(data, robot, pose);
  return poses;
}

std::vector<double> largest_by_pose(const DataSet& data, const std::vector<AttainedPose>& poses) {
  std::map<std::string, std::size_t> by_id;
  std::map<std::vector<double>, std::size_t> by_joints;
  std::vector<double> largest_m;
  for (const AttainedPose& pose : poses) {
    const JointVector& joints = data.poses[pose.rows.front()].joints;
    const auto [same_joints, fresh_joints] = by_joints.try_emplace({joints.begin(), joints.end()}, largest_m.size());
    const auto [same_id, fresh_id] = by_id.try_emplace(pose.id, same_joints->second);
    const std::size_t place = fresh_joints ? same_id->second : same_joints->second;
    same_joints->second = place;
    if (place == largest_m.size()) largest_m.push_back(0.0);
    largest_m[place] = std::max(largest_m[place], pose.accuracy_m);
  }
  return largest_m;
}

std::vector<Characteristic> characteristics(const DataSet& data, const std::vector<AttainedPose>& poses,
                                            const CorrectedRobot& robot) {
  const SeriesDrift drift = drift_of(data, poses, robot);
  const auto drifted = [&drift](const char* symbol, const char* title, double value_m) {
    Characteristic one{symbol, title, "7.6", {}, "no pose was measured repeatedly in series apart in time"};
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

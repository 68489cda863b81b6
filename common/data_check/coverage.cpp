#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/same_places.hpp"
#include "data/text.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kHardlyMoving_rad = radians(2.0), kHardlyMoving_m = 5e-3;
constexpr double kFlat = 0.005;      ///< ratio of a cloud's extents that makes it a plane: an arm's errors over 0.3 m
constexpr double kThin = 0.05;       ///< ratio of both to the third that makes it a line
constexpr int kFineDecimals_mm = 3;  ///< digits behind the point, mm, that repeats with noise do not share
constexpr std::size_t kFewestPoses = 4;  ///< below which nothing is said of spread

Finding constant_joint(const DataSet& data, int joint, double range) {
  const bool revolute = is_revolute(data.robot.chain, joint);
  const std::string moves =
      revolute ? fmt::format("{:.2g} deg", degrees(range)) : fmt::format("{:.2g} mm", millimetres(range));
  const std::string lead = range == 0.0
                               ? fmt::format("Joint {} stands still in all calibration poses", joint + 1)
                               : fmt::format("Joint {} moves by {} only over the calibration poses", joint + 1, moves);
  return {.kind = FindingKind::constant_joint,
          .joint = joint,
          .sentence = lead +
                      ": nothing can be known of its error; the model holds only where it stands like that. "
                      "Measure poses that move it."};
}

/// Joints beyond which nothing moves: extents of the points along the cloud's own axes, ascending.
Eigen::Vector3d extents(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) spread += (point - mean) * (point - mean).transpose();
  return eigen_system_of_three(spread).values.cwiseMax(0.0).cwiseSqrt();
}

std::vector<Finding> degenerate_points(const DataSet& data, const std::vector<std::size_t>& poses) {
  std::vector<Eigen::Vector3d> points;
  for (const std::size_t pose : poses)
    if (data.poses[pose].position_m) points.push_back(*data.poses[pose].position_m);
  if (points.size() < kFewestPoses) return {};
  const Eigen::Vector3d along = extents(points);
  const bool is_line = along[1] <= kThin * along[2];
  if (!is_line && along[0] > kFlat * along[2]) return {};
  const char* what = along[2] == 0.0 ? "in one place" : is_line ? "on a line" : "on a plane";
  return {{.kind = FindingKind::degenerate_points,
           .sentence = fmt::format("The measured points of the calibration poses lie {}: what moves the tool across it "
                                   "is seen badly or not at all. Measure poses that fill the workspace.",
                                   what)}};
}

int decimals_of_mm(double metres_value) {
  const std::string text = number_text(metres_value, millimetres, metres);
  const std::size_t point = text.find('.');
  return text.find('e') != std::string::npos ? 15
         : point == std::string::npos        ? 0
                                             : static_cast<int>(text.size() - point - 1);
}

/// The digits behind the point that the positions are given with, in mm.
int position_decimals(const DataSet& data) {
  int most = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(data.poses.size(), 50); ++i)
    if (data.poses[i].position_m)
      for (const double value : *data.poses[i].position_m) most = std::max(most, decimals_of_mm(value));
  return most;
}

bool same_measurement(const MeasuredPose& one, const MeasuredPose& other) {
  const auto same_turn = [](const auto& a, const auto& b) {
    return a.has_value() == b.has_value() && (!a || a->coeffs() == b->coeffs());
  };
  return one.position_m == other.position_m && same_turn(one.orientation, other.orientation) &&
         one.distances_m == other.distances_m && one.target == other.target;
}

}  // namespace

std::vector<Finding> find_lacking_spread(const DataSet& data) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  if (poses.size() < kFewestPoses) return {};
  std::vector<Finding> found;
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    double lower = data.poses[poses.front()].joints[joint], upper = lower;
    for (const std::size_t pose : poses) {
      lower = std::min(lower, data.poses[pose].joints[joint]);
      upper = std::max(upper, data.poses[pose].joints[joint]);
    }
    const bool revolute = is_revolute(data.robot.chain, joint);
    if (upper - lower < (revolute ? kHardlyMoving_rad : kHardlyMoving_m))
      found.push_back(constant_joint(data, joint, upper - lower));
  }
  for (Finding& one : degenerate_points(data, poses)) found.push_back(std::move(one));
  return found;
}

std::vector<Finding> find_small_angles(const DataSet& data) {
  double largest = 0.0, widest = 0.0;
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    if (!is_revolute(data.robot.chain, joint)) continue;
    double lower = 0.0, upper = 0.0;
    for (const MeasuredPose& pose : data.poses) {
      lower = std::min(lower, pose.joints[joint]);
      upper = std::max(upper, pose.joints[joint]);
    }
    largest = std::max({largest, -lower, upper});
    widest = std::max(widest, upper - lower);
  }
  const bool as_radians = degrees(largest) < 2.0 * std::numbers::pi + 0.02 && degrees(widest) > 1.0;
  if (!as_radians) return {};
  return {{.kind = FindingKind::unit,
           .sentence = fmt::format("Joint angles look like radians where degrees are stated: none is beyond {:.2f}. "
                                   "Name the columns with _rad.",
                                   degrees(largest))}};
}

std::optional<Finding> find_shared_poses(const DataSet& data, PoseSet set) {
  std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  const auto first_joint = [&](std::size_t pose) { return data.poses[pose].joints[0]; };
  std::ranges::sort(fitted, {}, first_joint);
  const auto twin_of = [&](const MeasuredPose& pose) -> const MeasuredPose* {
    auto at = std::ranges::lower_bound(fitted, pose.joints[0] - kSameReading, {}, first_joint);
    for (; at != fitted.end() && first_joint(*at) <= pose.joints[0] + kSameReading; ++at)
      if (same_reading(data.poses[*at].joints, pose.joints)) return &data.poses[*at];
    return nullptr;
  };
  const std::vector<std::size_t> judging = poses_of(data, set);
  std::vector<std::pair<const MeasuredPose*, const MeasuredPose*>> shared;
  for (const std::size_t pose : judging)
    if (const MeasuredPose* twin = twin_of(data.poses[pose])) shared.emplace_back(&data.poses[pose], twin);
  if (shared.size() < 2 || 20 * shared.size() < judging.size()) return std::nullopt;
  Finding finding{.kind = FindingKind::shared_poses};
  for (const auto& [pose, twin] : shared) finding.poses.push_back(pose->pose_id);
  const auto& [pose, twin] = shared.front();
  finding.sentence = fmt::format(
      "{} of the {} {} poses stand at the joints of calibration poses (line {}{} at those of line {}{}): their "
      "errors say nothing of other places. Give repeats of a pose one name and one set, or measure {} poses of their "
      "own.",
      shared.size(), judging.size(), to_string(set), pose->line, name_beside_line(*pose), twin->line,
      name_beside_line(*twin), to_string(set));
  return finding;
}

std::vector<Finding> find_shared_poses(const DataSet& data) {
  std::vector<Finding> found;
  for (const PoseSet set : {PoseSet::validation, PoseSet::accept})
    if (std::optional<Finding> finding = find_shared_poses(data, set)) found.push_back(std::move(*finding));
  return found;
}

std::vector<Finding> take_out_copies(DataSet& data) {
  if (position_decimals(data) < kFineDecimals_mm) return {};
  std::vector<Finding> found;
  std::vector<MeasuredPose> kept;
  std::map<std::vector<double>, std::size_t> first;
  for (MeasuredPose& pose : data.poses) {
    std::vector<double> key(pose.joints.begin(), pose.joints.end());
    if (pose.position_m) key.insert(key.end(), pose.position_m->begin(), pose.position_m->end());
    const auto [entry, is_first] = first.try_emplace(key, kept.size());
    if (!pose.position_m || is_first || !same_measurement(pose, kept[entry->second])) {
      kept.push_back(std::move(pose));
      continue;
    }
    const MeasuredPose& other = kept[entry->second];
    // Rows of another file may have been joined to one line.
    const std::string rows =
        pose.line == other.line
            ? fmt::format("Two rows that belong to line {}{} are alike", pose.line, name_beside_line(pose))
            : fmt::format("Line {}{} repeats line {}{}", pose.line, name_beside_line(pose), other.line,
                          name_beside_line(other));
    found.push_back(
        {.kind = FindingKind::copied_rows,
         .poses = {other.pose_id, pose.pose_id},
         .sentence = rows + fmt::format(" to the last digit: a copy, not a second measurement; {} is left out.",
                                        pose.line == other.line ? "one" : "it")});
  }
  data.poses = std::move(kept);
  return found;
}

}  // namespace demecal::inline data_check

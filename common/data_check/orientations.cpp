#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/spread_poses.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

/// How joints and orientations might be meant, and what to do if they are.
struct OrientationReading {
  FindingKind kind = FindingKind::convention;
  int joint = -1;
  std::string remedy;
  std::function<JointVector(JointVector)> joints;
  std::function<Eigen::Quaterniond(const Eigen::Quaterniond&)> orientation;
};

JointVector as_given(JointVector joints) {
  return joints;
}

std::vector<OrientationReading> other_readings(const Chain& chain) {
  const auto inverse = [](const Eigen::Quaterniond& q) { return q.conjugate(); };
  // What was read as w, x, y, z.
  const auto scalar_last = [](const Eigen::Quaterniond& q) { return Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()); };
  std::vector<OrientationReading> readings{
      {FindingKind::convention, -1, "read the columns of orientation as x, y, z, w", as_given, scalar_last},
      {FindingKind::convention, -1, "take the measured orientations the other way round (the base seen from the tool)",
       as_given, inverse},
      {FindingKind::convention, -1,
       "read the columns of orientation as x, y, z, w, and take them the other way round (the base seen from the tool)",
       as_given, [=](const Eigen::Quaterniond& q) { return scalar_last(q).conjugate(); }}};
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (!is_revolute(chain, joint)) continue;
    readings.push_back({FindingKind::joint_sign, joint, fmt::format("turn the sign of joint {}", joint + 1),
                        [joint](JointVector joints) {
                          joints[joint] = -joints[joint];
                          return joints;
                        },
                        [](const Eigen::Quaterniond& q) { return q; }});
  }
  return readings;
}

struct TurnedPose {
  std::size_t pose;
  double angle_rad;
};

/// The angles by which orientations differ from one turn of each tool on its flange, that of the row that most agree
/// with.
std::vector<TurnedPose> turned_poses(const DataSet& data, const Trial& trial, const TrialFit& fit,
                                     const OrientationReading& reading) {
  constexpr std::size_t kMostTried = 30;
  std::map<int, std::vector<Eigen::Quaterniond>> turns;
  std::map<int, std::vector<std::size_t>> poses;
  for (const TrialRow& row : trial.rows) {
    const MeasuredPose& pose = data.poses[row.pose];
    if (!pose.orientation) continue;
    const Eigen::Isometry3d flange =
        fit.sensor_from_base[static_cast<std::size_t>(row.station)] * forward(fit.chain, reading.joints(row.joints));
    turns[row.target].push_back(Eigen::Quaterniond(flange.linear()).conjugate() *
                                reading.orientation(*pose.orientation));
    poses[row.target].push_back(row.pose);
  }
  std::vector<TurnedPose> angles;
  for (const auto& [target, all] : turns) {
    std::vector<double> least;
    double least_median = 0.0;
    for (const std::size_t centre : spread_indices(all.size(), kMostTried)) {
      std::vector<double> about;
      for (const Eigen::Quaterniond& turn : all) about.push_back(all[centre].angularDistance(turn));
      const double middle = median(about);
      if (!least.empty() && middle >= least_median) continue;
      least_median = middle;
      least = std::move(about);
    }
    for (std::size_t i = 0; i < least.size(); ++i) angles.push_back({poses.at(target)[i], least[i]});
  }
  std::ranges::sort(angles, {}, &TurnedPose::pose);
  return angles;
}

double median_angle(const std::vector<TurnedPose>& angles) {
  std::vector<double> values;
  for (const TurnedPose& one : angles) values.push_back(one.angle_rad);
  return values.empty() ? 0.0 : median(std::move(values));
}

/// The median over the rows, rad.
double scatter_rad(const DataSet& data, const Trial& trial, const TrialFit& fit, const OrientationReading& reading) {
  return median_angle(turned_poses(data, trial, fit, reading));
}

/// Rows of which the orientation is off while those of the most agree.
std::vector<Finding> find_single_orientations(const DataSet& data, const std::vector<TurnedPose>& angles) {
  constexpr double kFarOverMedian = 8.0;
  constexpr std::size_t kMostLines = 8;
  const double middle_rad = median_angle(angles), far_rad = std::max(kFarOverMedian * middle_rad, radians(1.0));
  Finding finding{.kind = FindingKind::wrong_orientation};
  double least_rad = 0.0, most_rad = 0.0;
  std::string lines;
  for (const auto& [pose, angle_rad] : angles) {
    if (angle_rad <= far_rad) continue;
    least_rad = finding.poses.empty() ? angle_rad : std::min(least_rad, angle_rad);
    most_rad = std::max(most_rad, angle_rad);
    if (finding.poses.size() < kMostLines)
      lines += fmt::format("{}{}", lines.empty() ? "" : ", ", data.poses[pose].line);
    finding.poses.push_back(data.poses[pose].pose_id);
  }
  if (finding.poses.empty()) return {};
  if (finding.poses.size() > kMostLines) lines += " and more";
  finding.sentence = fmt::format(
      "The measured orientations of {} of {} rows (lines {}) are {:.3g} to {:.3g} deg from where the arm turns the "
      "tool, "
      "the others {:.2g} deg (median). Correct their orientations, or leave these rows out.",
      finding.poses.size(), angles.size(), lines, degrees(least_rad), degrees(most_rad), degrees(middle_rad));
  return {finding};
}

}  // namespace

std::vector<Finding> find_wrong_orientations(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  constexpr std::size_t kFewest = 8;
  const double implausible = radians(5.0), explained = radians(2.0);
  const auto with = std::ranges::count_if(
      trial.rows, [&](const TrialRow& row) { return data.poses[row.pose].orientation.has_value(); });
  if (static_cast<std::size_t>(with) < kFewest) return {};
  const OrientationReading given{FindingKind::other_robot, -1, "", as_given,
                                 [](const Eigen::Quaterniond& q) { return q; }};
  const std::vector<TurnedPose> angles = turned_poses(data, trial, fit, given);
  const double given_rad = median_angle(angles);
  if (given_rad < implausible) return find_single_orientations(data, angles);
  const std::string observed = fmt::format(
      "The measured orientations contradict the joints, though the positions fit: they are {:.0f} deg "
      "(median) from where the arm turns the tool.",
      degrees(given_rad));
  for (const OrientationReading& reading : other_readings(fit.chain)) {
    const double changed_rad = scatter_rad(data, trial, fit, reading);
    if (changed_rad > explained) continue;
    Finding finding{.kind = reading.kind, .joint = reading.joint};
    finding.sentence = fmt::format("{} To agree to {:.2g} deg, {}.", observed, degrees(changed_rad), reading.remedy);
    return {finding};
  }
  Finding finding{.kind = FindingKind::other_robot};
  finding.sentence = observed +
                     " No sign of a joint and no order or direction of the quaternions explains it: check the columns "
                     "of orientation and that of the last joint, or leave `orientation` out.";
  return {finding};
}

}  // namespace demecal::inline data_check

#include "prediction/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "effects/arm_state.hpp"
#include "errors/check.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/units.hpp"
#include "pieces/pieces.hpp"
#include "prediction/only_places.hpp"

namespace demecal::inline prediction {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

const Eigen::Vector3d& anchor(const DataSet& data, std::size_t distance) {
  DEMECAL_CHECK(distance < data.anchors_m.size(),
                "distance " << distance << " of " << data.anchors_m.size() << " anchors");
  return data.anchors_m[distance];
}

/// Measured minus predicted lengths, m.
Eigen::VectorXd distance_errors(const Eigen::Vector3d& predicted, const DataSet& data, const MeasuredPose& pose) {
  Eigen::VectorXd errors(static_cast<Eigen::Index>(pose.distances_m.size()));
  for (std::size_t i = 0; i < pose.distances_m.size(); ++i) {
    errors[static_cast<Eigen::Index>(i)] = pose.distances_m[i] - (predicted - anchor(data, i)).norm();
  }
  return errors;
}

/// Of ascending values: the one of rank 1 + 0.95 (n - 1), between neighbours in proportion.
double percentile_95(const std::vector<double>& ascending) {
  const double rank = 0.95 * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return std::lerp(ascending[below], ascending[above], rank - static_cast<double>(below));
}

/// Where the robot has the contact that a pose touches; null: nowhere.
const ContactPlace* touched_place(const CorrectedRobot& robot, const MeasuredPose& pose) {
  const auto found = robot.contacts.find(group_of(pose));
  return found == robot.contacts.end() ? nullptr : &found->second;
}

/// Null: the first station, or one that the robot has no place for.
const Eigen::Isometry3d* station_of(const CorrectedRobot& robot, const MeasuredPose& pose) {
  if (pose.station.empty()) return nullptr;
  const auto found = robot.stations.find(pose.station);
  return found == robot.stations.end() ? nullptr : &found->second;
}

/// How the pose touches its contact, its tool where it is predicted.
Touch touch_of(const MeasuredPose& pose, const Eigen::Isometry3d& predicted) {
  return {predicted.translation(), pose.contact_length_m};
}

std::vector<std::size_t> all_poses(const DataSet& data) {
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

MeasurementRows rows_of(const MeasuredPose& pose) {
  return {pose.position_m ? 3 : 0, pose.contact.empty() ? 0 : rows_of(pose.contact_kind), pose.orientation ? 3 : 0,
          static_cast<int>(pose.distances_m.size())};
}

Eigen::Vector3d measured_point(const CorrectedRobot& robot, const MeasuredPose& pose) {
  const Eigen::Isometry3d* const station = station_of(robot, pose);
  return station == nullptr ? *pose.position_m : Eigen::Vector3d(*station * *pose.position_m);
}

Eigen::Matrix3d measured_orientation(const CorrectedRobot& robot, const MeasuredPose& pose) {
  const Eigen::Matrix3d own = pose.orientation->toRotationMatrix();
  const Eigen::Isometry3d* const station = station_of(robot, pose);
  return station == nullptr ? own : Eigen::Matrix3d(station->linear() * own);
}

Touch touch_of(const CorrectedRobot& robot, const MeasuredPose& pose) {
  return touch_of(pose, robot.predict(Stop(pose), pose.target));
}

Eigen::VectorXd residual(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  return residual(robot, robot.predict(Stop(pose), pose.target), data, pose);
}

Eigen::VectorXd residual(const CorrectedRobot& robot, const Eigen::Isometry3d& predicted, const DataSet& data,
                         const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  Eigen::VectorXd result(rows.total());
  if (pose.position_m) {
    result.head<3>() = measured_point(robot, pose) - predicted.translation();
    if (pose.position_whitening) result.head<3>() = (*pose.position_whitening * result.head<3>()).eval();
  }
  if (rows.contact > 0) {
    const ContactPlace* const place = touched_place(robot, pose);
    auto own = result.segment(rows.position, rows.contact);
    own.setZero();
    if (place != nullptr) own = pose.contact_weight * contact_residual(*place, touch_of(pose, predicted));
  }
  if (pose.orientation) {
    result.segment<3>(rows.points()) = rotation_between(predicted.linear(), measured_orientation(robot, pose));
  }
  result.tail(rows.distances) = distance_errors(predicted.translation(), data, pose);
  return result;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> measurement_jacobian(const CorrectedRobot& robot,
                                                              const Eigen::Isometry3d& predicted, const DataSet& data,
                                                              const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(rows.total(), 6);
  if (pose.position_m) jacobian.topLeftCorner<3, 3>() = pose.position_whitening.value_or(Eigen::Matrix3d::Identity());
  if (const ContactPlace* const place = rows.contact > 0 ? touched_place(robot, pose) : nullptr) {
    jacobian.block(rows.position, 0, rows.contact, 3) =
        pose.contact_weight * contact_jacobian(*place, predicted.translation());
  }
  if (pose.orientation) jacobian.block<3, 3>(rows.points(), 3).setIdentity();
  for (int i = 0; i < rows.distances; ++i) {
    const Eigen::Vector3d line = predicted.translation() - anchor(data, static_cast<std::size_t>(i));
    jacobian.block<1, 3>(rows.points() + rows.orientation + i, 0) = line.normalized().transpose();
  }
  return jacobian;
}

CorrectedRobot with_own_contacts(CorrectedRobot robot, const DataSet& data, std::span<const std::size_t> poses) {
  for (const auto& [group, members] : contact_groups(data, poses)) {
    std::vector<Touch> touches;
    for (const std::size_t pose : members) touches.push_back(touch_of(robot, data.poses[pose]));
    robot.contacts[group] = contact_place(data.contacts.form_of(group.contact), touches);
  }
  return robot;
}

CorrectedRobot with_own_contacts(CorrectedRobot robot, const DataSet& data) {
  return with_own_contacts(std::move(robot), data, all_poses(data));
}

std::vector<double> tool_errors_m(const CorrectedRobot& robot, const DataSet& data,
                                  std::span<const std::size_t> poses) {
  const auto errors_of = [&](const CorrectedRobot& placed) {
    std::vector<double> errors_m(poses.size());
    in_batches(poses.size(), [&](std::size_t i) { errors_m[i] = tool_error_m(placed, data, data.poses[poses[i]]); });
    return errors_m;
  };
  if (!has_contacts(data)) return errors_of(robot);
  std::set<ContactGroup> groups;
  for (const std::size_t pose : poses)
    if (!data.poses[pose].contact.empty()) groups.insert(group_of(data.poses[pose]));
  std::vector<std::size_t> members;
  for (const std::size_t pose : all_poses(data))
    if (groups.contains(group_of(data.poses[pose]))) members.push_back(pose);
  return errors_of(with_own_contacts(robot, data, members));
}

std::vector<double> tool_errors_m(const CorrectedRobot& robot, const std::vector<Eigen::Isometry3d>& predicted,
                                  const DataSet& data, std::span<const std::size_t> poses) {
  DEMECAL_CHECK(predicted.size() == poses.size(), predicted.size() << " predictions of " << poses.size() << " poses");
  std::map<ContactGroup, std::vector<Touch>> touches;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!data.poses[poses[i]].contact.empty())
      touches[group_of(data.poses[poses[i]])].push_back(touch_of(data.poses[poses[i]], predicted[i]));
  CorrectedRobot placed;
  placed.stations = robot.stations;
  if (touches.empty()) placed.contacts = robot.contacts;
  for (const auto& [group, touched] : touches)
    placed.contacts[group] = contact_place(data.contacts.form_of(group.contact), touched);
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < poses.size(); ++i)
    errors_m.push_back(tool_error_m(placed, predicted[i], data, data.poses[poses[i]]));
  return errors_m;
}

double tool_error_m(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  return tool_error_m(robot, robot.predict(Stop(pose), pose.target), data, pose);
}

double tool_error_m(const CorrectedRobot& robot, const Eigen::Isometry3d& predicted, const DataSet& data,
                    const MeasuredPose& pose) {
  const Eigen::Vector3d point = predicted.translation();
  if (!pose.contact.empty()) {
    const ContactPlace* const place = touched_place(robot, pose);
    return place == nullptr ? kNotMeasured : contact_residual(*place, touch_of(pose, predicted)).norm();
  }
  if (pose.position_m) return (measured_point(robot, pose) - point).norm();
  if (pose.distances_m.empty()) return kNotMeasured;
  return distance_errors(point, data, pose).norm() / std::sqrt(static_cast<double>(pose.distances_m.size()));
}

bool measures_point(const MeasuredPose& pose) {
  return pose.position_m.has_value() || !pose.contact.empty();
}

std::vector<LengthError> length_errors(const CorrectedRobot& robot, const DataSet& data) {
  const CorrectedRobot placed = with_own_contacts(robot, data);
  const std::set<ContactGroup> untold = only_placed(data);
  // One touch says where a point is; three turn a plane to wherever their noise has it.
  const auto is_placed = [&](const auto& found) {
    return found != placed.contacts.end() &&
           (found->second.kind == ContactKind::point || !untold.contains(found->first));
  };
  std::vector<LengthError> errors;
  for (const KnownDistance& known : data.contacts.distances) {
    for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept}) {
      const auto first = placed.contacts.find({known.first, set}), second = placed.contacts.find({known.second, set});
      if (!is_placed(first) || !is_placed(second)) continue;
      const auto [length_m, along] = place_distance(first->second, second->second);
      errors.push_back({&known, set, length_m - known.length_m, along});
    }
  }
  return errors;
}

ErrorFigures error_figures(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses) {
  const std::set<ContactGroup> untold = only_placed(data);
  std::vector<std::size_t> measured;
  for (const std::size_t i : poses) {
    const MeasuredPose& pose = data.poses[i];
    const bool tells = !pose.contact.empty() ? !untold.contains(group_of(pose)) : measures_point(pose);
    if (tells || (pose.contact.empty() && !pose.distances_m.empty())) measured.push_back(i);
  }
  std::vector<double> errors_mm;
  for (const double error_m : tool_errors_m(robot, data, measured)) {
    // A formula may predict no number at all; such a pose is infinitely far off, and can be sorted.
    errors_mm.push_back(std::isnan(error_m) ? std::numeric_limits<double>::infinity() : millimetres(error_m));
  }
  return error_figures(std::move(errors_mm));
}

ErrorFigures error_figures(std::vector<double> errors_mm) {
  if (errors_mm.empty()) return {kNotMeasured, kNotMeasured, kNotMeasured, kNotMeasured};
  std::sort(errors_mm.begin(), errors_mm.end());
  const auto count = static_cast<double>(errors_mm.size());
  const double sum = std::accumulate(errors_mm.begin(), errors_mm.end(), 0.0);
  const double squares = std::inner_product(errors_mm.begin(), errors_mm.end(), errors_mm.begin(), 0.0);
  return {sum / count, std::sqrt(squares / count), percentile_95(errors_mm), errors_mm.back()};
}

double gross_error_limit(std::vector<double> errors) {
  constexpr double kGrossError = 3.0;
  std::erase_if(errors, [](double error) { return std::isnan(error); });
  if (errors.empty()) return std::numeric_limits<double>::infinity();
  const auto ninth = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 9 / 10);
  std::ranges::nth_element(errors, ninth);
  return kGrossError * *ninth;
}

}  // namespace demecal::inline prediction

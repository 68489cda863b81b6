#include "prediction/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "effects/arm_state.hpp"
#include "errors/check.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline prediction {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

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

}  // namespace

MeasurementRows rows_of(const MeasuredPose& pose) {
  return {pose.position_m ? 3 : 0, pose.orientation ? 3 : 0, static_cast<int>(pose.distances_m.size())};
}

Eigen::VectorXd residual(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  return residual(robot.predict(Stop(pose), pose.target), data, pose);
}

Eigen::VectorXd residual(const Eigen::Isometry3d& predicted, const DataSet& data, const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  Eigen::VectorXd result(rows.total());
  if (pose.position_m) result.head<3>() = *pose.position_m - predicted.translation();
  if (pose.orientation) {
    result.segment<3>(rows.position) = rotation_between(predicted.linear(), pose.orientation->toRotationMatrix());
  }
  result.tail(rows.distances) = distance_errors(predicted.translation(), data, pose);
  return result;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> measurement_jacobian(const Eigen::Isometry3d& predicted, const DataSet& data,
                                                              const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(rows.total(), 6);
  if (pose.position_m) jacobian.topLeftCorner<3, 3>().setIdentity();
  if (pose.orientation) jacobian.block<3, 3>(rows.position, 3).setIdentity();
  for (int i = 0; i < rows.distances; ++i) {
    const Eigen::Vector3d line = predicted.translation() - anchor(data, static_cast<std::size_t>(i));
    jacobian.block<1, 3>(rows.position + rows.orientation + i, 0) = line.normalized().transpose();
  }
  return jacobian;
}

double tool_error_m(const CorrectedRobot& robot, const DataSet& data, const MeasuredPose& pose) {
  return tool_error_m(robot.predict(Stop(pose), pose.target), data, pose);
}

double tool_error_m(const Eigen::Isometry3d& predicted, const DataSet& data, const MeasuredPose& pose) {
  const Eigen::Vector3d point = predicted.translation();
  if (pose.position_m) return (*pose.position_m - point).norm();
  if (pose.distances_m.empty()) return kNone;
  return distance_errors(point, data, pose).norm() / std::sqrt(static_cast<double>(pose.distances_m.size()));
}

ErrorFigures error_figures(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses) {
  std::vector<double> errors_mm;
  for (const std::size_t i : poses) {
    const MeasuredPose& pose = data.poses[i];
    const MeasurementRows rows = rows_of(pose);
    if (rows.position + rows.distances == 0) continue;
    const double error_mm = millimetres(tool_error_m(robot, data, pose));
    // A formula may predict no number at all; such a pose is infinitely far off, and can be sorted.
    errors_mm.push_back(std::isnan(error_mm) ? std::numeric_limits<double>::infinity() : error_mm);
  }
  return error_figures(std::move(errors_mm));
}

ErrorFigures error_figures(std::vector<double> errors_mm) {
  if (errors_mm.empty()) return {kNone, kNone, kNone, kNone};
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

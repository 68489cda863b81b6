#include "trials/placed_rows.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline trials {

void PlacedRows::place(const Chain& chain, const std::vector<TrialRow>& rows) {
  const FixedTurns turns(chain);
  stops_.resize(rows.size());
  flanges_.clear();
  screws_.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const JointVector& joints = rows[i].joints;
    if (i == 0 || joints != rows[i - 1].joints) {
      if (links_) screws_.emplace_back(turns, joints);
      if (!links_) flanges_.push_back(forward(turns, joints));
    }
    stops_[i] = (links_ ? screws_.size() : flanges_.size()) - 1;
  }
}

Eigen::Vector3d PlacedRows::point(const TrialFit& fit, std::size_t row, const TrialRow& of) const {
  return fit.sensor_from_base[static_cast<std::size_t>(of.station)] *
         (flange(row) * fit.tools_m[static_cast<std::size_t>(of.target)]);
}

void PlacedRows::linearize(const TrialFit& fit, std::size_t row, const TrialRow& of, const ParameterPlaces& places,
                           LinearRow& linear) const {
  const Eigen::Isometry3d& base = fit.sensor_from_base[static_cast<std::size_t>(of.station)];
  const Eigen::Vector3d on_arm = flange(row) * fit.tools_m[static_cast<std::size_t>(of.target)];
  linear.error_m = of.point_m - base * on_arm;
  linear.jacobian.setZero(3, places.size());
  linear.jacobian.block<3, 3>(0, 6 * of.station).setIdentity();
  linear.jacobian.block<3, 3>(0, 6 * of.station + 3) = -cross_matrix(base.linear() * on_arm);
  linear.jacobian.block<3, 3>(0, places.tool(of.target)) = base.linear() * flange(row).linear();
  if (!places.links) return;
  const PointMotions motions = screws_[stops_[row]].motions(on_arm);
  linear.jacobian.rightCols(motions.cols()) = base.linear() * motions;
}

double Trial::reach_m() const {
  return PlacedRows(chain, rows, false).reach_m(*this);
}

double PlacedRows::reach_m(const Trial& trial) const {
  double reach_m = 0.1;
  for (std::size_t i = 0; i < trial.rows.size(); ++i)
    reach_m = std::max(reach_m, (flange(i) * trial.tools_m[static_cast<std::size_t>(trial.rows[i].target)]).norm());
  return reach_m;
}

double Trial::rows_per_pose() const {
  std::vector<const JointVector*> poses;
  for (const TrialRow& row : rows) poses.push_back(&row.joints);
  const auto before = [](const JointVector* one, const JointVector* other) {
    return std::lexicographical_compare(one->begin(), one->end(), other->begin(), other->end());
  };
  std::ranges::sort(poses, before);
  std::size_t different = poses.empty() ? 0 : 1;
  for (std::size_t i = 1; i < poses.size(); ++i) different += before(poses[i - 1], poses[i]) ? 1 : 0;
  return static_cast<double>(rows.size()) / static_cast<double>(std::max<std::size_t>(different, 1));
}

Eigen::Matrix3d TrialFit::prediction_covariance(const TrialRow& row) const {
  if (covariance.size() == 0) return Eigen::Matrix3d::Zero();
  const ParameterPlaces places{static_cast<int>(sensor_from_base.size()), static_cast<int>(tools_m.size()),
                               chain.size(), has_links()};
  LinearRow linear;
  PlacedRows(chain, {row}, places.links).linearize(*this, 0, row, places, linear);
  const Eigen::MatrixXd jacobian = linear.jacobian;
  return jacobian * covariance * jacobian.transpose();
}

double TrialFit::deviations_off(const TrialRow& row) const {
  const Eigen::Vector3d error = row.point_m - predicted_point(*this, row);
  const Eigen::Matrix3d expected = prediction_covariance(row) + deviation_m * deviation_m * Eigen::Matrix3d::Identity();
  return std::sqrt(std::max(0.0, error.dot(solve_pivoted(expected, error))));
}

Eigen::Matrix3d TrialFit::tool_covariance(int tool) const {
  return covariance.block<3, 3>(6 * std::ssize(sensor_from_base) + 3 * tool,
                                6 * std::ssize(sensor_from_base) + 3 * tool);
}

bool TrialFit::has_links() const {
  return covariance.rows() > 6 * std::ssize(sensor_from_base) + 3 * std::ssize(tools_m);
}

}  // namespace demecal::inline trials

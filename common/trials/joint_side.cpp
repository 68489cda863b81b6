#include "trials/joint_side.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline trials {

JointSide::JointSide(const Trial& trial, const TrialFit& fit, const Eigen::Vector3d& gravity)
    : fit_(fit), down_(gravity.norm() > 0.0 ? gravity.normalized() : Eigen::Vector3d::UnitZ()) {
  for (const TrialRow& row : trial.rows) {
    if (largest_.size() == 0) largest_ = Eigen::VectorXd::Constant(row.joints.size(), 1e-3);
    largest_ = largest_.cwiseMax(row.joints.cwiseAbs());
  }
  reach_m_ = trial.reach_m();
}

Eigen::MatrixXd JointSide::columns(const TrialRow& row) const {
  const int n = fit_.chain.size();
  const Eigen::Vector3d& tool = fit_.tools_m[static_cast<std::size_t>(row.target)];
  const DisplacedKinematics there = differential_kinematics(fit_.chain, row.joints, tool, PlaceMotions::Zero(6, n + 1));
  const Eigen::Vector3d point = there.kinematics.flange * tool;
  const Eigen::Vector3d wrist = there.places[static_cast<std::size_t>(std::max(0, n - 3))].translation();
  std::vector<Eigen::Vector3d> all;
  for (int joint = 0; joint < n; ++joint) {
    const Eigen::Isometry3d& place = there.places[static_cast<std::size_t>(joint)];
    const Eigen::Vector3d own = there.kinematics.joints.col(joint).head<3>();
    const double q = row.joints[joint];
    if (!is_revolute(fit_.chain, joint)) {
      all.push_back(own * (q / largest_[joint]));
      continue;
    }
    const Eigen::Vector3d moment = (point - place.translation()).cross(down_) / reach_m_,
                          inner = (wrist - place.translation()).cross(down_) / reach_m_;
    for (const double size : {q / largest_[joint], std::sin(q), std::cos(q), std::sin(2 * q), std::cos(2 * q),
                              moment.dot(place.linear().col(2)), inner.dot(place.linear().col(2))})
      all.push_back(own * size);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector3d tilted = Eigen::Vector3d(place.linear().col(axis)).cross(point - place.translation());
      for (const double size : {std::sin(q), std::cos(q), moment.dot(place.linear().col(axis))})
        all.push_back(tilted * size);
    }
  }
  Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = all[i];
  return fit_.sensor_from_base[static_cast<std::size_t>(row.station)].linear() * columns;
}

}  // namespace demecal::inline trials

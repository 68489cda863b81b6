#include "calibration/distal_index.hpp"

#include <cmath>
#include <limits>

#include "calibration/joint_summaries.hpp"
#include "effects/measurement.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

/// 0 where orientation has no part in the fit.
double mm_per_rad(const Fit& fit) {
  const double length_m = fit.sigma_position_m > 0.0 ? fit.sigma_position_m : fit.sigma_distance_m;
  if (!(fit.sigma_orientation_rad > 0.0)) return 0.0;
  return millimetres(length_m > 0.0 ? length_m / fit.sigma_orientation_rad : 1.0);
}

}  // namespace

DistalIndex::DistalIndex(const DataSet& data, std::span<const std::size_t> poses, const Fit& declared)
    : data_(data), poses_(poses.begin(), poses.end()), mm_per_rad_(mm_per_rad(declared)) {
  for (const std::size_t pose : poses_) {
    motions_.push_back(declared.robot.motions(Stop(data.poses[pose]), data.poses[pose].target));
  }
}

/// Rows of a pose in mm; those without a part in the index become 0.
Eigen::VectorXd DistalIndex::weigh(const MeasuredPose& pose, const Eigen::VectorXd& rows) const {
  const MeasurementRows kinds = rows_of(pose);
  Eigen::VectorXd weighed = rows;
  weighed.head(kinds.position) *= millimetres(1.0);
  weighed.segment(kinds.position, kinds.orientation) *= mm_per_rad_;
  const double share = kinds.position > 0 ? 0.0 : 1.0 / std::sqrt(static_cast<double>(std::max(kinds.distances, 1)));
  weighed.tail(kinds.distances) *= millimetres(share);
  return weighed;
}

Eigen::Isometry3d DistalIndex::predicted(const CorrectedRobot& robot, std::size_t i) const {
  const MeasuredPose& pose = data_.poses[poses_[i]];
  return robot.predict(robot.corrected_joints(pose.joints), motions_[i], pose.target);
}

double DistalIndex::operator()(const CorrectedRobot& robot) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const MeasuredPose& pose = data_.poses[poses_[i]];
    sum += weigh(pose, residual(predicted(robot, i), data_, pose)).squaredNorm();
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

std::vector<LinearisedPose> DistalIndex::linearised(const CorrectedRobot& robot) const {
  // At the corrected joints, and without the corrections: their slopes are no part of what a change of theirs does.
  const CorrectedRobot bare = without_corrections(robot);
  std::vector<LinearisedPose> poses;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const MeasuredPose& pose = data_.poses[poses_[i]];
    const JointVector corrected = robot.corrected_joints(pose.joints);
    const Eigen::Isometry3d there = predicted(robot, i);
    const auto motion = bare.predict_with_jacobian(Stop(pose).with_joints(corrected), pose.target).jacobian;
    const Eigen::MatrixXd slope = measurement_jacobian(there, data_, pose) * motion;
    LinearisedPose at{corrected - pose.joints, weigh(pose, residual(there, data_, pose)), slope};
    for (Eigen::Index joint = 0; joint < slope.cols(); ++joint) {
      at.slope_mm.col(joint) = weigh(pose, slope.col(joint));
    }
    poses.push_back(std::move(at));
  }
  return poses;
}

Eigen::VectorXd compensation_potentials(std::span<const LinearisedPose> poses) {
  if (poses.empty()) return {};
  Eigen::VectorXd potentials = Eigen::VectorXd::Zero(poses.front().slope_mm.cols());
  for (const LinearisedPose& pose : poses) potentials += (pose.slope_mm.transpose() * pose.left_mm).cwiseAbs();
  return potentials;
}

}  // namespace demecal

#include "distal/index.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/calibration.hpp"
#include "calibration/training.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline distal {
namespace {

/// 0 where orientation has no part in the fit.
double mm_per_rad(const Fit& fit) {
  const double length_m = fit.sigma_position_m > 0.0 ? fit.sigma_position_m : fit.sigma_distance_m;
  if (!(fit.sigma_orientation_rad > 0.0)) return 0.0;
  return millimetres(length_m > 0.0 ? length_m / fit.sigma_orientation_rad : 1.0);
}

constexpr double kHold = 1e-3, kFirmHold = 1e8;

/// Rows of all poses one after the other.
Eigen::VectorXd effect_mm(std::span<const LinearizedPose> poses, const CorrectionShape& shape) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const double slope : poses[i].jacobian_mm.col(static_cast<Eigen::Index>(shape.joint)))
      rows.push_back(slope * shape.value_rad[i]);
  }
  return Eigen::Map<Eigen::VectorXd>(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

Eigen::VectorXd all_residuals_mm(std::span<const LinearizedPose> poses) {
  std::vector<double> rows;
  for (const LinearizedPose& pose : poses) rows.insert(rows.end(), pose.residual_mm.begin(), pose.residual_mm.end());
  return Eigen::Map<Eigen::VectorXd>(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

Eigen::VectorXd ones(std::span<const std::size_t> chosen) {
  return Eigen::VectorXd::Ones(static_cast<Eigen::Index>(chosen.size()));
}

ChosenShapes chosen_shapes(const Eigen::VectorXd& factors, double index_mm2) {
  return {{factors.begin(), factors.end()}, index_mm2};
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
  weighed.head(kinds.points()) *= millimetres(1.0);
  weighed.segment(kinds.points(), kinds.orientation) *= mm_per_rad_;
  const double share = kinds.points() > 0 ? 0.0 : 1.0 / std::sqrt(static_cast<double>(std::max(kinds.distances, 1)));
  weighed.tail(kinds.distances) *= millimetres(share);
  return weighed;
}

Eigen::Isometry3d DistalIndex::predicted(const CorrectedRobot& robot, std::size_t i) const {
  const MeasuredPose& pose = data_.poses[poses_[i]];
  return robot.predict(robot.corrected_joints(pose.joints), motions_[i], pose.target);
}

double DistalIndex::operator()(const CorrectedRobot& robot) const {
  double sum = 0.0;
  const CorrectedRobot placed = with_own_contacts(robot, data_, poses_);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const MeasuredPose& pose = data_.poses[poses_[i]];
    sum += weigh(pose, residual(placed, predicted(robot, i), data_, pose)).squaredNorm();
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

std::vector<LinearizedPose> DistalIndex::linearized(const CorrectedRobot& robot) const {
  // At the corrected joints, and without the corrections: their slopes are no part of what a change of theirs does.
  const CorrectedRobot bare = without_corrections(robot), placed = with_own_contacts(robot, data_, poses_);
  std::vector<LinearizedPose> poses;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const MeasuredPose& pose = data_.poses[poses_[i]];
    const JointVector corrected = robot.corrected_joints(pose.joints);
    const Eigen::Isometry3d predicted_pose = predicted(robot, i);
    const Jacobian motion =
        by_drives(robot.chain, bare.predict_with_jacobian(Stop(pose).with_joints(corrected), pose.target).jacobian);
    const Eigen::MatrixXd slope = measurement_jacobian(placed, predicted_pose, data_, pose) * motion;
    LinearizedPose linearized_pose{driven_joints(robot.chain, corrected - pose.joints),
                                   weigh(pose, residual(placed, predicted_pose, data_, pose)), slope};
    for (Eigen::Index joint = 0; joint < slope.cols(); ++joint) {
      linearized_pose.jacobian_mm.col(joint) = weigh(pose, slope.col(joint));
    }
    poses.push_back(std::move(linearized_pose));
  }
  return poses;
}

Eigen::VectorXd compensation_potentials(std::span<const LinearizedPose> poses) {
  if (poses.empty()) return {};
  Eigen::VectorXd potentials = Eigen::VectorXd::Zero(poses.front().jacobian_mm.cols());
  for (const LinearizedPose& pose : poses) potentials += (pose.jacobian_mm.transpose() * pose.residual_mm).cwiseAbs();
  return potentials;
}

CorrectionShape present_shape(std::span<const LinearizedPose> poses, std::size_t joint) {
  CorrectionShape shape{joint, {}};
  for (const LinearizedPose& pose : poses) shape.value_rad.push_back(pose.correction[static_cast<Eigen::Index>(joint)]);
  return shape;
}

AmplitudeFit::AmplitudeFit(std::span<const LinearizedPose> poses, std::span<const std::size_t> joints,
                           std::span<const CorrectionShape> shapes) {
  Eigen::VectorXd wanted = all_residuals_mm(poses);
  for (const std::size_t joint : joints) wanted += effect_mm(poses, present_shape(poses, joint));
  Eigen::MatrixXd effects(wanted.size(), static_cast<Eigen::Index>(shapes.size()));
  for (std::size_t i = 0; i < shapes.size(); ++i)
    effects.col(static_cast<Eigen::Index>(i)) = effect_mm(poses, shapes[i]);
  products_ = effects.transpose() * effects;
  moments_ = effects.transpose() * wanted;
  bare_index_mm2_ = wanted.squaredNorm();
}

double AmplitudeFit::index_mm2(std::span<const std::size_t> chosen, const Eigen::VectorXd& factors) const {
  const auto of_chosen = products_(chosen, chosen);
  return bare_index_mm2_ + factors.dot(of_chosen * factors - 2.0 * moments_(chosen));
}

ChosenShapes AmplitudeFit::fitted(std::span<const std::size_t> chosen, std::span<const std::size_t> held) const {
  Eigen::MatrixXd products = products_(chosen, chosen);
  Eigen::VectorXd hold = kHold * products.diagonal();
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (std::ranges::count(held, chosen[i]) > 0) hold[static_cast<Eigen::Index>(i)] *= kFirmHold / kHold;
  products.diagonal() += hold;
  const Eigen::VectorXd factors = PivotedCholesky(products).solve(moments_(chosen) + hold);
  return chosen_shapes(factors, index_mm2(chosen, factors));
}

ChosenShapes AmplitudeFit::unscaled(std::span<const std::size_t> chosen) const {
  return chosen_shapes(ones(chosen), index_mm2(chosen, ones(chosen)));
}

}  // namespace demecal::inline distal

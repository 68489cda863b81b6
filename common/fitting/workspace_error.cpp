#include "fitting/workspace_error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "effects/arm_state.hpp"

namespace demecal::inline fitting {

void leave_out_motion_as_a_whole(const std::vector<Eigen::Vector3d>& points_m, std::vector<Eigen::MatrixXd>& rows) {
  using Motion = Eigen::Matrix<double, 3, 6>;
  std::vector<Motion> motions;
  Eigen::Matrix<double, 6, 6> square = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(6, rows.front().cols());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    Motion motion = Motion::Zero();
    motion.leftCols<3>().setIdentity();
    for (int axis = 0; axis < 3; ++axis) motion.col(3 + axis) = Eigen::Vector3d::Unit(axis).cross(points_m[i]);
    square += motion.transpose() * motion;
    product += motion.transpose() * rows[i];
    motions.push_back(motion);
  }
  const Eigen::MatrixXd best = square.ldlt().solve(product);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] -= motions[i] * best;
}

WorkspaceError workspace_error(const Posterior& posterior, const PredictionInterval& interval,
                               const CorrectedRobot& robot, std::span<const Interval> measured, bool placed,
                               RandomStream random) {
  constexpr int kPlaces = 200, kDraws = 500;
  constexpr double kShare = 0.95;
  std::vector<Eigen::Vector3d> points_m;
  std::vector<Eigen::MatrixXd> rows;
  for (int place = 0; place < kPlaces; ++place) {
    Stop stop(JointVector(std::ssize(measured)));
    stop.approach = ApproachSigns(std::ssize(measured));
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      stop.joints[joint] = random.real(measured[i].lower, measured[i].upper);
      stop.approach[joint] = random.chance(0.5) ? 1.0 : -1.0;
    }
    points_m.push_back(robot.predict(stop, "").translation());
    rows.push_back(pose_spread(posterior, robot, stop).topRows<3>());
  }
  if (!placed) leave_out_motion_as_a_whole(points_m, rows);
  double squares_m2 = 0.0;
  for (const Eigen::MatrixXd& own : rows) squares_m2 += own.squaredNorm() / kPlaces;
  const auto normal = [&](Eigen::Index size) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(size, [&] { return random.normal(); }));
  };
  std::vector<double> errors_m;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::VectorXd numbers = normal(rows.front().cols());
    for (const Eigen::MatrixXd& own : rows)
      errors_m.push_back((own * numbers + interval.model_error_m * normal(3)).norm());
  }
  const auto at = errors_m.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(errors_m.size()));
  std::nth_element(errors_m.begin(), at, errors_m.end());
  return {std::sqrt(squares_m2 + 3.0 * interval.model_error_m * interval.model_error_m), *at};
}

}  // namespace demecal::inline fitting

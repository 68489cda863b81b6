// Residual rows of positions, orientations and distances, their derivatives, and the four error figures.
#include "prediction/measurement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "random_robot.hpp"

namespace demecal {
namespace {

using Twist = Eigen::Matrix<double, 6, 1>;

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Twist& motion) {
  Eigen::Isometry3d result = pose;
  result.translation() += motion.head<3>();
  const Eigen::Vector3d turn = motion.tail<3>();
  result.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pose.linear();
  return result;
}

Twist random_motion(RandomStream& stream, double size) {
  Twist motion;
  for (double& part : motion) part = stream.real(-size, size);
  return motion;
}

DataSet data_with_anchors() {
  DataSet data;
  data.robot.chain = wrist_arm();
  data.anchors_m = {{3, 0, 0}, {0, 3, 1}, {-2, -2, 4}};
  return data;
}

/// A pose that measured the named quantities of `tool` without error.
MeasuredPose measured(const DataSet& data, const JointVector& q, const Eigen::Isometry3d& tool, bool position,
                      bool orientation, std::size_t distances) {
  MeasuredPose pose;
  pose.joints = q;
  if (position) pose.position_m = tool.translation();
  if (orientation) pose.orientation = Eigen::Quaterniond(tool.linear());
  for (std::size_t i = 0; i < distances; ++i) {
    pose.distances_m.push_back((tool.translation() - data.anchors_m[i]).norm());
  }
  return pose;
}

TEST(Residual, OfAPositionCountsByItsStatedCovariance) {
  RandomStream stream{9106};
  DataSet data = data_with_anchors();
  const CorrectedRobot robot = nominal_robot(data);
  for (int i = 0; i < 9; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    pose.position_m = robot.predict(Stop(pose), "").translation() + Eigen::Vector3d(1e-3, -2e-3, 5e-4);
    const Eigen::Matrix3d turn = random_pose(stream).linear();
    const Eigen::Vector3d sigma_m(stream.real(1e-5, 1e-4), stream.real(1e-5, 1e-4), stream.real(1e-5, 1e-4));
    pose.position_covariance_m2 = turn * sigma_m.cwiseAbs2().asDiagonal() * turn.transpose();
    data.poses.push_back(pose);
  }
  weigh_by_stated_uncertainty(data);
  ASSERT_GT(data.usual_sigma_m, 1e-5);
  for (const MeasuredPose& pose : data.poses) {
    const Eigen::Vector3d off = *pose.position_m - robot.predict(Stop(pose), "").translation();
    const double squares =
        off.dot(pose.position_covariance_m2->inverse() * off) * data.usual_sigma_m * data.usual_sigma_m;
    EXPECT_NEAR(residual(robot, data, pose).squaredNorm(), squares, 1e-9 * squares);
    EXPECT_NEAR(tool_error_m(robot, data, pose), off.norm(), 1e-15);  // figures are plain
  }
}

/// Calls `check(stream, position, orientation, distances)` for every combination of quantities.
template <typename Check>
void on_all_quantities(std::uint64_t seed, Check check) {
  RandomStream stream{seed};
  for (const bool position : {false, true}) {
    for (const bool orientation : {false, true}) {
      for (const std::size_t distances : {0, 1, 3}) check(stream, position, orientation, distances);
    }
  }
}

TEST(Rows, CountWhatWasMeasured) {
  on_all_quantities(701, [](RandomStream& stream, bool position, bool orientation, std::size_t distances) {
    const auto pose = measured(data_with_anchors(), {}, random_pose(stream), position, orientation, distances);
    const MeasurementRows rows = rows_of(pose);
    EXPECT_EQ(rows.position, position ? 3 : 0);
    EXPECT_EQ(rows.orientation, orientation ? 3 : 0);
    EXPECT_EQ(rows.distances, static_cast<int>(distances));
    EXPECT_EQ(rows.total(), rows.position + rows.orientation + rows.distances);
  });
}

TEST(Residual, IsZeroWhereTheRobotArrivesAsPredicted) {
  on_all_quantities(702, [](RandomStream& stream, bool position, bool orientation, std::size_t distances) {
    const DataSet data = data_with_anchors();
    const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.01, 0.05);
    const JointVector q = random_joints(stream, robot.chain);
    const MeasuredPose pose = measured(data, q, robot.predict(q, ""), position, orientation, distances);
    EXPECT_LT(residual(robot, data, pose).norm(), 1e-13);
  });
}

TEST(Residual, IsMeasuredMinusPredicted) {
  on_all_quantities(703, [](RandomStream& stream, bool position, bool orientation, std::size_t distances) {
    const DataSet data = data_with_anchors();
    const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.01, 0.05);
    const JointVector q = random_joints(stream, robot.chain);
    const Eigen::Isometry3d predicted = robot.predict(q, "B");
    const Twist motion = random_motion(stream, 0.3);
    const Eigen::Isometry3d real = moved(predicted, motion);
    MeasuredPose pose = measured(data, q, real, position, orientation, distances);
    pose.target = "B";
    Eigen::VectorXd expected(rows_of(pose).total());
    if (position) expected.head<3>() = motion.head<3>();
    if (orientation) expected.segment<3>(position ? 3 : 0) = motion.tail<3>();
    for (std::size_t i = 0; i < distances; ++i) {
      expected[expected.size() - static_cast<int>(distances - i)] =
          (real.translation() - data.anchors_m[i]).norm() - (predicted.translation() - data.anchors_m[i]).norm();
    }
    EXPECT_LT((residual(robot, data, pose) - expected).norm(), 1e-13);
  });
}

TEST(MeasurementJacobian, IsTheChangeOfTheMeasuredQuantities) {
  const double step = 1e-6;
  on_all_quantities(704, [&](RandomStream& stream, bool position, bool orientation, std::size_t distances) {
    const DataSet data = data_with_anchors();
    CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.01, 0.05);
    const JointVector q = random_joints(stream, robot.chain);
    const Eigen::Isometry3d predicted = robot.predict(q, "");
    const MeasuredPose pose = measured(data, q, predicted, position, orientation, distances);
    const auto jacobian = measurement_jacobian(robot, predicted, data, pose);
    ASSERT_EQ(jacobian.rows(), rows_of(pose).total());
    for (int axis = 0; axis < 6; ++axis) {
      const Twist motion = step * Twist::Unit(axis);
      const auto ahead = measured(data, q, moved(predicted, motion), position, orientation, distances);
      const auto behind = measured(data, q, moved(predicted, -motion), position, orientation, distances);
      const Eigen::VectorXd change = (residual(robot, data, ahead) - residual(robot, data, behind)) / (2 * step);
      EXPECT_LT((jacobian.col(axis) - change).norm(), 1e-8) << axis;
    }
  });
}

TEST(MeasurementJacobian, AtAnAnchorHasNoDerivative) {
  const DataSet data = data_with_anchors();
  const Eigen::Isometry3d at_anchor(Eigen::Translation3d(data.anchors_m[0]));
  const MeasuredPose pose = measured(data, {}, at_anchor, false, false, 1);
  EXPECT_TRUE(measurement_jacobian({}, at_anchor, data, pose).isZero(0.0));
}

TEST(MeasurementDeathTest, RefusesDistancesWithoutAnchors) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  MeasuredPose pose;
  pose.distances_m = {1.0};
  EXPECT_DEATH(measurement_jacobian({}, Eigen::Isometry3d::Identity(), DataSet(), pose), "distance 0 of 0 anchors");
}

TEST(ToolError, IsTheDistanceOfThePositionsWhateverElseWasMeasured) {
  RandomStream stream{705};
  const DataSet data = data_with_anchors();
  const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.0, 0.0);
  const JointVector q = random_joints(stream, robot.chain);
  Eigen::Isometry3d real = robot.predict(q, "");
  real.pretranslate(Eigen::Vector3d(0.003, 0.0, -0.004));
  EXPECT_NEAR(tool_error_m(robot, data, measured(data, q, real, true, false, 0)), 0.005, 1e-14);
  EXPECT_NEAR(tool_error_m(robot, data, measured(data, q, real, true, true, 3)), 0.005, 1e-14);
}

TEST(ToolError, OfDistancesAloneIsTheirRootMeanSquare) {
  RandomStream stream{706};
  const DataSet data = data_with_anchors();
  const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.0, 0.0);
  const JointVector q = random_joints(stream, robot.chain);
  MeasuredPose pose = measured(data, q, robot.predict(q, ""), false, false, 3);
  pose.distances_m[0] += 0.003;
  pose.distances_m[2] -= 0.004;
  EXPECT_NEAR(tool_error_m(robot, data, pose), std::sqrt((9e-6 + 16e-6) / 3), 1e-14);
}

/// Poses whose tool errors are 1, 2, ... `count` mm, in scrambled order, after one pose with orientation alone.
DataSet errors_up_to(int count, const CorrectedRobot& robot) {
  DataSet data = data_with_anchors();
  const JointVector q = JointVector::Zero(6);
  data.poses.push_back(measured(data, q, robot.predict(q, ""), false, true, 0));
  for (int i = 0; i < count; ++i) {
    Eigen::Isometry3d real = robot.predict(q, "");
    real.pretranslate(Eigen::Vector3d(0, 1e-3 * (1 + (i * 7) % count), 0));
    data.poses.push_back(measured(data, q, real, true, false, 0));
  }
  return data;
}

std::vector<std::size_t> all_of(const DataSet& data) {
  std::vector<std::size_t> poses(data.poses.size());
  std::iota(poses.begin(), poses.end(), std::size_t{0});
  return poses;
}

TEST(ErrorFigures, AreMeanRmsPercentileAndMaximumInMillimetres) {
  const CorrectedRobot robot = nominal_robot(data_with_anchors());
  for (const int n : {1, 2, 20, 41}) {  // not multiples of 7: the order of errors_up_to is a permutation
    const DataSet data = errors_up_to(n, robot);
    const ErrorFigures figures = error_figures(robot, data, all_of(data));
    EXPECT_NEAR(figures.mean_mm, (n + 1) / 2.0, 1e-9);
    EXPECT_NEAR(figures.rms_mm, std::sqrt((n + 1) * (2 * n + 1) / 6.0), 1e-9);
    EXPECT_NEAR(figures.p95_mm, 1 + 0.95 * (n - 1), 1e-9);
    EXPECT_NEAR(figures.max_mm, n, 1e-9);
  }
}

TEST(ErrorFigures, LookAtTheNamedPosesOnly) {
  const CorrectedRobot robot = nominal_robot(data_with_anchors());
  const DataSet data = errors_up_to(20, robot);
  const std::vector<std::size_t> one{3};
  const ErrorFigures figures = error_figures(robot, data, one);
  const double error_mm = 1e3 * tool_error_m(robot, data, data.poses[3]);
  EXPECT_NEAR(error_mm, 15.0, 1e-9);
  for (const double figure : {figures.mean_mm, figures.rms_mm, figures.p95_mm, figures.max_mm}) {
    EXPECT_DOUBLE_EQ(figure, error_mm);
  }
}

TEST(ErrorFigures, OfNoToolErrorsAreNotNumbers) {
  const CorrectedRobot robot = nominal_robot(data_with_anchors());
  const DataSet data = errors_up_to(0, robot);  // orientation alone
  for (const auto& poses : {std::vector<std::size_t>{}, std::vector<std::size_t>{0}}) {
    const ErrorFigures figures = error_figures(robot, data, poses);
    for (const double figure : {figures.mean_mm, figures.rms_mm, figures.p95_mm, figures.max_mm}) {
      EXPECT_TRUE(std::isnan(figure));
    }
  }
  EXPECT_TRUE(std::isnan(tool_error_m(robot, data, data.poses[0])));
}

TEST(ErrorFigures, CountAPredictionThatIsNoNumberAsInfinitelyFarOff) {
  CorrectedRobot robot = nominal_robot(data_with_anchors());
  const DataSet data = errors_up_to(20, robot);
  const Tree huge = apply(Primitive::multiply, constant_tree(1e300), constant_tree(1e300));
  robot.corrections[0] = JointCorrection(huge, {}, {-1.0, 1.0});
  const ErrorFigures figures = error_figures(robot, data, all_of(data));
  EXPECT_TRUE(std::isinf(figures.mean_mm));
  EXPECT_TRUE(std::isinf(figures.max_mm));
}

}  // namespace
}  // namespace demecal

// The parameter vector: every derivative against central differences.
#include "parameters/parameter_space.hpp"

#include <gtest/gtest.h>

#include "fitting/known_arm.hpp"
#include "parameters/observation.hpp"

namespace demecal {
namespace {

constexpr double kStep = 1e-6;
/// An arm with two targets that measures everything, standing anywhere.
KnownArm measured_arm(RandomStream& stream, const Chain& chain) {
  KnownArm arm = perfect_arm(chain, Frame::sensor);
  arm.data.tools_m = {{"A", {0.1, 0, 0.05}}, {"B", {0, 0.1, 0}}};
  arm.data.anchors_m = {{4, 0, 0}, {0, 5, 1}};
  arm.truth = nominal_robot(arm.data);
  arm.truth.sensor_from_base = far_pose(stream);
  arm.truth.tools["A"].linear() = far_pose(stream).linear();
  for (const char* target : {"A", "B"}) measure(arm, stream, {.orientation = true}, 3, target);
  return arm;
}

Eigen::VectorXd random_change_of(RandomStream& stream, int size) {
  Eigen::VectorXd change(size);
  for (double& value : change) value = 0.3 * stream.normal();
  return change;
}

class EveryColumn : public ::testing::TestWithParam<Chain> {
 protected:
  RandomStream stream_{91};
  KnownArm arm_ = measured_arm(stream_, GetParam());
  ParameterSpace space_{arm_.truth, free_parameters(arm_.data, kAll)};
};
INSTANTIATE_TEST_SUITE_P(ParameterSpace, EveryColumn,
                         ::testing::Values(parallel_arm(), modified_arm(), seven_joint_arm(), stanford_arm()));

TEST_P(EveryColumn, IsTheTwistThatDifferencesShow) {
  for (const MeasuredPose& pose : arm_.data.poses) {
    const Eigen::VectorXd change = random_change_of(stream_, space_.size());
    ToolMotion motion;
    space_.move_tool(space_.at(change), pose.joints, {}, pose.target, motion);
    for (int i = 0; i < space_.size(); ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space_.size(), i);
      const Eigen::Isometry3d before = space_.at(change - step).robot.predict(pose.joints, pose.target);
      const Eigen::Isometry3d after = space_.at(change + step).robot.predict(pose.joints, pose.target);
      Eigen::Matrix<double, 6, 1> twist;
      twist << after.translation() - before.translation(), rotation_between(before.linear(), after.linear());
      const std::string name = space_.ids()[static_cast<std::size_t>(i)].name();
      EXPECT_LT((motion.twists.col(i) - twist / (2 * kStep)).norm(), 1e-7) << name;
    }
  }
}

TEST_P(EveryColumn, OfTheScaledRowsIsWhatDifferencesShow) {
  const RowScales scales{2.0, 0.5, 3.0};
  const Eigen::VectorXd change = Eigen::VectorXd::Zero(space_.size());  // exact data: orientation residuals vanish
  for (std::size_t pose = 0; pose < arm_.data.poses.size(); ++pose) {
    const Observation observation{pose, arm_.data.poses[pose].joints};
    ScaledRows rows, before, after;
    scaled_rows(arm_.data, space_, space_.at(change), observation, scales, rows);
    ASSERT_EQ(rows.jacobian.rows(), 8);
    for (int i = 0; i < space_.size(); ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space_.size(), i);
      scaled_residual(arm_.data, space_.at(change - step).robot, observation, scales, before);
      scaled_residual(arm_.data, space_.at(change + step).robot, observation, scales, after);
      const Eigen::VectorXd slope = (after.residual - before.residual) / (2 * kStep);
      EXPECT_LT((rows.jacobian.col(i) - slope).norm(), 1e-7) << space_.ids()[static_cast<std::size_t>(i)].name();
    }
  }
}

TEST_P(EveryColumn, OfTheValuesIsWhatDifferencesShow) {
  const Eigen::VectorXd change = random_change_of(stream_, space_.size());
  const Eigen::MatrixXd jacobian = value_jacobian(space_, space_.at(change));
  const auto values = [&](const Eigen::VectorXd& at) {
    const CorrectedRobot robot = space_.at(at).robot;
    Eigen::VectorXd result(space_.size());
    for (int i = 0; i < space_.size(); ++i)
      result[i] = parameter_value(robot, space_.ids()[static_cast<std::size_t>(i)]);
    return result;
  };
  for (int i = 0; i < space_.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space_.size(), i);
    const Eigen::VectorXd slope = (values(change + step) - values(change - step)) / (2 * kStep);
    EXPECT_LT((jacobian.col(i) - slope).norm(), 1e-6) << space_.ids()[static_cast<std::size_t>(i)].name();
  }
}

TEST_P(EveryColumn, GivesTheGradientOfOrientationsExactlyEvenFarFromThem) {
  const RowScales orientation_only{0.0, 1.0, 0.0};
  const Observation observation{0, arm_.data.poses[0].joints};
  const Eigen::VectorXd change = random_change_of(stream_, space_.size());
  ScaledRows rows, before, after;
  scaled_rows(arm_.data, space_, space_.at(change), observation, orientation_only, rows);
  ASSERT_GT(rows.residual.norm(), 0.1);
  for (int i = 0; i < space_.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space_.size(), i);
    scaled_residual(arm_.data, space_.at(change - step).robot, observation, orientation_only, before);
    scaled_residual(arm_.data, space_.at(change + step).robot, observation, orientation_only, after);
    const double slope = (after.residual.squaredNorm() - before.residual.squaredNorm()) / (4 * kStep);
    EXPECT_NEAR(rows.jacobian.col(i).dot(rows.residual), slope, 1e-7);
  }
}

TEST(RotationVector, TurnsByItsLeftJacobian) {
  RandomStream stream{92};
  for (const double size : {0.0, 1e-7, 1e-4, 0.1, 1.0, 3.0}) {
    const Eigen::Vector3d vector = size * random_vector(stream, 1.0).normalized();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d turn = rotation_between(rotation_of(vector - step), rotation_of(vector + step));
      EXPECT_LT((left_jacobian(vector).col(i) - turn / (2 * kStep)).norm(), 1e-8) << size;
    }
    EXPECT_LT((vector_of(rotation_of(vector)) - vector).norm(), 1e-12) << size;
  }
}

}  // namespace
}  // namespace demecal

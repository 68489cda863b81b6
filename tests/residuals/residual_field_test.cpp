// The residual field: rows, weights, and every column against differences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/least_squares.hpp"
#include "measured_arm.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;

const std::vector<Effect> kTwoEffects = {
    {.kind = "backlash", .joint = 1, .settings = {}, .form = "approach", .values = {3e-4}},
    {.kind = "axis_wobble", .joint = 0, .settings = {{"order", 1}}, .values = {1e-4, 2e-4, -1e-4, 0}}};

/// Poses that measured position, both, distances, and orientation alone; without noise where `noise` is 0.
KnownArm mixed_arm(RandomStream& stream, Arm kind, double noise, const std::vector<Effect>& effects = {}) {
  KnownArm arm = arm_of(stream, laden_arm(stream, kind));
  arm.truth.effects = effects;
  measure_anyhow(arm, stream, {.noise_m = noise}, 2);
  measure_anyhow(arm, stream, {.noise_m = noise, .noise_rad = noise, .orientation = true}, 3);
  arm.data.anchors_m = {random_vector(stream, 3.0), random_vector(stream, 3.0)};
  measure_anyhow(arm, stream, {.noise_m = noise, .position = false}, 2);
  arm.data.anchors_m.resize(2);
  measure_anyhow(arm, stream, {.noise_m = noise, .noise_rad = noise, .position = false, .orientation = true}, 1);
  arm.data.poses.back().distances_m.clear();
  return arm;
}

/// Measured minus predicted of all the field's poses over their scales, none weighed down.
Eigen::VectorXd scaled_residuals(const KnownArm& arm, const CorrectedRobot& robot) {
  const ResidualField field = residual_field(arm.data, all_poses(arm.data), ParameterSpace(robot, {}), kScales, false);
  return field.residual;
}

TEST(ResidualField, HasTheRowsThatPosesMeasuredInOrder) {
  RandomStream stream{81, 1};
  const KnownArm arm = mixed_arm(stream, Arm::standard, 1e-4, kTwoEffects);
  const ResidualField field = field_of(arm, {.registration = true});
  EXPECT_THAT(field.first_row, ElementsAre(0, 3, 6, 12, 18, 24, 26, 28, 31));
  EXPECT_THAT(field.poses, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  ASSERT_EQ(field.rows(), 31);
  for (std::size_t i = 0; i < field.poses.size(); ++i) {
    const MeasuredPose& pose = arm.data.poses[i];
    Eigen::VectorXd expected = residual(arm.truth, arm.data, pose);
    const MeasurementRows rows = rows_of(pose);
    expected.head(rows.position) /= kScales[kPosition];
    expected.segment(rows.position, rows.orientation) /= kScales[kOrientation];
    expected.tail(rows.distances) /= kScales[kDistance];
    EXPECT_TRUE(expected.isApprox(field.residual.segment(field.first_row[i], field.rows_of_pose(i)), 1e-9));
    EXPECT_EQ(field.states[i].joints(), pose.joints);
  }
}

TEST(ResidualField, LeavesOutPosesOfWhichNothingIsUsed) {
  RandomStream stream{81, 2};
  const KnownArm arm = mixed_arm(stream, Arm::standard, 1e-4);
  const ResidualField field = field_of(arm, {.registration = true}, {5e-5, 0.0, 0.0});
  EXPECT_THAT(field.poses, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(field.first_row, ElementsAre(0, 3, 6, 9, 12, 15));
  EXPECT_EQ(field.states.size(), 5u);
}

TEST(ResidualField, OfNoPosesIsEmpty) {
  RandomStream stream{81, 3};
  const KnownArm arm = mixed_arm(stream, Arm::standard, 0.0);
  const ResidualField field = residual_field(arm.data, {}, space_of(arm, arm.truth, kPlacedAndZeroed), kScales, true);
  EXPECT_EQ(field.rows(), 0);
  EXPECT_THAT(field.first_row, ElementsAre(0));
}

TEST(ResidualField, DeclaredColumnsAreWhatTheModelsNumbersChange) {
  RandomStream stream{81, 4};
  for (const Arm kind : kArms) {
    const KnownArm arm = mixed_arm(stream, kind, 0.0, kTwoEffects);
    const ParameterSpace space =
        space_of(arm, arm.truth, {.registration = true, .tool = true, .joint_offset = true, .geometry = true});
    const ResidualField field = residual_field(arm.data, all_poses(arm.data), space, kScales, false);
    ASSERT_EQ(field.declared.cols(), space.size());
    constexpr double kStep = 1e-6;
    for (int k = 0; k < space.size(); ++k) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space.size(), k);
      const Eigen::VectorXd change =
          (scaled_residuals(arm, space.at(-step).robot) - scaled_residuals(arm, space.at(step).robot)) / (2 * kStep);
      EXPECT_TRUE(change.isApprox(field.declared.col(k), 1e-5)) << space.ids()[static_cast<std::size_t>(k)].name();
    }
  }
}

TEST(ResidualField, MotionColumnsAreWhatSmallMotionsOfEveryPlaceChange) {
  RandomStream stream{81, 5};
  for (const Arm kind : kArms) {
    const KnownArm arm = mixed_arm(stream, kind, 0.0);
    const ResidualField field = field_of(arm, {.registration = true});
    ASSERT_EQ(field.motions.cols(), 6 * (6 + 2));
    constexpr double kStep = 1e-6;
    for (std::size_t i = 0; i < field.poses.size(); ++i) {
      const MeasuredPose& pose = arm.data.poses[i];
      const Eigen::Index first = field.first_row[i], count = field.rows_of_pose(i);
      for (int place = kSensorPlace; place <= 6; ++place) {
        for (int axis = 0; axis < 6; ++axis) {
          const auto prediction = [&](double size) {
            PlaceMotions places = PlaceMotions::Zero(6, 7);
            SmallMotion sensor = SmallMotion::Zero();
            (place == kSensorPlace ? sensor[axis] : places(axis, place)) = size;
            return moved(Eigen::Isometry3d::Identity(), sensor) * arm.truth.sensor_from_base *
                   forward(arm.truth.chain, pose.joints, places) * arm.truth.tool("");
          };
          const Eigen::VectorXd change = (residual(arm.truth, prediction(-kStep), arm.data, pose) -
                                          residual(arm.truth, prediction(kStep), arm.data, pose)) /
                                         (2 * kStep);
          Eigen::VectorXd column = field.motions.block(first, motion_column(place, axis), count, 1);
          const MeasurementRows rows = rows_of(pose);
          column.head(rows.position) *= kScales[kPosition];
          column.segment(rows.position, rows.orientation) *= kScales[kOrientation];
          column.tail(rows.distances) *= kScales[kDistance];
          EXPECT_LT((column - change).norm(), 1e-6 * (1 + change.norm())) << place << ' ' << axis;
        }
      }
    }
  }
}

TEST(ResidualField, WeighsPosesFarOutDownAndNoOthers) {
  RandomStream stream{81, 6};
  KnownArm arm = mixed_arm(stream, Arm::standard, 1e-5);
  *arm.data.poses[1].position_m += Eigen::Vector3d(0.004, 0, 0);
  const ParameterSpace space = space_of(arm, arm.truth, kPlacedAndZeroed);
  const ResidualField plain = residual_field(arm.data, all_poses(arm.data), space, kScales, false);
  const ResidualField robust = residual_field(arm.data, all_poses(arm.data), space, kScales, true);
  for (std::size_t i = 0; i < plain.poses.size(); ++i) {
    const Eigen::Index first = plain.first_row[i], count = plain.rows_of_pose(i);
    const double expected = i == 1 ? 0.0 : 1.0;
    EXPECT_DOUBLE_EQ(plain.root_weight[i], 1.0);
    EXPECT_DOUBLE_EQ(robust.root_weight[i], expected);
    EXPECT_TRUE(robust.residual.segment(first, count).isApprox(expected * plain.residual.segment(first, count)));
    EXPECT_TRUE(robust.declared.middleRows(first, count).isApprox(expected * plain.declared.middleRows(first, count)));
    EXPECT_TRUE(robust.motions.middleRows(first, count).isApprox(expected * plain.motions.middleRows(first, count)));
  }
  EXPECT_EQ(robust.root_weight[1], 0.0);
}

TEST(ResidualField, WeightsFallSteadilyToNothing) {
  RandomStream stream{81, 7};
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::standard));
  measure_anyhow(arm, stream, {.noise_m = 1e-9}, 1);
  const Eigen::Vector3d at = *arm.data.poses[0].position_m;
  const ParameterSpace space = space_of(arm, arm.truth, kPlacedAndZeroed);
  double last = 1.0;
  for (double norm = 0.0; norm < 2.0 * rejection_norm(3); norm += 0.1) {
    arm.data.poses[0].position_m = at + Eigen::Vector3d(0, norm * kScales[kPosition], 0);
    const ResidualField field = residual_field(arm.data, all_poses(arm.data), space, kScales, true);
    const double weight = field.root_weight[0];
    EXPECT_LE(weight, last + 1e-6);
    if (norm < 0.98 * huber_threshold(3)) {
      EXPECT_EQ(weight, 1.0);
    }
    if (norm > 1.02 * rejection_norm(3)) {
      EXPECT_EQ(weight, 0.0);
    }
    last = weight;
  }
}

TEST(ResidualField, RowsOfAPoseAreIndependentWhereJointsScatter) {
  RandomStream stream{81, 8};
  const KnownArm arm = mixed_arm(stream, Arm::standard, 1e-5);
  const ParameterSpace space = space_of(arm, arm.truth, kPlacedAndZeroed);
  constexpr double kJoint_rad = 2e-4;
  const ResidualField plain = residual_field(arm.data, all_poses(arm.data), space, kScales, false);
  const ResidualField white =
      residual_field(arm.data, all_poses(arm.data), space, kScales, false, {.joint_rad = kJoint_rad});
  for (std::size_t i = 0; i < plain.poses.size(); ++i) {
    const Eigen::Index first = plain.first_row[i], count = plain.rows_of_pose(i);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(count, count);
    for (int joint = 0; joint < 6; ++joint) {
      const Eigen::VectorXd motion = plain.motions.block(first, motion_column(joint, kTurnAboutZ), count, 1);
      covariance += kJoint_rad * kJoint_rad * motion * motion.transpose();
    }
    EXPECT_TRUE((white.within[i] * white.within[i].transpose()).isApprox(covariance, 1e-9));
    EXPECT_TRUE(
        (white.within[i] * white.residual.segment(first, count)).isApprox(plain.residual.segment(first, count)));
    EXPECT_TRUE(
        (white.within[i] * white.motions.middleRows(first, count)).isApprox(plain.motions.middleRows(first, count)));
  }
}

}  // namespace
}  // namespace demecal

// What the joints should learn, from measured poses of arms whose joint errors are known.
#include "calibration/joint_targets.hpp"

#include <gtest/gtest.h>

#include "erring_arm.hpp"

namespace demecal {
namespace {

const std::vector<std::string> kErrors{"0.001*SIN(theta)",   "0.0008*COS(theta)", "0.0012*theta*0.5",
                                       "0.002*SIN(2*theta)", "0.0005*theta",      "0.001*COS(theta+0.3)"};

TEST(ExactTargets, AreTheTrueJointErrorsWhereTheFullPoseWasMeasured) {
  const CorrectedRobot truth = true_puma(kErrors);
  const DataSet data = measure(truth, 60, 0.0, 1, true);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const JointTargets targets = joint_targets(data, poses, nominal_robot(data), kExactTargets);
  ASSERT_EQ(targets.poses.size(), poses.size());
  int regular = 0;
  for (std::size_t row = 0; row < poses.size(); ++row) {
    if (targets.weight[row] < 1.0) continue;  // damped: only near the true errors
    ++regular;
    for (int joint = 0; joint < 6; ++joint) {
      const double expected = truth.corrections[static_cast<std::size_t>(joint)](data.poses[poses[row]].joints[joint]);
      EXPECT_NEAR(targets.error[row][joint], expected, 1e-7);
    }
  }
  EXPECT_GT(regular, 30);
}

TEST(ExactTargets, ReachTheMeasuredPositionWithTheNominalOrientationWherePositionAloneWasMeasured) {
  const DataSet data = measure(true_puma(kErrors), 30, 0.0, 2, false);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot nominal = nominal_robot(data);
  const JointTargets targets = joint_targets(data, poses, nominal, kExactTargets);
  for (std::size_t row = 0; row < poses.size(); ++row) {
    const MeasuredPose& pose = data.poses[poses[row]];
    const Eigen::Isometry3d reached = nominal.predict(pose.joints + targets.error[row], "");
    EXPECT_LT((reached.translation() - *pose.position_m).norm(), 1e-9);
    EXPECT_LT(rotation_between(nominal.predict(pose.joints, "").linear(), reached.linear()).norm(), 1e-9);
  }
}

TEST(ExactTargets, NameAndWeighDownPosesNearASingularity) {
  const CorrectedRobot truth = true_puma(kErrors);
  DataSet data = measure(truth, 30, 0.0, 3, false);
  MeasuredPose& straight_wrist = data.poses[3];
  straight_wrist.joints[4] = 1e-4;
  straight_wrist.position_m = truth.predict(straight_wrist.joints, "").translation();
  const JointTargets targets =
      joint_targets(data, poses_of(data, PoseSet::calibration), nominal_robot(data), kExactTargets);
  ASSERT_EQ(targets.singular.size(), 1U);
  EXPECT_EQ(targets.singular[0].pose, 3U);
  EXPECT_LT(targets.singular[0].smallest_singular, 0.01);
  std::size_t row = 0;
  while (targets.poses[row] != 3) ++row;
  EXPECT_LT(targets.weight[row], 0.1);
  EXPECT_TRUE(targets.error[row].allFinite());
}

TEST(JointTargets, LieOnOneSideWhereTheDataStraddleHalfATurn) {
  DataSet data = measure(true_puma(kErrors), 60, 0.0, 4, false);
  data.robot.chain.joints[3].lower = -2 * M_PI;
  data.robot.chain.joints[3].upper = 2 * M_PI;
  for (MeasuredPose& pose : data.poses) pose.joints[3] = std::remainder(pose.joints[3] + M_PI, 2 * M_PI);
  const JointTargets targets =
      joint_targets(data, poses_of(data, PoseSet::calibration), nominal_robot(data), kExactTargets);
  double lowest = 1e9, highest = -1e9;
  for (const JointVector& commanded : targets.commanded) {
    lowest = std::min(lowest, commanded[3]);
    highest = std::max(highest, commanded[3]);
  }
  EXPECT_TRUE(targets.branches[3].wraps);
  EXPECT_LT(highest - lowest, 2.7);
}

TEST(ExactTargets, OfDistancesAgreeWithWhatWasMeasured) {
  const CorrectedRobot truth = true_puma(kErrors);
  DataSet data = measure(truth, 12, 0.0, 5, false);
  data.anchors_m = {{2, 0, -1}, {0, 2, -1}, {-2, -1, -1}};
  for (MeasuredPose& pose : data.poses) {
    for (const Eigen::Vector3d& anchor : data.anchors_m) pose.distances_m.push_back((*pose.position_m - anchor).norm());
    pose.position_m.reset();
  }
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot nominal = nominal_robot(data);
  const JointTargets targets = joint_targets(data, poses, nominal, kExactTargets);
  for (std::size_t row = 0; row < poses.size(); ++row) {
    const MeasuredPose& pose = data.poses[poses[row]];
    const Eigen::Vector3d reached = nominal.predict(pose.joints + targets.error[row], "").translation();
    EXPECT_LT((reached - truth.predict(pose.joints, "").translation()).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace demecal

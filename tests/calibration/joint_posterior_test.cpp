// Joint errors told from the measured rows alone: where the truth is known, where an arm is stretched out, and of arms
// with more joints than rows.
#include "calibration/joint_targets.hpp"

#include <gtest/gtest.h>

#include "calibration/calibration.hpp"
#include "erring_arm.hpp"
#include "island_evolution.hpp"
#include "kinematics/units.hpp"
#include "measured_arm.hpp"

namespace demecal {
namespace {

const std::vector<std::string> kSmallErrors{"0.001*SIN(theta)",    "0.0008*COS(theta)", "0.0006*theta",
                                            "0.0012*SIN(2*theta)", "0.0005*theta",      "0.001*COS(theta+0.3)"};

JointBelief belief_about(const std::vector<JointCorrection>& mean, int joints) {
  return {Eigen::VectorXd::Constant(joints, 1e-3), mean};
}

/// Seven joints, each wrong by about 1 mrad, measured in position alone with 0.05 mm of noise; `locked`: the wrist's
/// joints stand still.
struct SevenJoints {
  DataSet data;
  CorrectedRobot truth;
};

SevenJoints seven_joints_measured(int poses, bool locked, std::uint64_t seed) {
  RandomStream random{seed, 907};
  SevenJoints made;
  DataSet& data = made.data;
  data.name = "seven";
  data.file = "seven.csv";
  data.frame = Frame::base;
  data.robot = bench::seven_joints();
  made.truth = nominal_robot(data);
  for (int joint = 0; joint < 7; ++joint) {
    const auto size = [&] { return std::to_string(1e-3 * random.normal()); };
    const std::string text = std::string(size()).append("*SIN(theta)+").append(size()).append("*COS(theta)");
    made.truth.corrections[static_cast<std::size_t>(joint)] = JointCorrection(parse(text), {}, {-M_PI, M_PI});
  }
  for (int i = 0; i < poses; ++i) {
    MeasuredPose pose;
    pose.joints.resize(7);
    for (int joint = 0; joint < 7; ++joint)
      pose.joints[joint] = locked && joint >= 4 ? 0.7 : 0.7 * random.real(-2.0, 2.0);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    pose.position_m = made.truth.predict(pose.joints, "").translation() + 5e-5 * noise;
    pose.set = i % 3 == 2 ? PoseSet::validation : PoseSet::calibration;
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(pose);
  }
  return made;
}

/// Root mean square of target less true joint error over joints that move, rad.
double rms_from_truth(const SevenJoints& of, const JointTargets& targets, int joints) {
  double sum = 0.0;
  for (std::size_t row = 0; row < targets.poses.size(); ++row) {
    for (int joint = 0; joint < joints; ++joint) {
      const double truth =
          of.truth.corrections[static_cast<std::size_t>(joint)](of.data.poses[targets.poses[row]].joints[joint]);
      sum += std::pow(targets.error[row][joint] - truth, 2);
    }
  }
  return std::sqrt(sum / static_cast<double>(targets.poses.size() * static_cast<std::size_t>(joints)));
}

Job short_job(TargetKind kind) {
  Job job;
  job.gp.population_size = 100;
  job.gp.number_generations = 30;
  job.targets.kind = kind;
  return job;
}

TEST(JointPosterior, IsWhereErrorsAndMisfitTogetherAreMostProbable) {
  DataSet data = measure(true_puma(kSmallErrors), 8, 1e-4, 21, true);
  data.anchors_m = {{2, 0, -1}, {0, 2, -1}};
  const CorrectedRobot nominal = nominal_robot(data);
  const RowScales scales{2e-4, 3e-4, 1e-4};
  RandomStream random{22, 1};
  for (MeasuredPose& pose : data.poses) {
    for (const Eigen::Vector3d& anchor : data.anchors_m) pose.distances_m.push_back((*pose.position_m - anchor).norm());
    const JointBelief belief = belief_about({}, 6);
    const auto misfit = [&](const JointVector& errors) {
      const Eigen::Isometry3d reached = nominal.predict(pose.joints + errors, "");
      const Eigen::VectorXd left = residual(nominal, reached, data, pose);
      return errors.squaredNorm() / 1e-6 + left.head<3>().squaredNorm() / std::pow(scales[kPosition], 2) +
             left.segment<3>(3).squaredNorm() / std::pow(scales[kOrientation], 2) +
             left.tail<2>().squaredNorm() / std::pow(scales[kDistance], 2);
    };
    const auto errors = most_probable_errors(data, pose, nominal, belief, scales);
    ASSERT_TRUE(errors.has_value());
    EXPECT_LT(misfit(*errors), misfit(JointVector::Zero(6)));
    for (int trial = 0; trial < 20; ++trial) {
      JointVector other = *errors;
      for (double& error : other) error += 1e-5 * random.normal();
      EXPECT_LT(misfit(*errors), misfit(other));
    }
  }
}

TEST(JointPosterior, IsTheMeanWhereThatExplainsAll) {
  const CorrectedRobot truth = true_puma(kSmallErrors);
  const DataSet data = measure(truth, 20, 0.0, 23, false);
  for (const MeasuredPose& pose : data.poses) {
    const auto errors =
        most_probable_errors(data, pose, nominal_robot(data), belief_about(truth.corrections, 6), {2e-5, 0.0, 0.0});
    ASSERT_TRUE(errors.has_value());
    EXPECT_LT((pose.joints + *errors - truth.corrected_joints(pose.joints)).norm(), 1e-9);
  }
}

TEST(JointPosterior, KnowsNothingOfRowsThatAreNotUsed) {
  DataSet turned = measure(true_puma(kSmallErrors), 10, 1e-4, 24, true), bare = turned;
  for (MeasuredPose& pose : turned.poses) pose.orientation = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
  for (MeasuredPose& pose : bare.poses) pose.orientation.reset();
  const CorrectedRobot nominal = nominal_robot(bare);
  for (std::size_t i = 0; i < bare.poses.size(); ++i) {
    const RowScales scales{1e-4, 0.0, 0.0};
    const auto with = most_probable_errors(turned, turned.poses[i], nominal, belief_about({}, 6), scales);
    const auto without = most_probable_errors(bare, bare.poses[i], nominal, belief_about({}, 6), scales);
    EXPECT_LT((*with - *without).norm(), 1e-12);
  }
}

/// What a fit leaves is mostly the joints' errors: taken for noise it would keep targets at half of them.
TEST(JointPosterior, TellsTheMeasurementsScatterFromTheJoints) {
  constexpr double kNoise_m = 3e-4;
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 200, kNoise_m, 25, false);
  const CorrectedRobot nominal = nominal_robot(data);
  RandomStream random{26, 1};
  double squares = 0.0;
  for (MeasuredPose& pose : data.poses) {
    for (double& joint : pose.joints) joint += 1e-3 * random.normal();
    squares += residual(nominal, data, pose).squaredNorm();
  }
  const double left_m = std::sqrt(squares / (3.0 * static_cast<double>(data.poses.size())));
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const RowScales found = measurement_scales(data, poses, nominal, belief_about({}, 6), {left_m, 0.0, 0.0});
  EXPECT_GT(left_m, 2.0 * kNoise_m);
  EXPECT_GT(found[kPosition], kNoise_m / 1.4);
  EXPECT_LT(found[kPosition], kNoise_m * 1.4);
  EXPECT_EQ(found[kOrientation], 0.0);
}

TEST(JointPosterior, AnOutstretchedArmDoesNotBendToTakeUpAMillimetre) {
  SevenJoints seven = seven_joints_measured(30, false, 27);
  MeasuredPose& straight = seven.data.poses[0];
  straight.joints.setZero();
  straight.joints[3] = 0.02;  // hardly bent
  const CorrectedRobot nominal = nominal_robot(seven.data);
  straight.position_m = nominal.predict(straight.joints, "").translation() + Eigen::Vector3d(0.0, 0.0, -1e-3);
  const std::vector<std::size_t> poses = poses_of(seven.data, PoseSet::calibration);
  const JointTargets exact = joint_targets(seven.data, poses, nominal, kExactTargets);
  const JointTargets targets = joint_targets(seven.data, poses, nominal, {{}, {5e-4, 0.0, 0.0}});
  EXPECT_GT(exact.error[0].cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT(targets.error[0].cwiseAbs().maxCoeff(), 0.01);
  EXPECT_EQ(targets.weight[0], 1.0);
}

TEST(JointPosterior, AJointThatTurnsTheToolPointInPlaceIsNotSaidToErr) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    DataSet data =
        measure(true_puma({"", "0.001*SIN(theta)", "0.0008*COS(2*theta)", "", "", ""}), 120, 5e-5, seed, false);
    CorrectedRobot truth = true_puma({"", "0.001*SIN(theta)", "0.0008*COS(2*theta)", "", "", ""});
    truth.tools[""] = Eigen::Translation3d(1e-3, 0.0, 0.1) * Eigen::Isometry3d::Identity();
    data.robot.chain.tool_m = {1e-3, 0.0, 0.1};
    RandomStream random{seed, 815};
    for (MeasuredPose& pose : data.poses) {
      pose.position_m = truth.predict(pose.joints, "").translation() +
                        5e-5 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    }
    const Preparation preparation = prepare(data, short_job(TargetKind::posterior));
    double largest_rad = 0.0;
    for (const JointVector& error : preparation.targets.error) largest_rad = std::max(largest_rad, std::abs(error[5]));
    EXPECT_LT(largest_rad, 3e-4) << "seed " << seed;
  }
}

/// How many corrections are kept; every one must have brought its joint nearer.
int kept_nearer(const SevenJoints& seven, const Job& job, const Preparation& preparation) {
  std::vector<JointCandidates> candidates;
  for (const JointTraining& training : preparation.training)
    candidates.push_back({training, evolved_front(job.gp, training, 5)});
  int kept = 0;
  for (const JointSummary& joint : conclude(seven.data, job, preparation, candidates).joints) {
    if (!joint.kept) continue;
    ++kept;
    EXPECT_LT(joint.after_rad, joint.before_rad) << "joint " << joint.joint + 1;
  }
  return kept;
}

class SevenJointTargets : public testing::TestWithParam<bool> {};

TEST_P(SevenJointTargets, AreNearTheTruthAndCorrectionsBringEveryKeptJointNearer) {
  const bool locked = GetParam();
  const Job job = short_job(TargetKind::posterior);
  int kept = 0;
  for (const std::uint64_t seed : {28U, 29U, 30U, 31U}) {
    const SevenJoints seven = seven_joints_measured(180, locked, seed);
    const Preparation exact = prepare(seven.data, short_job(TargetKind::exact)), preparation = prepare(seven.data, job);
    EXPECT_GT(rms_from_truth(seven, exact.targets, locked ? 4 : 7), 2e-3) << seed;
    EXPECT_LT(rms_from_truth(seven, preparation.targets, locked ? 4 : 7), 1e-3) << seed;
    kept += kept_nearer(seven, job, preparation);
  }
  EXPECT_GE(kept, 4);
}

INSTANTIATE_TEST_SUITE_P(Wrist, SevenJointTargets, testing::Bool(),
                         [](const auto& wrist) { return wrist.param ? "Locked" : "Free"; });

}  // namespace
}  // namespace demecal

// Every baseline finds its own law where that is the truth, and none breaks down where there are few poses.
#include "baselines/baseline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/known_arm.hpp"

namespace demecal {
namespace {

constexpr DeclaredModel kBaseAndTool{.registration = true, .tool = true};

/// Where the real arm's link parameters are at given joints.
using Truth = std::function<void(const JointVector&, Chain&)>;

/// Calibration and then validation poses of an arm whose links are as `truth` has them, seen from the instrument.
DataSet measured(RandomStream& stream, int calibration, int validation, const Truth& truth, double noise_m = 20e-6) {
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  arm.truth.sensor_from_base = far_pose(stream);
  const Chain nominal = arm.truth.chain;
  for (int i = 0; i < calibration + validation; ++i) {
    const JointVector q = random_joints(stream, nominal);
    arm.truth.chain = nominal;
    truth(q, arm.truth.chain);
    measure(arm, stream, {.noise_m = noise_m}, Stop(q));
    arm.data.poses.back().set = i < calibration ? PoseSet::calibration : PoseSet::validation;
  }
  return arm.data;
}

const Baseline& baseline(const std::string& key) {
  for (const Baseline& one : all_baselines()) {
    if (one.key == key) return one;
  }
  throw std::out_of_range(key);
}

double validation_rms_mm(const std::string& key, const DataSet& data) {
  const RegisteredArm arm = registered_arm(data, kBaseAndTool);
  return figures_by_set(baseline(key).fit(arm), data)[1].rms_mm;
}

void gain_and_offset(const JointVector& q, Chain& chain) {
  for (int i = 0; i < chain.size(); ++i) {
    chain.joints[static_cast<std::size_t>(i)].theta_rad += 1e-3 * (i - 2) + 8e-4 * (i % 3 - 1) * q[i];
  }
}

void quadratic(const JointVector& q, Chain& chain) {
  chain.joints[1].theta_rad += 1e-3 * q[1] * q[2] - 5e-4 * q[1] * q[1];
  chain.joints[3].theta_rad += 7e-4 * q[0] * q[4];
}

Truth waves(int order) {
  return [order](const JointVector& q, Chain& chain) {
    chain.joints[1].a_m += 1e-3 * std::sin(order * q[1]);
    chain.joints[2].theta_rad += 1e-3 * std::cos(order * q[2]);
    chain.joints[4].alpha_rad += 1.5e-3 * std::cos(order * q[4] + 0.3);
  };
}

void misbuilt(const JointVector& /*q*/, Chain& chain) {
  chain.joints[0].alpha_rad += 2e-3;
  chain.joints[1].a_m -= 1.5e-3;
  chain.joints[3].d_m += 1e-3;
  chain.joints[4].theta_rad -= 3e-3;
}

TEST(Baselines, EachFindsItsOwnLawToTheNoise) {
  const std::vector<std::pair<std::string, Truth>> laws{{"linear_joints", gain_and_offset},
                                                        {"polynomials", quadratic},
                                                        {"fourier_1", waves(1)},
                                                        {"fourier_2", waves(2)},
                                                        {"fourier_3", waves(3)},
                                                        {"geometry", misbuilt}};
  RandomStream stream{701};
  for (const auto& [key, law] : laws) {
    const DataSet data = measured(stream, 400, 100, law);
    EXPECT_LT(validation_rms_mm(key, data), 0.06) << key;  // the noise alone is 0.035
    EXPECT_GT(validation_rms_mm("registration", data), 0.3) << key;
  }
}

TEST(Baselines, ANetworkTakesAFifthAndMoreOffAnErrorThatIsSmoothInTwoJoints) {
  RandomStream stream{702};
  const Truth law = [](const JointVector& q, Chain& chain) {
    chain.joints[0].d_m += 2e-3 * std::sin(1.3 * q[0]) * std::cos(q[1]);
  };
  const DataSet data = measured(stream, 600, 200, law);
  EXPECT_LT(validation_rms_mm("radial_basis", data), 0.8 * validation_rms_mm("registration", data));
}

TEST(Baselines, AHigherOrderIsNeededForAHigherWave) {
  RandomStream stream{703};
  const DataSet data = measured(stream, 400, 100, waves(3));
  EXPECT_GT(validation_rms_mm("fourier_2", data), 3 * validation_rms_mm("fourier_3", data));
}

TEST(Baselines, NoneBreaksDownOnThirtyPosesOrOnAnArmThatLacksNothing) {
  RandomStream stream{704};
  for (const Truth& law : {Truth(gain_and_offset), Truth([](const JointVector&, Chain&) {})}) {
    const DataSet data = measured(stream, 30, 100, law, 1e-4);
    const double alone = validation_rms_mm("registration", data);
    for (const Baseline& one : all_baselines()) {
      EXPECT_LT(validation_rms_mm(one.key, data), 1.5 * alone) << one.key;
    }
  }
}

TEST(Baselines, CountTheirNumbersAndFitTheCalibrationPosesAlone) {
  RandomStream stream{705};
  DataSet data = measured(stream, 60, 20, gain_and_offset);
  const RegisteredArm arm = registered_arm(data, kBaseAndTool);
  EXPECT_EQ(arm.parameters, 9);
  EXPECT_EQ(baseline("linear_joints").fit(arm).parameters, 9 + 12);
  const int links = static_cast<int>(free_parameters(data, {.joint_offset = true, .geometry = true}).size());
  EXPECT_EQ(baseline("fourier_2").fit(arm).parameters, 9 + 5 * links);
  EXPECT_EQ(baseline("geometry").fit(arm).parameters, 9 + links);

  DataSet spoilt = data;
  for (MeasuredPose& pose : spoilt.poses) {
    if (pose.set == PoseSet::validation) *pose.position_m += Eigen::Vector3d(1, 2, 3);
  }
  const RegisteredArm other = registered_arm(spoilt, kBaseAndTool);
  for (const Baseline& one : all_baselines()) {
    const Eigen::Vector3d a = one.fit(arm).predict(data.poses[70]).translation();
    EXPECT_EQ(a, one.fit(other).predict(data.poses[70]).translation()) << one.key;
  }
}

}  // namespace
}  // namespace demecal

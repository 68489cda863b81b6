// Components of variance: each is found where it is, and nothing where it is not; what remains is independent.
#include <gtest/gtest.h>

#include <cmath>

#include "measured_arm.hpp"
#include "residuals/noise.hpp"
#include "residuals/noise_estimation.hpp"

namespace demecal {
namespace {

/// Rows of an arm without a model but base and zeros, and noise of the asked kind in place of its residual.
struct NoisyArm {
  KnownArm arm;
  ResidualField field;
  NoiseRows rows;
};

NoisyArm noisy_arm(RandomStream& stream, int poses, int repeats = 1) {
  NoisyArm made{arm_of(stream, laden_arm(stream, Arm::standard)), {}, {}};
  for (int i = 0; i < poses; ++i) {
    const Stop stop = random_stop(stream, made.arm.data.robot);
    for (int repeat = 0; repeat < repeats; ++repeat) {
      measure(made.arm, stream, {.noise_m = 5e-5}, stop);
      made.arm.data.poses.back().pose_id = "P" + std::to_string(i);
    }
  }
  made.field = field_of(made.arm, {.registration = true, .joint_offset = true});
  made.rows = {.columns = made.field.declared,
               .residual = {},
               .joint_motions = RowMatrix(made.field.rows(), 6),
               .first_row = made.field.first_row,
               .group = made.field.group,
               .order = {made.field.poses.begin(), made.field.poses.end()}};
  for (int joint = 0; joint < 6; ++joint)
    made.rows.joint_motions.col(joint) = made.field.motions.col(motion_column(joint, kTurnAboutZ));
  return made;
}

/// Noise of `model`, independent part `scale`, over the rows.
void draw(NoisyArm& tested, const NoiseModel& model, double scale, RandomStream& stream) {
  Eigen::VectorXd residual(tested.field.rows());
  for (double& value : residual) value = scale * stream.normal();
  Eigen::Vector3d drift = Eigen::Vector3d::Zero(), shared = drift;
  for (std::size_t i = 0; i < tested.field.poses.size(); ++i) {
    const Eigen::Index first = tested.field.first_row[i];
    JointVector joints(6);
    for (Eigen::Index joint = 0; joint < 6; ++joint)
      joints[joint] = std::sqrt(model.joint_variance_rad2(static_cast<std::size_t>(joint))) * stream.normal();
    residual.segment(first, 3) += tested.rows.joint_motions.middleRows(first, 3) * joints;
    for (double& value : drift) {
      value = i == 0 ? stream.normal()
                     : model.correlation * value + std::sqrt(1 - std::pow(model.correlation, 2)) * stream.normal();
    }
    residual.segment(first, 3) += scale * model.order * drift;
    if (tested.field.group[i] == i)
      for (double& value : shared) value = stream.normal();
    residual.segment(first, 3) += scale * model.repeats * shared;
  }
  tested.rows.residual = residual;
}

TEST(NoiseModel, ComponentsAreFoundAboutAsLargeAsTheyAre) {
  RandomStream stream{91, 1};
  NoisyArm tested = noisy_arm(stream, 30, 4);
  const double joint_rad =
      1.5 / std::sqrt(tested.rows.joint_motions.squaredNorm() / static_cast<double>(tested.field.rows()));
  constexpr int kDraws = 12;
  double joints = 0.0, repeats = 0.0, scale = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    draw(tested, {.joint_rad = joint_rad, .repeats = 2.0}, 1.3, stream);
    const NoiseEstimate found = estimate_noise(tested.rows);
    joints += found.model.joint_rad / joint_rad / kDraws;
    repeats += found.model.repeats / 2.0 / kDraws;
    scale += found.scale / 1.3 / kDraws;
    EXPECT_LT(found.model.order, 1.0);
  }
  EXPECT_NEAR(joints, 1.0, 0.15);
  EXPECT_NEAR(repeats, 1.0, 0.25);
  EXPECT_NEAR(scale, 1.0, 0.1);
}

TEST(NoiseModel, JointsThatScatterMoreThanOthersAreToldFromThem) {
  RandomStream stream{91, 5};
  NoisyArm tested = noisy_arm(stream, 100);
  const double joint_rad =
      2.0 / std::sqrt(tested.rows.joint_motions.squaredNorm() / static_cast<double>(tested.field.rows()));
  const std::vector<double> shares{2.0, 0.5, 2.0, 0.5, 0.5, 0.5};
  constexpr int kDraws = 6;
  std::vector<double> found(6, 0.0);
  for (int i = 0; i < kDraws; ++i) {
    draw(tested, {.joint_rad = joint_rad, .joint_shares = shares}, 1.0, stream);
    const NoiseModel model = estimate_noise(tested.rows).model;
    ASSERT_EQ(model.joint_shares.size(), 6u);
    for (std::size_t joint = 0; joint < 6; ++joint)
      found[joint] += model.joint_variance_rad2(joint) / (joint_rad * joint_rad) / kDraws;
  }
  for (const std::size_t joint : {0u, 2u}) {
    EXPECT_NEAR(found[joint], 2.0, 0.7) << joint;
    EXPECT_GT(found[joint], 1.5 * found[1]) << joint;
  }
  EXPECT_NEAR(found[1], 0.5, 0.25);
}

/// One joint whose noise is `of_rows` of the independent one, over rows; the others have `rest` of its variance.
struct FoundBesideOne {
  double own = 0.0, others = 0.0;  ///< variances, over that of the one joint
  double scale_off = 0.0;          ///< root mean square of its logarithm
};

FoundBesideOne one_joint_scatters(NoisyArm& tested, RandomStream& stream, double of_rows, double rest) {
  constexpr int kDraws = 6;
  constexpr std::size_t kNoisy = 4;
  const double joint_rad = of_rows / std::sqrt(tested.rows.joint_motions.col(kNoisy).squaredNorm() /
                                               static_cast<double>(tested.field.rows()));
  std::vector<double> shares(6, rest);
  shares[kNoisy] = 1.0;
  FoundBesideOne found;
  for (int i = 0; i < kDraws; ++i) {
    draw(tested, {.joint_rad = joint_rad, .joint_shares = shares}, 1.0, stream);
    const NoiseEstimate noise = estimate_noise(tested.rows);
    for (std::size_t each = 0; each < 6; ++each)
      (each == kNoisy ? found.own : found.others) +=
          noise.model.joint_variance_rad2(each) / (joint_rad * joint_rad) / kDraws;
    found.scale_off += std::pow(std::log(noise.scale), 2) / kDraws;
  }
  found.scale_off = std::sqrt(found.scale_off);
  return found;
}

TEST(NoiseModel, OneJointAloneThatScattersIsFound) {
  RandomStream stream{91, 7};
  NoisyArm tested = noisy_arm(stream, 60);
  for (const double of_rows : {1.5, 3.0}) {
    const FoundBesideOne found = one_joint_scatters(tested, stream, of_rows, 0.0);
    EXPECT_NEAR(found.own, 1.0, 0.35) << of_rows;
    EXPECT_LT(found.others, 0.1) << of_rows;
    EXPECT_LT(found.scale_off, 0.15) << of_rows;
  }
}

TEST(NoiseModel, WhatOthersScatterBesideOneJointIsNoIndependentNoise) {
  RandomStream stream{91, 8};
  NoisyArm tested = noisy_arm(stream, 100);
  const FoundBesideOne found = one_joint_scatters(tested, stream, 6.0, 0.003);
  EXPECT_NEAR(found.own, 1.0, 0.35);
  EXPECT_NEAR(found.others, 5 * 0.003, 0.01);
  EXPECT_LT(found.scale_off, 0.12);
}

TEST(NoiseModel, DriftInOrderIsFound) {
  RandomStream stream{91, 2};
  NoisyArm tested = noisy_arm(stream, 100);
  constexpr int kDraws = 8;
  double step = 0.0, correlation = 0.0;  // how far it goes from one pose to the next is what data tell best
  for (int i = 0; i < kDraws; ++i) {
    draw(tested, {.order = 3.0, .correlation = 0.9}, 1.0, stream);
    const NoiseEstimate found = estimate_noise(tested.rows);
    step += found.model.order * std::sqrt((1.0 - found.model.correlation) / (1.0 - 0.9)) / 3.0 / kDraws;
    correlation += found.model.correlation / kDraws;
  }
  EXPECT_NEAR(step, 1.0, 0.15);
  EXPECT_NEAR(correlation, 0.9, 0.06);
}

TEST(NoiseModel, ASlowDriftThatHardlyShowsCountsWhereItIsARival) {
  RandomStream stream{91, 6};
  NoisyArm tested = noisy_arm(stream, 60);
  constexpr int kDraws = 12;
  int found = 0, found_as_rival = 0;
  for (int i = 0; i < kDraws; ++i) {
    draw(tested, {.order = 0.5, .correlation = 0.99}, 1.0, stream);
    tested.rows.drift_is_rival = false;
    found += estimate_noise(tested.rows).model.order > 0.0;
    tested.rows.drift_is_rival = true;
    found_as_rival += estimate_noise(tested.rows).model.order > 0.0;
  }
  EXPECT_GT(found_as_rival, found + 2);
  EXPECT_GE(found_as_rival, kDraws / 2);
}

TEST(NoiseModel, IndependentNoiseHasNoOtherComponentsWorthTheName) {
  RandomStream stream{91, 3};
  NoisyArm tested = noisy_arm(stream, 60);
  constexpr int kDraws = 20;
  int drifting = 0;
  for (int i = 0; i < kDraws; ++i) {
    draw(tested, {}, 1.0, stream);
    const NoiseEstimate found = estimate_noise(tested.rows);
    drifting += found.model.order > 0.0;
    const double share = std::pow(found.model.joint_rad, 2) * tested.rows.joint_motions.squaredNorm() /
                         static_cast<double>(tested.field.rows());
    EXPECT_LT(share, 0.5);
    EXPECT_EQ(found.model.repeats, 0.0);
  }
  EXPECT_LE(drifting, 2);
}

TEST(SharedErrors, HaveTheCovarianceOfTheirNoise) {
  RandomStream stream{91, 4};
  const NoisyArm tested = noisy_arm(stream, 20, 2);
  const NoiseModel noise{.joint_rad = 0.0, .repeats = 0.7, .order = 2.0, .correlation = 0.9};
  const SharedErrors shared = shared_errors(noise, tested.field, tested.field);
  const Eigen::MatrixXd covariance = shared.fitted * shared.fitted.transpose();
  for (std::size_t i = 0; i < tested.field.poses.size(); ++i) {
    for (std::size_t k = 0; k < tested.field.poses.size(); ++k) {
      const double apart = std::abs(static_cast<double>(i) - static_cast<double>(k));
      const double expected = 4.0 * std::pow(0.9, apart) + (i / 2 == k / 2 ? 0.49 : 0.0);
      EXPECT_NEAR(covariance(tested.field.first_row[i], tested.field.first_row[k]), expected, 0.1) << i << ' ' << k;
      EXPECT_NEAR(covariance(tested.field.first_row[i], tested.field.first_row[k] + 1), 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace demecal

// Fits of arms whose errors we know: exact on exact data, from any start, for every kind of arm and measurement.
#include "fitting/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "errors/input_error.hpp"
#include "fitting/known_arm.hpp"
#include "fitting/least_squares.hpp"
#include "parameters/parameter_space.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr DeclaredModel kLinks{.joint_offset = true, .geometry = true};
/// What double precision and the solver's tolerances leave of exact data.
constexpr double kExact_m = 1e-8;

class EveryArm : public ::testing::TestWithParam<Chain> {};
INSTANTIATE_TEST_SUITE_P(Fit, EveryArm,
                         ::testing::Values(parallel_arm(), modified_arm(), seven_joint_arm(), stanford_arm()));

TEST_P(EveryArm, IsRecoveredFromExactPositionsSeenFromAnywhere) {
  RandomStream stream{71, 1};
  KnownArm arm = perfect_arm(GetParam(), Frame::sensor);
  misbuild(arm, stream, kAll);
  arm.truth.sensor_from_base = far_pose(stream);
  arm.truth.tools[""].translation() += random_vector(stream, 2e-3);
  measure(arm, stream, {}, 80);
  const Fit fit = fit_all(arm, kAll);
  EXPECT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_LT(largest_error_m(fit.robot, arm, stream), kExact_m);
  EXPECT_LT(fit.sigma_position_m, kExact_m);
}

TEST_P(EveryArm, IsRecoveredWithTheTargetHeldInAnyOrientation) {
  RandomStream stream{71, 2};
  KnownArm arm = perfect_arm(GetParam(), Frame::sensor);
  misbuild(arm, stream, kAll);
  arm.truth.sensor_from_base = far_pose(stream);
  arm.truth.tools[""].linear() = far_pose(stream).linear();
  measure(arm, stream, {.orientation = true}, 40);
  const Fit fit = fit_all(arm, kAll);
  EXPECT_LT(largest_error_m(fit.robot, arm, stream), kExact_m);
  for (const MeasuredPose& pose : arm.data.poses) {
    EXPECT_LT(residual(fit.robot, arm.data, pose).norm(), kExact_m);
  }
}

TEST(Fit, HoldsOneCleanPoseInTwentyForFar) {
  RandomStream stream{71, 21};
  for (const int rows : {1, 3, 6}) {
    constexpr int kDraws = 20000;
    int far = 0;
    for (int i = 0; i < kDraws; ++i) {
      double squares = 0.0;
      for (int row = 0; row < rows; ++row) squares += std::pow(stream.normal(), 2);
      if (std::sqrt(squares) > huber_threshold(rows)) ++far;
    }
    constexpr double kStandardError = 0.00154;
    EXPECT_NEAR(static_cast<double>(far) / kDraws, 0.05, 3.0 * kStandardError) << rows;
  }
}

TEST(Fit, GivesLinksTheirTrueValuesWhereNothingElseIsFree) {
  RandomStream stream{71, 3};
  for (const Chain& chain : {parallel_arm(), modified_arm(), seven_joint_arm()}) {
    KnownArm arm = perfect_arm(chain, Frame::base);
    misbuild(arm, stream, kLinks);
    measure(arm, stream, {.orientation = true}, 40);
    const Fit fit = fit_all(arm, kLinks);
    ASSERT_TRUE(fit.unidentified.empty()) << fit.unidentified[0].sentence();
    for (const ParameterEstimate& estimate : fit.estimates) {
      EXPECT_NEAR(estimate.value, parameter_value(arm.truth, estimate.id), 1e-8) << estimate.id.name();
      EXPECT_EQ(estimate.nominal, parameter_value(nominal_robot(arm.data), estimate.id)) << estimate.id.name();
    }
  }
}

TEST(Fit, FindsABaseMetresAwayAndTurnedByAnyAngle) {
  RandomStream stream{72};
  for (int trial = 0; trial < 20; ++trial) {
    KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
    arm.truth.sensor_from_base = far_pose(stream);
    measure(arm, stream, {}, 30);
    const Fit fit = fit_registration(arm.data, all_poses(arm.data), {.registration = true}, nominal_robot(arm.data));
    EXPECT_TRUE(fit.robot.sensor_from_base.isApprox(arm.truth.sensor_from_base, 1e-9)) << "trial " << trial;
  }
}

TEST(Fit, FindsBaseAndToolTogetherWithTheToolFarOff) {
  RandomStream stream{73};
  for (int trial = 0; trial < 20; ++trial) {
    KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
    arm.truth.sensor_from_base = far_pose(stream);
    arm.truth.tools[""].translation() = random_vector(stream, 0.8);
    measure(arm, stream, {}, 30);
    const Fit fit = fit_all(arm, kPlaced);
    EXPECT_LT(largest_error_m(fit.robot, arm, stream), kExact_m) << "trial " << trial;
  }
}

TEST(Fit, FindsABaseFromDistancesAlone) {
  RandomStream stream{74};
  for (int trial = 0; trial < 5; ++trial) {
    KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
    arm.data.anchors_m = {{0, 0, 0}, {0.8, 0.1, 0}, {0.2, 0.9, 0.3}};
    arm.truth.sensor_from_base = far_pose(stream);
    measure(arm, stream, {.position = false}, 60);
    const Fit fit = fit_all(arm, {.registration = true});
    EXPECT_LT(largest_error_m(fit.robot, arm, stream), kExact_m) << "trial " << trial;
    EXPECT_GT(fit.sigma_distance_m, 0.0);
    EXPECT_EQ(fit.sigma_position_m, 0.0);
  }
}

TEST(Fit, GivesEveryTargetItsOwnTool) {
  RandomStream stream{75};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  arm.data.tools_m = {{"A", {0.1, 0, 0}}, {"B", {0, 0.1, 0}}, {"C", {0, 0, 0.1}}};
  arm.truth = nominal_robot(arm.data);
  misbuild(arm, stream, kAll);
  arm.truth.sensor_from_base = far_pose(stream);
  for (const auto& [target, point] : arm.data.tools_m) {
    arm.truth.tools[target].translation() += random_vector(stream, 0.05);
  }
  for (int i = 0; i < 25; ++i) {
    const JointVector q = random_joints(stream, arm.data.robot.chain);
    for (const auto& [target, point] : arm.data.tools_m) measure(arm, stream, {}, q, target);
  }
  const Fit fit = fit_all(arm, kAll);
  for (const auto& [target, point] : arm.data.tools_m) {
    EXPECT_LT(largest_error_m(fit.robot, arm, stream, target), kExact_m) << target;
  }
}

TEST(Fit, KeepsCorrectionsAsTheyAre) {
  RandomStream stream{76};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  misbuild(arm, stream, kLinks);
  const Tree wave = apply(Primitive::multiply, constant_tree(0.01), apply(Primitive::sine, variable_tree(0)));
  arm.truth.corrections[1] = JointCorrection(wave, {}, {-3.0, 3.0});
  measure(arm, stream, {}, 60);
  CorrectedRobot start = nominal_robot(arm.data);
  start.corrections = arm.truth.corrections;
  const Fit fit = fit_declared(arm.data, all_poses(arm.data), kLinks, start);
  EXPECT_EQ(fit.robot.corrections[1].formula(), wave);
  EXPECT_LT(largest_error_m(fit.robot, arm, stream), kExact_m);
}

TEST(Fit, WithNothingDeclaredChangesNothingAndStillMeasuresTheScatter) {
  RandomStream stream{77};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  measure(arm, stream, {.noise_m = 1e-3}, 200);
  const Fit fit = fit_all(arm, {});
  EXPECT_EQ(fit.status, FitStatus::converged);
  EXPECT_TRUE(fit.estimates.empty());
  EXPECT_EQ(largest_error_m(fit.robot, arm, stream), 0.0);
  EXPECT_NEAR(fit.sigma_position_m, 1e-3, 1e-4);
}

TEST(Fit, SaysWhenPosesAreTooFew) {
  RandomStream stream{78};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  measure(arm, stream, {}, 11);
  const Fit fit = fit_all(arm, kAll);
  EXPECT_EQ(fit.status, FitStatus::too_few_poses);
  EXPECT_THAT(fit.sentence,
              HasSubstr("11 poses give 33 measured numbers; 33 free parameters need at least 34: measure more"));
  EXPECT_EQ(largest_error_m(fit.robot, arm, stream), 0.0);
  measure(arm, stream, {}, 1);
  EXPECT_NE(fit_all(arm, kAll).status, FitStatus::too_few_poses);
  EXPECT_EQ(fit_declared(arm.data, {}, kAll, nominal_robot(arm.data)).status, FitStatus::too_few_poses);
}

TEST(Fit, UsesOrientationsWithoutAToolOnlyWhereTheyAgreeWithIt) {
  RandomStream stream{79};
  for (const bool mounted_otherwise : {false, true}) {
    KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
    arm.truth.sensor_from_base = far_pose(stream);
    if (mounted_otherwise) arm.truth.tools[""].linear() = rotation_of({0, 0, kRight});
    measure(arm, stream, {.noise_m = 1e-4, .noise_rad = 1e-4, .orientation = true}, 40);
    const Fit fit = fit_all(arm, {.registration = true});
    EXPECT_LT(largest_error_m(fit.robot, arm, stream), 2e-4);
    EXPECT_EQ(fit.sigma_orientation_rad == 0.0, mounted_otherwise);
  }
}

TEST(Fit, NamesOutliersAndIsNotMovedByThem) {
  RandomStream stream{80};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  misbuild(arm, stream, kAll);
  measure(arm, stream, {.noise_m = 1e-4}, 100);
  const double clean = largest_error_m(fit_all(arm, kAll).robot, arm, stream);
  for (const std::size_t pose : {7u, 40u, 41u}) *arm.data.poses[pose].position_m += Eigen::Vector3d(0.05, 0, -0.02);
  const Fit robust = fit_all(arm, kAll);
  EXPECT_THAT(robust.outliers, ::testing::ElementsAre(7u, 40u, 41u));
  EXPECT_LT(largest_error_m(robust.robot, arm, stream), 2 * clean);
  EXPECT_GT(largest_error_m(fit_all(arm, kAll, {.robust = false}).robot, arm, stream), 5 * clean);
}

TEST(Fit, FindsNoOutliersInCleanData) {
  RandomStream stream{81};
  int outliers = 0;
  for (int trial = 0; trial < 20; ++trial) {
    KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
    measure(arm, stream, {.noise_m = 1e-4}, 100);
    outliers += static_cast<int>(fit_all(arm, {.joint_offset = true}).outliers.size());
  }
  EXPECT_LE(outliers, 1);
}

TEST(Fit, GivesTheSameBitsEveryTime) {
  RandomStream stream{82};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::sensor);
  measure(arm, stream, {.noise_m = 1e-4, .noise_rad = 1e-4, .orientation = true}, 40);
  const Fit first = fit_all(arm, kAll), second = fit_all(arm, kAll);
  for (std::size_t i = 0; i < first.estimates.size(); ++i) {
    EXPECT_EQ(first.estimates[i].value, second.estimates[i].value);
    EXPECT_EQ(first.estimates[i].standard_error, second.estimates[i].standard_error);
  }
}

TEST(Fit, TrustsTheStartsBaseWhereNoStartsAreAsked) {
  RandomStream stream{83};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  arm.truth.sensor_from_base = far_pose(stream);
  measure(arm, stream, {}, 30);
  CorrectedRobot start = nominal_robot(arm.data);
  start.sensor_from_base = arm.truth.sensor_from_base;
  const Fit fit = fit_declared(arm.data, all_poses(arm.data), kPlaced, start, {.starts = 0});
  EXPECT_TRUE(fit.robot.sensor_from_base.isApprox(arm.truth.sensor_from_base, 1e-9));
}

TEST(Fit, RefusesDistancesFromUnknownAnchors) {
  RandomStream stream{84};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  arm.data.anchors_m = {{0, 0, 0}};
  measure(arm, stream, {}, 20);
  arm.data.anchors_unknown = true;
  EXPECT_THROW(fit_all(arm, kLinks), InputError);
}

TEST(Fit, OfPosesThatSayHowSureTheyAreIsNearerToTheTruth) {
  RandomStream stream{9212};
  double stated_m = 0.0, alike_m = 0.0;
  for (int trial = 0; trial < 8; ++trial) {
    KnownArm arm = perfect_arm(seven_joint_arm(), Frame::sensor);
    misbuild(arm, stream, {.joint_offset = true, .geometry = true});
    for (const double noise_m : {2e-5, 4e-4}) {
      const std::size_t before = arm.data.poses.size();
      measure(arm, stream, {.noise_m = noise_m}, 40);
      for (std::size_t i = before; i < arm.data.poses.size(); ++i)
        arm.data.poses[i].position_covariance_m2 = noise_m * noise_m * Eigen::Matrix3d::Identity();
    }
    alike_m += largest_error_m(fit_all(arm, kAll).robot, arm, stream);
    weigh_by_stated_uncertainty(arm.data);
    stated_m += largest_error_m(fit_all(arm, kAll).robot, arm, stream);
  }
  EXPECT_LT(stated_m, 0.5 * alike_m);
}

}  // namespace
}  // namespace demecal

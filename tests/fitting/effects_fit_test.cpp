// Coefficients of effects fitted together with everything declared: derivatives, recovery, standard errors, rank.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fitting/known_arm.hpp"
#include "parameters/observation.hpp"
#include "prediction/random_effects.hpp"

namespace demecal {
namespace {

/// An arm with weight that stands anywhere.
KnownArm heavy_arm(RandomStream& stream, const Chain& chain) {
  KnownArm arm = perfect_arm(chain, Frame::sensor);
  arm.data.robot = heavy(stream, chain);
  arm.truth = nominal_robot(arm.data);
  arm.truth.sensor_from_base = far_pose(stream);
  return arm;
}

void measure_anyhow(KnownArm& arm, RandomStream& stream, const Instrument& instrument, int poses) {
  for (int i = 0; i < poses; ++i) measure(arm, stream, instrument, random_stop(stream, arm.data.robot.chain));
}

/// Effects that poses at random can tell from each other and from geometry.
std::vector<Effect> distinct_effects() {
  return {{.kind = "backlash", .joint = 1, .values = {6e-4}},
          {.kind = "compliance", .joint = 2, .settings = {}, .form = "payload", .values = {2e-6}},
          {.kind = "gear_harmonic", .joint = 0, .settings = {{"ratio", 17.0}}, .values = {-2e-4, 3e-4}},
          {.kind = "thermal_offset", .joint = 3, .settings = {{"reference_celsius", 25.0}}, .values = {-3e-5}},
          {.kind = "axis_wobble", .joint = 1, .settings = {{"order", 3.0}}, .values = {1e-4, -2e-4, 3e-4, 1e-4}}};
}

CorrectedRobot start_with(const KnownArm& arm, std::vector<Effect> effects) {
  CorrectedRobot start = nominal_robot(arm.data);
  start.effects = std::move(effects);
  for (Effect& effect : start.effects) effect.values.clear();
  return start;
}

double largest_residual(const CorrectedRobot& robot, const DataSet& data) {
  double largest = 0.0;
  for (const MeasuredPose& pose : data.poses) largest = std::max(largest, residual(robot, data, pose).norm());
  return largest;
}

void expect_same_values(const std::vector<Effect>& found, const std::vector<Effect>& truth, double relative) {
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_EQ(found[i].values.size(), truth[i].values.size());
    for (std::size_t k = 0; k < truth[i].values.size(); ++k) {
      EXPECT_NEAR(found[i].values[k], truth[i].values[k], relative * std::abs(truth[i].values[k]))
          << truth[i].kind << ' ' << k;
    }
  }
}

TEST(EffectColumns, AreTheTwistsThatDifferencesShow) {
  RandomStream stream{1201};
  for (const Chain& chain : {parallel_arm(), modified_arm(), stanford_arm()}) {
    KnownArm arm = heavy_arm(stream, chain);
    arm.truth.effects = random_effects(arm.data.robot, stream, 0.02, 2);
    measure_anyhow(arm, stream, {}, 3);
    std::vector<ParameterId> ids = free_parameters(arm.data, kAll);
    for (ParameterId& id : effect_parameters(arm.truth)) ids.push_back(std::move(id));
    const ParameterSpace space(arm.truth, ids);
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(space.size());
    for (const Observation& seen : observe(arm.data, all_poses(arm.data), arm.truth)) {
      ToolMotion motion;
      space.move_tool(space.at(still), seen.corrected, seen.motions, "", motion);
      EXPECT_LT((motion.predicted.matrix() - arm.truth.predict(Stop(arm.data.poses[seen.pose]), "").matrix()).norm(),
                1e-13);
      for (int i = 0; i < space.size(); ++i) {
        // Steps that move the tool by about a millimetre or less, whatever the unit of the parameter.
        const double scale = std::max(motion.twists.col(i).norm(), 1e-3), step = 1e-6 / scale;
        const auto pose = [&](double by) {
          const CorrectedRobot robot = space.at(by * Eigen::VectorXd::Unit(space.size(), i)).robot;
          return robot.predict(seen.corrected, seen.motions, "");
        };
        const PoseError slope = pose_error(pose(-step), pose(step)) / (2 * step);
        EXPECT_LT((motion.twists.col(i) - slope).norm(), 1e-7 * scale) << ids[static_cast<std::size_t>(i)].name();
      }
    }
  }
}

TEST(EffectParameters, AreNamedByLawJointSettingsAndCoefficient) {
  RandomStream stream{1202};
  KnownArm arm = heavy_arm(stream, parallel_arm());
  arm.truth.effects = distinct_effects();
  arm.truth.effects.resize(3);
  std::vector<std::string> names;
  for (const ParameterId& id : effect_parameters(arm.truth)) names.push_back(id.name());
  EXPECT_THAT(names, ::testing::ElementsAre("backlash joint 2 width_rad", "compliance joint 3 rad_per_nm",
                                            "gear_harmonic joint 1 (ratio 17) cosine_rad",
                                            "gear_harmonic joint 1 (ratio 17) sine_rad"));
}

TEST(FitOfEffects, RecoversThemTogetherWithGeometryFromExactPositions) {
  RandomStream stream{1203};
  for (const Chain& chain : {parallel_arm(), modified_arm(), seven_joint_arm()}) {
    KnownArm arm = heavy_arm(stream, chain);
    misbuild(arm, stream, kAll);
    arm.truth.effects = distinct_effects();
    measure_anyhow(arm, stream, {}, 120);
    const FitOptions no_prior{.prior_m = 0, .prior_rad = 0};
    const Fit fit = fit_declared(arm.data, all_poses(arm.data), kAll, start_with(arm, distinct_effects()), no_prior);
    EXPECT_EQ(fit.status, FitStatus::converged) << fit.sentence;
    expect_same_values(fit.robot.effects, arm.truth.effects, 1e-5);
    EXPECT_LT(largest_residual(fit.robot, arm.data), 1e-8);
  }
}

TEST(FitOfEffects, LeavesAScaleOfTheInstrumentWhereTheToolIsReallySeen) {
  RandomStream stream{1204};
  KnownArm arm = heavy_arm(stream, parallel_arm());
  arm.truth.effects = {{.kind = "sensor_scale", .values = {2e-3}}};
  measure_anyhow(arm, stream, {}, 40);
  const Fit fit = fit_declared(arm.data, all_poses(arm.data), kPlaced, start_with(arm, arm.truth.effects));
  expect_same_values(fit.robot.effects, arm.truth.effects, 1e-4);
  EXPECT_LT(largest_residual(fit.robot, arm.data), 1e-7);
}

TEST(FitOfEffects, GivesStandardErrorsThatAreTheSpreadOfRepeatedFits) {
  constexpr int kTrials = 120;  // spreads are known to 6.5 %: four of these are allowed
  RandomStream stream{1205};
  KnownArm arm = heavy_arm(stream, parallel_arm());
  misbuild(arm, stream, kAll);
  arm.truth.effects = distinct_effects();
  const FitOptions options{.starts = 0, .prior_m = 0, .prior_rad = 0};
  Eigen::MatrixXd values(9, kTrials), errors(9, kTrials);
  for (int trial = 0; trial < kTrials; ++trial) {
    arm.data.poses.clear();
    RandomStream same_stops{1206};
    for (int i = 0; i < 60; ++i) {
      measure(arm, stream, {.noise_m = 1e-4}, random_stop(same_stops, arm.data.robot.chain));
    }
    const Fit fit = fit_declared(arm.data, all_poses(arm.data), kAll, arm.truth, options);
    Eigen::Index row = 0;
    for (const Effect& effect : fit.robot.effects) {
      ASSERT_EQ(effect.standard_errors.size(), effect.values.size());
      for (std::size_t k = 0; k < effect.values.size(); ++k, ++row) {
        values(row, trial) = effect.values[k];
        errors(row, trial) = effect.standard_errors[k];
      }
    }
    ASSERT_EQ(row, 9);
  }
  for (Eigen::Index i = 0; i < 9; ++i) {
    const double spread = std::sqrt((values.row(i).array() - values.row(i).mean()).square().sum() / (kTrials - 1));
    EXPECT_NEAR(spread / errors.row(i).mean(), 1.0, 0.26) << i;
  }
}

TEST(FitOfEffects, LaysNothingAtTheDoorOfAnEffectThatGeometryExplains) {
  RandomStream stream{1207};
  KnownArm arm = heavy_arm(stream, parallel_arm());
  misbuild(arm, stream, kAll);
  measure_anyhow(arm, stream, {.noise_m = 1e-4}, 60);
  const std::vector<Effect> effects = {
      {.kind = "joint_offset", .joint = 2}, {.kind = "backlash", .joint = 1}, {.kind = "registration"}};
  const Fit without = fit_declared(arm.data, all_poses(arm.data), kAll, nominal_robot(arm.data));
  const Fit fit = fit_declared(arm.data, all_poses(arm.data), kAll, start_with(arm, effects));
  EXPECT_EQ(fit.rank, without.rank + 1) << "the backlash alone is new";
  EXPECT_LT(std::abs(fit.robot.effects[0].values[0]), 1e-8);
  for (const double value : fit.robot.effects[2].values) EXPECT_LT(std::abs(value), 1e-7);
}

TEST(FitOfEffects, KeepsThemWhereTheyAreNotToBeRefitted) {
  RandomStream stream{1208};
  KnownArm arm = heavy_arm(stream, parallel_arm());
  arm.truth.effects = distinct_effects();
  measure_anyhow(arm, stream, {}, 40);
  CorrectedRobot start = nominal_robot(arm.data);
  start.effects = distinct_effects();
  const Fit fit = fit_registration(arm.data, all_poses(arm.data), kPlaced, start);
  EXPECT_EQ(fit.robot.effects[2].values, distinct_effects()[2].values);
  EXPECT_EQ(fit.estimates.size(), 9u);
  EXPECT_LT(largest_residual(fit.robot, arm.data), 1e-8);
  start.effects[0].values = {0.0};
  const Fit other = fit_registration(arm.data, all_poses(arm.data), kPlaced, start);
  EXPECT_EQ(other.robot.effects[0].values, std::vector<double>{0.0});
  EXPECT_GT(largest_residual(other.robot, arm.data), 1e-5);
}

TEST(FitOfEffects, CountsTheirCoefficientsAmongTheParameters) {
  RandomStream stream{1209};
  KnownArm arm = heavy_arm(stream, parallel_arm());
  measure_anyhow(arm, stream, {}, 6);  // 18 numbers for 6 + 3 + 9 parameters
  const Fit fit = fit_declared(arm.data, all_poses(arm.data), kPlaced, start_with(arm, distinct_effects()));
  EXPECT_EQ(fit.status, FitStatus::too_few_poses);
  EXPECT_THAT(fit.sentence, ::testing::HasSubstr("18 free parameters"));
}

}  // namespace
}  // namespace demecal

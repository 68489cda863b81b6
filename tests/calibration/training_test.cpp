// The tables islands learn from keep what the joints should learn, at a scale of order one.
#include "calibration/training.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "erring_arm.hpp"
#include "expression/text.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

JointTargets some_targets(double size) {
  const DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, size, 6, true);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  return joint_targets(data, poses, nominal_robot(data), kExactTargets);
}

TEST(Training, TargetsTimesScaleAreTheJointErrors) {
  const JointTargets targets = some_targets(1e-3);
  const std::vector<JointTraining> tables = training_tables(puma(), targets);
  ASSERT_EQ(tables.size(), 6U);
  for (const JointTraining& training : tables) {
    for (std::size_t row = 0; row < targets.poses.size(); ++row) {
      const int joint = static_cast<int>(training.joint);
      EXPECT_NEAR(training.table.target[row] * training.scale_rad, targets.error[row][joint], 1e-15);
      EXPECT_EQ(training.table.variables[0][row], targets.commanded[row][joint]);
    }
  }
}

TEST(Training, ScaleIsARoundNumberWithinAFactorOfTheMeanTarget) {
  for (const double size : {1e-5, 3e-4, 7e-3}) {
    for (const JointTraining& training : training_tables(puma(), some_targets(size))) {
      double sum = 0.0, weights = 0.0;
      for (std::size_t row = 0; row < training.table.target.size(); ++row) {
        sum += training.table.weight[row] * std::abs(training.table.target[row]);
        weights += training.table.weight[row];
      }
      const double mean = sum / weights;
      EXPECT_GE(mean, 0.999);
      EXPECT_LT(mean, 2.51);
      const double mantissa =
          training.scale_rad / std::pow(10.0, std::floor(std::log10(training.scale_rad * 1.000001)));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6)
          << mantissa;
    }
  }
}

TEST(Training, AJointThatStandsStillGetsNoTable) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, 1e-4, 7, false);
  for (MeasuredPose& pose : data.poses) pose.joints[3] = 0.7;
  const JointTargets targets =
      joint_targets(data, poses_of(data, PoseSet::calibration), nominal_robot(data), kExactTargets);
  for (const JointTraining& training : training_tables(puma(), targets)) EXPECT_NE(training.joint, 3U);
}

TEST(Training, SeedsAreTheSameCorrectionsInUnitsOfTheScale) {
  const CorrectionOptions options{
      0.004, {{SeedFormula::kEveryJoint, parse("0.002 * SIN(theta)")}, {2, parse("COS(theta) * 0.001")}}};
  for (const JointTraining& training : training_tables(puma(), some_targets(1e-3), options)) {
    const std::vector<Tree>& seeds = training.table.seeds;
    ASSERT_EQ(seeds.size(), training.joint == 2 ? 2U : 1U);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const JointCorrection correction = correction_from(training, seeds[i]);
      const double theta = 0.5 * (training.range_rad.lower + training.range_rad.upper);
      EXPECT_NEAR(correction(theta), evaluate(options.seeds[i].formula, {&theta, 1}), 1e-15);
    }
  }
}

TEST(Training, LimitsFormulasToThreeTimesLargeTargetsAndToWhatTheUserAllows) {
  const JointTargets targets = some_targets(1e-3);
  const std::vector<JointTraining> free = training_tables(puma(), targets);
  const std::vector<JointTraining> tight = training_tables(puma(), targets, {1e-4, {}});
  for (std::size_t i = 0; i < free.size(); ++i) {
    double largest = 0.0;
    for (const double target : free[i].table.target) largest = std::max(largest, std::abs(target));
    EXPECT_GT(free[i].table.limit, 1.0);
    EXPECT_LE(free[i].table.limit, 3.0 * largest);
    EXPECT_NEAR(tight[i].table.limit * tight[i].scale_rad, 1e-4, 1e-15);
  }
}

TEST(Training, CorrectionIsTheEvolvedTreeTimesTheScale) {
  const JointTraining training = training_tables(puma(), some_targets(1e-3))[1];
  const Tree evolved = parse("SIN(theta)+0.25");
  const JointCorrection correction = correction_from(training, evolved);
  const double theta = 0.5 * (training.range_rad.lower + training.range_rad.upper);
  EXPECT_DOUBLE_EQ(correction(theta), training.scale_rad * (std::sin(theta) + 0.25));
}

TEST(Shortened, KeepsEveryValueInTheRange) {
  const std::vector<const char*> formulas{
      "0.001 * (theta + (theta - 0.9) + SQRTp(theta + theta)) + (0.0002 * 1 + 0.0003 * (1.5 * (2.1 * (theta - 0.6)) * "
      "(2.1 * (theta - 0.6)) + (-0.5)))",
      "0.002 * (theta % theta + 0.5 * SIN(theta) + 0.25 * SIN(theta)) - 0.001",
      "0.001 * SIGN(theta + 1 - theta) * COS(2 * theta + theta)", "0.001 * ((3 * theta) % theta + 2 % (theta + 4))"};
  RandomStream random{41};
  for (const char* text : formulas) {
    const JointCorrection correction(parse(text), {}, {-2.0, 1.5});
    const JointCorrection brief = shortened(correction);
    EXPECT_LE(brief.formula().size(), correction.formula().size()) << text;
    for (int trial = 0; trial < 1000; ++trial) {
      const double theta_rad = trial == 0 ? 0.0 : random.real(-3.0, 3.0);
      EXPECT_NEAR(brief(theta_rad), correction(theta_rad), 1e-11) << text;
    }
  }
}

TEST(Shortened, IsShorterWhereTermsCanBeCollected) {
  const JointCorrection correction(parse("0.25 * (theta + (theta - 0.5) + 1 * theta)"), {}, {-2.0, 1.5});
  EXPECT_EQ(to_string(shortened(correction).formula()), "0.75 * theta - 0.125");
}

TEST(Shortened, LeavesNeutralCorrectionsNeutral) {
  EXPECT_TRUE(shortened(JointCorrection{}).is_neutral());
  EXPECT_TRUE(shortened({neutral_tree(), {}, {-1.0, 1.0}}).is_neutral());
}

}  // namespace
}  // namespace demecal

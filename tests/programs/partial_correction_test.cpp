// A correction is made as far as it is surely known.
#include <gtest/gtest.h>

#include <cmath>

#include "corrected_arm.hpp"
#include "expression/text.hpp"
#include "programs/summary.hpp"
#include "programs/target_correction.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(DeterminedPart, IsAllOfASureCorrectionAndNoneOfAnUnsureOne) {
  const Eigen::Vector3d correction(1e-3, -2e-3, 5e-4);
  const DeterminedPart sure = determined_part(correction, 1e-12 * Eigen::Matrix3d::Identity(), 5e-5);
  EXPECT_EQ(sure.applied, correction);
  EXPECT_EQ(sure.deviation, 0.0);
  const DeterminedPart unsure = determined_part(correction, Eigen::Matrix3d::Identity(), 5e-5);
  EXPECT_TRUE(unsure.applied.isZero(0.0));
  EXPECT_DOUBLE_EQ(unsure.deviation, 1.0);
}

TEST(DeterminedPart, LeavesTheOneDirectionThatIsNotKnown) {
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -2).normalized();
  const Eigen::Matrix3d covariance = 1e-12 * Eigen::Matrix3d::Identity() + 1e-4 * direction * direction.transpose();
  const Eigen::Vector3d correction(1e-3, -2e-3, 5e-4);
  const DeterminedPart part = determined_part(correction, covariance, 5e-5);
  EXPECT_NEAR(std::abs(part.omitted.dot(direction)), 1.0, 1e-9);
  EXPECT_NEAR(part.applied.dot(direction), 0.0, 1e-9);
  EXPECT_LT((part.applied - (correction - correction.dot(direction) * direction)).norm(), 1e-9);
}

TEST(DeterminedPart, MakesAnErrorLargerAsRarelyAsItSays) {
  RandomStream stream{7511};
  int applied = 0, larger = 0;
  for (int i = 0; i < 20000; ++i) {
    const double deviation = stream.real(1e-5, 1e-3);
    Eigen::Vector3d truth, noise;
    for (double& part : truth) part = 1e-3 * stream.normal();
    for (double& part : noise) part = deviation * stream.normal();
    const DeterminedPart part =
        determined_part(truth + noise, deviation * deviation * Eigen::Matrix3d::Identity(), 5e-5);
    applied += part.applied.isZero(0.0) ? 0 : 1;
    larger += (truth - part.applied).norm() > truth.norm() ? 1 : 0;
  }
  EXPECT_GT(applied, 5000);
  EXPECT_LT(larger, 20);
}

/// As sure of the second joint's zero as `deviation_rad` says, and of everything else.
CommandModel sure_to(CommandModel model, double deviation_rad) {
  Posterior posterior;
  posterior.ids = {{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta}};
  posterior.factor = Eigen::MatrixXd::Constant(1, 1, deviation_rad);
  model.posterior = posterior;
  model.interval = PredictionInterval{};
  model.interval->quantile = 1.6;
  return model;
}

TEST(Correction, CountsWhatItLeavesToWhatItIsReachedWithin) {
  RandomStream stream{7512};
  const Robot nominal = elbow_arm(stream);
  const CommandModel model = erring_model(stream, nominal);
  for (int i = 0; i < 20; ++i) {
    Target target;
    target.joints.resize(6);
    const Stop stop(regular_joints(stream, nominal.chain));
    const CorrectedTarget sure = correct_target(target, sure_to(model, 1e-7), stop);
    EXPECT_NEAR(sure.left_m, 0.0, 1e-6);
    EXPECT_TRUE(sure.left.empty());
    EXPECT_LT(*sure.error95_m, 1e-5);
    const CorrectedTarget unsure = correct_target(target, sure_to(model, 1.0), stop);
    const double whole_m =
        (model.robot.predict(stop, "").translation() - model.nominal_tool(stop.joints).translation()).norm();
    const double there_m =
        (model.robot.predict(stop.with_joints(unsure.command), "").translation() - unsure.nominal_tool.translation())
            .norm();
    EXPECT_LE(unsure.left_m, whole_m);
    EXPECT_GE(*unsure.error95_m, there_m) << "by the model itself it is so far off";
    EXPECT_GE(*unsure.error95_m, *error95_m(sure_to(model, 1.0), stop) + unsure.left_m);
  }
}

/// A joint's error as demos and theses have it, known within this range.
JointCorrection known_wave(double amplitude, double phase, const Interval& range) {
  const std::string formula = std::to_string(amplitude) + " * SIN(2 * theta + (" + std::to_string(phase) + "))";
  return {parse(formula), {true, 0.5 * (range.lower + range.upper)}, range};
}

TEST(Correction, OutsideOfWhatWasMeasuredIsMadeAsFarAsJointsCorrectionsAreKnown) {
  RandomStream stream{7514};
  int outside = 0, held = 0, worse = 0, helped = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Robot nominal = elbow_arm(stream);
    CorrectedRobot robot = random_robot(stream, nominal.chain, 0.0, 0.0);
    CorrectedRobot truth = robot;
    std::vector<Interval> ranges;
    for (int joint = 0; joint < 6; ++joint) {
      const double middle = stream.real(-0.5, 0.5), half = stream.real(0.4, 1.0);
      const double amplitude = stream.real(1e-3, 4e-3), phase = stream.real(-3.0, 3.0);
      ranges.push_back({middle - half, middle + half});
      const auto at = static_cast<std::size_t>(joint);
      robot.corrections[at] = known_wave(amplitude, phase, ranges.back());
      truth.corrections[at] = known_wave(amplitude, phase, {middle - 3.14, middle + 3.14});
    }
    CommandModel model = sure_to(unbounded_model(nominal, robot), 1e-6);
    truth.sensor_from_base = model.robot.sensor_from_base;
    model.measured = ranges;
    for (int i = 0; i < 20; ++i) {
      const Stop stop(regular_joints(stream, nominal.chain));
      Target target;
      target.joints.resize(6);
      const CorrectedTarget corrected = correct_target(target, model, stop);
      const auto error_m = [&](const JointVector& command) {
        return (truth.predict(stop.with_joints(command), "").translation() - corrected.nominal_tool.translation())
            .norm();
      };
      const double before_m = error_m(stop.joints), after_m = error_m(corrected.command);
      if (widening_at(model, stop).factor == 1.0) {
        EXPECT_LT(after_m, 1e-5);
        continue;
      }
      ++outside;
      held += after_m <= *corrected.error95_m ? 1 : 0;
      worse += after_m > before_m + 1e-5 ? 1 : 0;
      helped += after_m < 0.5 * before_m ? 1 : 0;
    }
  }
  EXPECT_GT(outside, 400);
  EXPECT_GE(held, 0.95 * outside);
  EXPECT_LE(worse, 0.05 * outside);
  EXPECT_GE(helped, 0.1 * outside);
}

TEST(Correction, ThatIsNotDeterminedCountsAsNone) {
  RandomStream stream{7514};
  const Robot nominal = elbow_arm(stream);
  const CommandModel model = sure_to(erring_model(stream, nominal), 1.0);
  CorrectedProgram corrected;
  for (const bool determined : {true, false, false}) {
    Target target;
    target.joints.resize(6);
    corrected.program.targets.push_back(target);
    const Stop stop(regular_joints(stream, nominal.chain));
    corrected.targets.push_back(correct_target(target, determined ? sure_to(model, 1e-7) : model, stop));
    if (!determined) corrected.targets.back().command = corrected.targets.back().nominal;
  }
  ASSERT_TRUE(corrected.targets[1].is_as_programmed());
  ASSERT_FALSE(corrected.targets[1].left.empty());
  const MovedFigures figures = moved_figures(corrected);
  EXPECT_EQ(figures.targets, 1);
  EXPECT_EQ(figures.undetermined, 2);
  const std::string table = summary_table(corrected, nominal.chain), json = summary_json(corrected, nominal.chain);
  EXPECT_NE(table.find("1 target corrected"), std::string::npos) << table;
  EXPECT_NE(table.find("2 left as programmed, since the calibration does not determine"), std::string::npos) << table;
  EXPECT_NE(json.find("\"corrected_by_model\":false"), std::string::npos) << json;
  EXPECT_NE(json.find("\"left\":2"), std::string::npos) << json;
}

TEST(Correction, SaysWhereRadiiComeFromFittedPoses) {
  RandomStream stream{7513};
  const Robot nominal = elbow_arm(stream);
  CommandModel model = sure_to(erring_model(stream, nominal), 1e-7);
  Program program;
  program.targets.resize(1);
  const auto says = [&] {
    for (const std::string& sentence : warnings_of(program, model, {}))
      if (sentence.find("no validation poses") != std::string::npos) return true;
    return false;
  };
  EXPECT_FALSE(says());
  model.interval->fitted = true;
  EXPECT_TRUE(says());
}

}  // namespace
}  // namespace demecal

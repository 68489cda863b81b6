// Corrections stay in the model only where validation poses say that they should.
#include "calibration/selection.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "calibration/admissible.hpp"
#include "calibration/calibration.hpp"
#include "erring_arm.hpp"
#include "prediction/measurement.hpp"

namespace demecal {
namespace {

/// Candidates of a joint, by their texts in rad.
JointCandidates candidates(std::uint32_t joint, const std::vector<std::string>& texts) {
  JointCandidates result;
  result.training.joint = joint;
  result.training.range_rad = {-M_PI, M_PI};
  result.training.table.target = {0.002};  // the largest error that was seen: 2 mrad
  result.training.table.weight = {1.0};
  for (const std::string& text : texts) result.front.push_back({parse(text), 0.0});
  return result;
}

TEST(Selection, KeepsTheTrueErrorsAndLeavesTheRestNeutral) {
  const DataSet data =
      measure(true_puma({"", "0.001*SIN(theta)", "0.0012*COS(theta)", "", "", ""}), 90, 5e-5, 1, false);
  const std::vector<std::size_t> selecting = poses_of(data, PoseSet::validation);
  const CorrectedRobot nominal = nominal_robot(data);
  const std::vector<JointCandidates> joints{candidates(0, {"0.0005*COS(theta)", "0.0001*theta"}),
                                            candidates(1, {"0.0003", "0.001*SIN(theta)"}),
                                            candidates(2, {"0.0012*COS(theta)", "0.002*theta"})};
  const Selection selection =
      select_corrections(data, poses_of(data, PoseSet::calibration), selecting, nominal, joints);
  EXPECT_FALSE(selection.choices[0].kept);
  EXPECT_TRUE(selection.choices[1].kept);
  EXPECT_TRUE(selection.choices[2].kept);
  EXPECT_TRUE(selection.robot.corrections[0].is_neutral());
  EXPECT_LT(error_figures(selection.robot, data, selecting).rms_mm, 0.12);
}

TEST(Selection, TakesTheShorterOfTwoThatDoEquallyWell) {
  const DataSet data = measure(true_puma({"", "0.001*SIN(theta)", "", "", "", ""}), 90, 5e-5, 2, false);
  const std::vector<JointCandidates> joints{candidates(1, {"0.001*SIN(theta)", "0.001*SIN(theta)+0.000000001*theta"})};
  const Selection selection = select_corrections(data, poses_of(data, PoseSet::calibration),
                                                 poses_of(data, PoseSet::validation), nominal_robot(data), joints);
  EXPECT_EQ(selection.robot.corrections[1].formula(),
            apply(Primitive::multiply, constant_tree(1.0), joints[0].front[0].tree));
}

TEST(Selection, NeverMakesTheDecidingPosesWorse) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, 1e-4, seed, false);
    const std::vector<std::size_t> selecting = poses_of(data, PoseSet::validation);
    const CorrectedRobot nominal = nominal_robot(data);
    std::vector<JointCandidates> joints;
    for (std::uint32_t joint = 0; joint < 6; ++joint) {
      joints.push_back(candidates(joint, {"0.00002*SIN(theta)", "0.00003*COS(3*theta)", "0-0.00002*SIN(theta)"}));
    }
    const Selection selection =
        select_corrections(data, poses_of(data, PoseSet::calibration), selecting, nominal, joints);
    EXPECT_LE(error_figures(selection.robot, data, selecting).rms_mm, error_figures(nominal, data, selecting).rms_mm);
  }
}

TEST(Selection, DropsCandidatesWithoutFiniteValues) {
  const DataSet data = measure(true_puma({"", "0.001", "", "", "", ""}), 30, 5e-5, 3, false);
  JointCandidates joint = candidates(1, {"0.001"});
  Tree overflowing = constant_tree(1e308);
  overflowing = apply(Primitive::multiply, overflowing, overflowing);
  joint.front.insert(joint.front.begin(), {overflowing, 0.0});
  const Selection selection = select_corrections(data, poses_of(data, PoseSet::calibration),
                                                 poses_of(data, PoseSet::validation), nominal_robot(data), {&joint, 1});
  EXPECT_TRUE(selection.choices[0].kept);
  EXPECT_NEAR(selection.robot.corrections[1](0.5), 0.001, 1e-12);
}

TEST(Selection, DoesNotConsiderACandidateWithAPoleInTheRange) {
  const DataSet data = measure(true_puma({"", "0.001*SIN(theta)", "", "", "", ""}), 30, 5e-5, 4, false);
  // Nowhere near the pole are there any poses to see it: it does as well as the other one.
  const std::vector<JointCandidates> joints{candidates(1, {"0.001*SIN(theta)+0.000000000001%(theta-2.9)"})};
  const Selection selection = select_corrections(data, poses_of(data, PoseSet::calibration),
                                                 poses_of(data, PoseSet::validation), nominal_robot(data), joints);
  EXPECT_FALSE(selection.choices[0].kept);
}

TEST(Selection, DoesNotConsiderACandidateThatJumpsMoreThanFourTimes) {
  for (const auto& [formula, is_considered] :
       {std::pair{"0.001*SIGN(theta+0.5)", true}, std::pair{"0.001*SIGN(SIN(20*theta))", false}}) {
    const DataSet data = measure(true_puma({"", formula, "", "", "", ""}), 60, 5e-5, 8, false);
    const std::vector<JointCandidates> joints{candidates(1, {formula})};
    const Selection selection = select_corrections(data, poses_of(data, PoseSet::calibration),
                                                   poses_of(data, PoseSet::validation), nominal_robot(data), joints);
    EXPECT_EQ(selection.choices[0].kept, is_considered) << formula;
  }
}

TEST(Selection, CorrectionsFromElsewhereCompeteAndBelongTogether) {
  const DataSet data =
      measure(true_puma({"", "0.001*SIN(theta)", "0.0012*COS(theta)", "", "", ""}), 90, 5e-5, 5, false);
  std::vector<JointCandidates> joints{candidates(1, {"0.0003"}), candidates(2, {"0.002*theta"})};
  const Interval range{-M_PI, M_PI};
  joints[0].alternatives = {JointCorrection(parse("0.001*SIN(theta)"), {}, range), JointCorrection{}};
  joints[1].alternatives = {JointCorrection(parse("0.0012*COS(theta)"), {}, range), JointCorrection{}};
  const Selection selection = select_corrections(data, poses_of(data, PoseSet::calibration),
                                                 poses_of(data, PoseSet::validation), nominal_robot(data), joints);
  EXPECT_EQ(selection.robot.corrections[1].formula(), joints[0].alternatives[0].formula());
  EXPECT_EQ(selection.robot.corrections[2].formula(), joints[1].alternatives[0].formula());
  EXPECT_EQ(selection.choices[0].candidates, 3U);
}

TEST(NegligibleCorrections, AreTermsBelowAMicroradian) {
  const DataSet data = measure(true_puma({"", "", "", "", "", ""}), 20, 5e-5, 1, false);
  CorrectedRobot robot = nominal_robot(data);
  const auto kept = [&](const char* text) {
    robot.corrections[1] = {parse(text), {}, {-1.0, 2.0}};
    return without_negligible_corrections(data, robot).corrections[1];
  };
  EXPECT_EQ(kept("4e-7 * theta + 0.001 * SIN(theta) - 9e-7").formula(), parse("0.001 * SIN(theta)"));
  EXPECT_EQ(kept("0.001 * SIN(theta) - 6e-7 * theta").formula(), parse("0.001 * SIN(theta) - 6e-7 * theta"));
  EXPECT_EQ(kept("5e-7 - 0.001 * theta").formula(), parse("(-1) * (0.001 * theta)"));
  EXPECT_TRUE(kept("5e-7 - 4e-7 * theta").is_neutral());
  const Tree wave = parse("0.001 * SIN(theta)");
  EXPECT_EQ(kept("0.001 * SIN(theta) + 5e-7 * (1 + 300 * theta - 300 * theta)").formula(), wave)
      << "half a microradian, which intervals tell only in short pieces of the range";
  EXPECT_NE(kept("0.001 * SIN(theta) + 1e-10 % (theta - 0.4)").formula(), wave) << "a pole is not small";
}

TEST(GrossErrors, AreLeftOutOfTheSetTheyAreIn) {
  DataSet data = measure(true_puma({"", "0.001", "", "", "", ""}), 90, 5e-5, 6, false);
  const CorrectedRobot nominal = nominal_robot(data);
  const std::vector<std::size_t> calibrating = poses_of(data, PoseSet::calibration);
  EXPECT_EQ(without_gross_errors(data, PoseSet::calibration, nominal), calibrating);
  data.poses[2].position_m->x() += 1.0;
  data.poses[5].position_m->z() -= 0.05;
  EXPECT_EQ(without_gross_errors(data, PoseSet::calibration, nominal), calibrating);
  std::vector<std::size_t> validating = poses_of(data, PoseSet::validation);
  validating.erase(validating.begin(), validating.begin() + 2);
  EXPECT_EQ(without_gross_errors(data, PoseSet::validation, nominal), validating);
  EXPECT_EQ(selection_poses(data, nominal), validating);
}

TEST(GrossErrors, DoNotDecideWhichCorrectionIsKept) {
  DataSet data = measure(true_puma({"", "0.001*SIN(theta)", "", "", "", ""}), 90, 5e-5, 7, false);
  const CorrectedRobot nominal = nominal_robot(data);
  const std::vector<JointCandidates> joints{candidates(1, {"0.001*SIN(theta)", "0.001*COS(7*theta)"})};
  const auto kept = [&] {
    return select_corrections(data, without_gross_errors(data, PoseSet::calibration, nominal),
                              selection_poses(data, nominal), nominal, joints)
        .robot.corrections[1];
  };
  const JointCorrection without = kept();
  EXPECT_FALSE(without.is_neutral());
  for (const std::size_t wrong : {std::size_t{0}, std::size_t{2}}) data.poses[wrong].position_m->y() += 2.0;
  EXPECT_EQ(kept().formula(), without.formula());
  const Selection by_all = select_corrections(data, poses_of(data, PoseSet::calibration),
                                              poses_of(data, PoseSet::validation), nominal, joints);
  EXPECT_TRUE(by_all.robot.corrections[1].is_neutral()) << "two poses alone decide";
}

CorrectedRobot model_of(const DataSet& data) {
  CorrectedRobot robot = nominal_robot(data);
  robot.effects = {{.kind = "gain", .joint = 1, .values = {3e-4}},
                   {.kind = "eccentricity", .joint = 2, .settings = {{"order", 1.0}}, .values = {1e-3, -5e-4}}};
  robot.corrections[0] = {parse("0.001*SIN(theta)"), {}, {-2.0, 2.0}};
  return robot;
}

TEST(PoseEvaluator, FindsTheModelsErrors) {
  const DataSet data = measure(true_puma({"", "0.001", "", "", "", ""}), 30, 1e-4, 1, false);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::validation);
  const CorrectedRobot robot = model_of(data);
  const SquaredErrors errors = PoseEvaluator(data, poses, robot).squared_errors(robot);
  ASSERT_EQ(errors.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(std::sqrt(errors[i]), 1e3 * tool_error_m(robot, data, data.poses[poses[i]]), 1e-9);
  }
}

TEST(PoseEvaluator, TriesACorrectionAsIfItWereInTheModel) {
  const DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, 1e-4, 2, false);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  CorrectedRobot robot = model_of(data);
  const PoseEvaluator evaluator(data, poses, robot);
  const JointCorrection correction(parse("0.002*COS(theta)"), {}, {-2.0, 3.0});
  const SquaredErrors tried =
      evaluator.squared_errors(robot, evaluator.with(evaluator.corrected(robot), 3, correction));
  robot.corrections[3] = correction;
  EXPECT_EQ(tried, evaluator.squared_errors(robot));
}

TEST(PoseEvaluator, LeavesOutPosesWithoutAPosition) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, 1e-4, 3, true);
  for (std::size_t i = 0; i < data.poses.size(); i += 2) data.poses[i].position_m.reset();
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot robot = nominal_robot(data);
  const SquaredErrors errors = PoseEvaluator(data, poses, robot).squared_errors(robot);
  EXPECT_EQ(errors.size(), poses.size() / 2);
  EXPECT_TRUE(std::isfinite(sum(errors)));
}

}  // namespace
}  // namespace demecal

// What is warned about, and what is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "kinematics/units.hpp"
#include "languages/written_program.hpp"
#include "programs/correct_program.hpp"
#include "programs/nominal_joints.hpp"
#include "programs/summary.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Wrong by a wave in joint 2 alone, measured from -1 to 1 rad.
CommandModel wave_model(double bound_rad) {
  RandomStream stream{7501};
  Robot nominal = elbow_arm(stream);
  for (Joint& joint : nominal.chain.joints) {
    joint.lower = -2.5;
    joint.upper = 2.5;
  }
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(6, {});
  identified.corrections[1] = {wave(2e-3, 1.0, 1.5), {}, {-1.0, 1.0}};
  identified.described = nominal;
  std::vector<double> bounds(6, std::numeric_limits<double>::infinity());
  bounds[1] = bound_rad;
  return command_model(nominal, identified, bounds);
}

CorrectedProgram corrected_joints(const CommandModel& model, const JointVector& joints) {
  const std::string text = joints_line(WrittenIn::urscript, joints, 1, 9);
  return correct_program(text, read_program(WrittenIn::urscript, text, "p.script", model.nominal.chain), model, {});
}

JointVector joints_with(double second, double third) {
  JointVector joints(6);
  joints << 0.3, second, third, 0.2, 0.9, -0.4;
  return joints;
}

TEST(Concerns, AreNoneWithinLimitsRangeAndBound) {
  EXPECT_TRUE(corrected_joints(wave_model(2e-3), joints_with(0.5, 0.2)).warnings.empty());
}

TEST(Concerns, NameTheJointBeyondTheCalibratedRange) {
  const CorrectedProgram corrected = corrected_joints(wave_model(2e-3), joints_with(1.1, 0.2));
  ASSERT_EQ(corrected.warnings.size(), 1u);
  EXPECT_THAT(corrected.warnings[0].sentence,
              HasSubstr("joint 2 is sent to 63.0254 deg, outside the calibrated range"));
  EXPECT_EQ(warning_text(corrected, corrected.warnings[0]).substr(0, 11), "p.script:1:");
}

TEST(Concerns, NameTheJointInsideAStretchWithoutMeasurements) {
  CommandModel model = wave_model(2e-3);
  model.measured.assign(6, Interval{-1.5, 1.5});
  model.gaps = {{1, {{0.3, 0.8}}}};
  model.posterior = Posterior{{{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta}},
                              {},
                              Eigen::MatrixXd::Constant(1, 1, 1e-5)};
  model.interval = PredictionInterval{.quantile = 1.6};
  const CorrectedProgram inside = corrected_joints(model, joints_with(0.55, 0.2));
  ASSERT_EQ(inside.warnings.size(), 1u);
  EXPECT_THAT(inside.warnings[0].sentence,
              HasSubstr("joint 2 is sent to 31.5127 deg, inside a stretch without any measured pose, 17.1887 deg .. "));
  const double widened_m = *inside.targets[0].error95_m;
  model.gaps.clear();
  const CorrectedProgram known = corrected_joints(model, joints_with(0.55, 0.2));
  EXPECT_TRUE(known.warnings.empty());
  EXPECT_NEAR(widened_m / *known.targets[0].error95_m, 1.0 + 2.0 * 0.25 / 3.0, 1e-6);
}

TEST(Concerns, LeaveLinesThatWouldCarryWhatNoArmCarries) {
  CommandModel model = wave_model(2e-3);
  model.nominal.masses.clear();
  const std::string text = joints_line(WrittenIn::urscript, joints_with(0.5, 0.2), 1, 9);
  const auto corrected = [&](double payload_kg) {
    const Program program = read_program(WrittenIn::urscript, text, "p.script", model.nominal.chain);
    return correct_program(text, program, model, {.payload_kg = payload_kg});
  };
  const CorrectedProgram far = corrected(5000.0);
  EXPECT_EQ(far.text, text);
  ASSERT_EQ(far.warnings.size(), 1u);
  EXPECT_THAT(far.warnings[0].sentence, HasSubstr("it would carry 5000 kg, more than any robot carries (2300 kg)"));
  EXPECT_NE(corrected(2000.0).text, text);
  EXPECT_THAT(corrected(2000.0).warnings, IsEmpty());
}

TEST(Concerns, SayWhatEffectsDependOnAndNobodyStates) {
  CommandModel model = wave_model(2e-3);
  model.robot.effects = {
      {.kind = "thermal_offset",
       .joint = 2,
       .settings = {{"reference_celsius", 20.0}},
       .form = {},
       .formula = {},
       .values = {1e-5}},
      {.kind = "compliance", .joint = 1, .settings = {}, .form = "payload", .formula = {}, .values = {1e-6}}};
  const std::string text = joints_line(WrittenIn::urscript, joints_with(0.5, 0.2), 1, 9);
  const auto sentences = [&](const Circumstances& given) {
    const Program program = read_program(WrittenIn::urscript, text, "p.script", model.nominal.chain);
    std::vector<std::string> all;
    for (const Remark& warning : correct_program(text, program, model, given).warnings) all.push_back(warning.sentence);
    return all;
  };
  EXPECT_THAT(
      sentences({}),
      ElementsAre("compliance of joint 2 depends on the payload, which the program does not state: an empty hand "
                  "is taken; --payload-kg tells it",
                  "thermal_offset of joint 3 depends on the temperature, which the program does not state: the "
                  "effect's reference is taken; --temperature-celsius tells it"));
  EXPECT_THAT(sentences({.payload_kg = 0.0, .temperature_celsius = 30.0}), IsEmpty());
}

TEST(Concerns, SayThatKnownMassesTakeThePayloadWhereTheArmWasCalibratedWithOne) {
  CommandModel model = wave_model(2e-3);
  model.robot.effects = {
      {.kind = "compliance", .joint = 1, .settings = {}, .form = "masses", .formula = {}, .values = {1e-6}}};
  const auto is_told = [&] {
    const auto all = corrected_joints(model, joints_with(0.5, 0.2)).warnings;
    return std::ranges::any_of(all, [](const Remark& one) {
      return one.sentence.starts_with("compliance of joint 2 depends on the payload, which the program does not state");
    });
  };
  EXPECT_FALSE(is_told());
  model.robot.payloads_kg = Interval{0.0, 0.0};
  EXPECT_FALSE(is_told());
  model.robot.payloads_kg = Interval{0.0, 6.0};
  EXPECT_TRUE(is_told());
}

TEST(Concerns, SayWhichEffectsAreNotToBeBelieved) {
  const auto are_told = [](const Effect& effect) {
    CommandModel model = wave_model(2e-3);
    model.robot.effects = {effect};
    const CorrectedProgram corrected = corrected_joints(model, joints_with(0.5, 0.2));
    return std::ranges::any_of(corrected.warnings, [](const Remark& warning) {
      return warning.sentence.find("of joint 2: The joint stops beyond where it is sent") != std::string::npos;
    });
  };
  const auto backlash = [](double width, const std::string& form) {
    Effect effect{.kind = "backlash", .joint = 1, .settings = {}, .form = form, .formula = {}, .values = {width}};
    if (form == "coupled") effect.settings["from"] = 1.0;
    return effect;
  };
  EXPECT_TRUE(are_told(backlash(-4e-4, "approach")));
  EXPECT_FALSE(are_told(backlash(4e-4, "approach")));
  for (const double width : {-4e-4, 4e-4}) EXPECT_FALSE(are_told(backlash(width, "coupled")));
  const auto hysteresis = [](double friction, double per_nm) {
    return Effect{
        .kind = "hysteresis", .joint = 1, .settings = {}, .form = {}, .formula = {}, .values = {friction, per_nm}};
  };
  EXPECT_TRUE(are_told(hysteresis(-1e-5, 0.0)));
  EXPECT_FALSE(are_told(hysteresis(-1e-6, 1e-6)));
  EXPECT_FALSE(are_told(hysteresis(1e-5, 1e-6)));
}

TEST(Concerns, NameTheJointBeyondItsLimits) {
  const CorrectedProgram corrected = corrected_joints(wave_model(2e-3), joints_with(0.5, 2.6));
  ASSERT_EQ(corrected.warnings.size(), 1u);
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("joint 3 is sent to 148.9690 deg, outside its limits"));
}

TEST(Concerns, NameACorrectionLargerThanStated) {
  const CorrectedProgram corrected = corrected_joints(wave_model(1e-4), joints_with(0.1, 0.2));
  ASSERT_EQ(corrected.warnings.size(), 1u);
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("correction of joint 2"));
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("larger than the bound that the model states, 0.0057 deg"));
}

TEST(Concerns, NamePosesOutOfReachAndLeaveThem) {
  const CommandModel model = wave_model(2e-3);
  const std::string text = "movel(p[9, 0, 0, 0, 0, 0])\nmovel(p[0.5, 0.4, 0.2, 0, 0, 0])";
  const Eigen::Isometry3d second(Eigen::Translation3d(0.5, 0.4, 0.2));
  const JointVector near = *nominal_joints(model.nominal.chain, second, {}, JointVector::Zero(6));
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::urscript, text, "p", model.nominal.chain), model, {.near = near});
  ASSERT_FALSE(corrected.warnings.empty());
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("does not reach the pose"));
  EXPECT_EQ(corrected.text.substr(0, 27), text.substr(0, 27));
  EXPECT_NE(corrected.text, text);
  EXPECT_EQ(moved_figures(corrected).uncorrected, 1);
}

/// The one warning about a model whose tool is moved so, and that nothing is corrected for it.
std::string only_warning(const Eigen::Isometry3d& tool) {
  RandomStream stream{7502};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(6, {});
  identified.tools[""] = identified.tools[""] * tool;
  const CorrectedProgram corrected = corrected_joints(unbounded_model(nominal, identified), joints_with(0.5, 0.2));
  EXPECT_EQ(corrected.targets[0].command, corrected.targets[0].nominal);
  return corrected.warnings.size() == 1 ? corrected.warnings[0].sentence : "";
}

TEST(Concerns, NameAToolThatIsAnother) {
  EXPECT_THAT(only_warning(Eigen::Isometry3d(Eigen::Translation3d(0.05, 0.0, 0.0))), HasSubstr("50 mm"));
  const Eigen::AngleAxisd mounted(0.5, Eigen::Vector3d::UnitY());
  EXPECT_THAT(only_warning(Eigen::Isometry3d(mounted)), HasSubstr("turned by 29 deg"));
}

TEST(Concerns, DoNotLayTheApproachAtAFormulasDoor) {
  CommandModel model = wave_model(2.1e-3);
  model.robot.effects = {{.kind = "backlash", .joint = 1, .values = {0.002}}};
  const std::string text = joints_line(WrittenIn::urscript, joints_with(0.4, 0.2), 1, 9) + '\n' +
                           joints_line(WrittenIn::urscript, joints_with(0.05, 0.3), 2, 9);
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::urscript, text, "p", model.nominal.chain), model, {});
  EXPECT_GT(std::abs(corrected.targets[1].command[1] - corrected.targets[1].nominal[1]), 2.2e-3);
  ASSERT_EQ(corrected.warnings.size(), 1u);
  EXPECT_THAT(corrected.warnings[0].sentence,
              HasSubstr("the side that the arm comes from to the targets of line 1 is"));
}

TEST(Summary, ShowsNominalCorrectedAndDifference) {
  const CommandModel model = wave_model(2e-3);
  const CorrectedProgram corrected = corrected_joints(model, joints_with(0.5, 0.2));
  const double change_deg = degrees(corrected.targets[0].command[1] - 0.5);
  const std::string table = summary_table(corrected, model.nominal.chain);
  EXPECT_THAT(table, HasSubstr("28.6479"));
  EXPECT_THAT(table, HasSubstr(listed({&change_deg, 1}, 4)));
  EXPECT_THAT(table, HasSubstr("1 target corrected"));
  const std::string json = summary_json(corrected, model.nominal.chain);
  EXPECT_EQ(std::count(json.begin(), json.end(), '\n'), 1);
  EXPECT_THAT(json, HasSubstr("\"nominal\":[17.188"));
}

TEST(Summary, SaysInBothFormsHowJointsAreTakenToCount) {
  const CommandModel model = wave_model(2e-3);
  CorrectedProgram corrected = corrected_joints(model, joints_with(0.5, 0.2));
  const std::string none = summary_json(corrected, model.nominal.chain);
  EXPECT_THAT(none, HasSubstr("\"notes\":[]"));
  corrected.program.joint_counting = "Joint 3 counts from the ground.";
  EXPECT_THAT(summary_json(corrected, model.nominal.chain),
              HasSubstr("\"notes\":[\"Joint 3 counts from the ground.\"]"));
  EXPECT_THAT(summary_table(corrected, model.nominal.chain), HasSubstr("at most\nJoint 3 counts from the ground.\n"));
}

TEST(Summary, SaysWhereTheBaseIsThatPosesAreCountedFrom) {
  const CommandModel model = wave_model(2e-3);
  Chain arm = model.nominal.chain;
  const auto table = [&](const std::string& text) {
    const CorrectedProgram corrected =
        correct_program(text, read_program(WrittenIn::urscript, text, "p", arm), model, {});
    return summary_table(corrected, arm);
  };
  const auto height_mm = [&] {
    const Eigen::Isometry3d tool =
        forward(model.nominal.chain, joints_with(0.5, 0.2)) * Eigen::Translation3d(model.nominal.chain.tool_m);
    const std::string said = table(joints_line(WrittenIn::urscript, joints_with(0.5, 0.2), 1, 9) + '\n' +
                                   pose_line(WrittenIn::urscript, tool, joints_with(0.5, 0.2), 2, 9));
    const std::string words = "axis 2 is at z = ";
    const std::size_t at = said.find(words);
    return at == std::string::npos ? -1e9 : std::stod(said.substr(at + words.size()));
  };
  const double before_mm = height_mm();
  arm.base.translation().z() += 0.33;
  EXPECT_NEAR(height_mm() - before_mm, 330.0, 0.11);
  EXPECT_EQ(table(joints_line(WrittenIn::urscript, joints_with(0.5, 0.2), 1, 9)).find("axis 2"), std::string::npos);
}

TEST(Approach, IsThatOfTheJointsLastMotion) {
  RandomStream stream{7503};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(6, {});
  identified.effects = {{.kind = "backlash", .joint = 1, .values = {0.002}}};
  const CommandModel model = unbounded_model(nominal, identified);
  std::string text;
  for (const double second : {0.5, 0.6, 0.6, 0.4, 0.401}) {
    text += joints_line(WrittenIn::urscript, joints_with(second, 0.2), 1, 9) + '\n';
  }
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::urscript, text, "p", model.nominal.chain), model, {});
  std::vector<double> changes;
  for (const CorrectedTarget& target : corrected.targets) changes.push_back(target.command[1] - target.nominal[1]);
  // Half of the lost motion, to the side that the joint comes from; nothing is known of the first, nor of the last,
  // which turns back by less than is lost.
  const std::vector<double> expected{0.0, 0.001, 0.001, -0.001, 0.0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(changes[i], expected[i], 1e-9) << i;
}

}  // namespace
}  // namespace demecal

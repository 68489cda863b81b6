// Statements that set the payload: where a model depends on it, they are named instead of missed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "corrected_arm.hpp"
#include "languages/named_languages.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

CommandModel compliant_model() {
  RandomStream stream{7581};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(nominal.chain.joints.size(), {});
  identified.effects = {
      {.kind = "compliance", .joint = 1, .settings = {}, .form = "payload", .formula = {}, .values = {1e-6}}};
  return unbounded_model(nominal, identified);
}

/// What is said of the whole program.
std::string said_of_all(WrittenIn language, const std::string& text, const Circumstances& circumstances) {
  const CommandModel model = compliant_model();
  std::string said;
  for (const Remark& warning :
       correct_program(text, read_program(language, text, "p", model.nominal.chain), model, circumstances).warnings)
    if (warning.place.line == 0) said += warning.sentence + '\n';
  return said;
}

/// Programs with such statements in lines 3 and 5.
const std::map<WrittenIn, std::string> kSetting{
    {WrittenIn::fanuc_ls,
     "/PROG  T\n/MN\n   1:  PAYLOAD[3] ;\n   2:!PAYLOAD[1] ;\n   3:  PAYLOAD[R[1]] ;\n/POS\n/END\n"},
    {WrittenIn::krl, "DEF m()\n;$LOAD=a\n$LOAD = LOAD_DATA[1]\n$LOADS=1\n$LOAD.M=6\nEND\n"},
    {WrittenIn::urscript,
     "def f():\n# set_payload(1)\n set_payload(6.0, [0,0,0.1])\n x=1\n set_payload_mass (2)\nend\n"},
    {WrittenIn::rapid, "MODULE M\nPROC main()\nGripLoad load0;\n!GripLoad p;\nGRIPLOAD p;\nENDPROC\nENDMODULE\n"},
    {WrittenIn::kawasaki_as, ".PROGRAM m()\n; WEIGHT 6\nWEIGHT 0\nWEIGHT = 5\nWEIGHT 6,0,0,100\n.END\n"}};

TEST(PayloadStatements, AreFoundWhereALineBeginsWithThem) {
  for (const auto& [language, text] : kSetting) {
    std::vector<std::size_t> lines;
    for (const TextPlace& place : read_program(language, text, "p", wrist_arm()).payload_set_at)
      lines.push_back(place.line);
    EXPECT_THAT(lines, ElementsAre(3, 5)) << text;
  }
}

TEST(PayloadStatements, AreNamedWhereTheModelDependsOnThem) {
  const std::string text = "def f():\n set_payload(0)\n movej([0.1,-0.7,0.5,0.3,0.9,0.2])\n set_payload(6.0)\nend\n";
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.temperature_celsius = 20.0}),
              AllOf(HasSubstr("the program sets in lines 2, 4;"), HasSubstr("an empty hand is taken"),
                    Not(HasSubstr("does not state"))));
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.payload_kg = 6.0, .temperature_celsius = 20.0}),
              HasSubstr("6 kg, of --payload-kg, is taken"));
}

TEST(PayloadStatements, ThatStandAloneAreWhatTheUserTells) {
  const std::string text = "def f():\n set_payload(6.0)\n movej([0.1,-0.7,0.5,0.3,0.9,0.2])\nend\n";
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.payload_kg = 6.0, .temperature_celsius = 20.0}),
              Not(HasSubstr("payload")));
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.temperature_celsius = 20.0}),
              AllOf(HasSubstr("the program sets in line 2;"), HasSubstr("--payload-kg tells it")));
}

/// Compliant in joint 2, measured with 0 to 5 kg, and sure of itself.
CommandModel weighed_model() {
  RandomStream stream{7602};
  Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(6, {});
  identified.effects = {
      {.kind = "compliance", .joint = 1, .settings = {}, .form = "masses", .formula = {}, .values = {1e-6}}};
  identified.payloads_kg = Interval{0.0, 5.0};
  CommandModel model = unbounded_model(nominal, identified);
  model.posterior = Posterior{{{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta}},
                              {},
                              Eigen::MatrixXd::Constant(1, 1, 1e-5)};
  model.interval = PredictionInterval{.quantile = 1.6};
  return model;
}

CorrectedProgram carried_by(const CommandModel& model, std::optional<double> payload_kg,
                            std::optional<double> temperature_celsius = {}) {
  JointVector joints(6);
  joints << 0.3, -0.4, 0.6, 0.2, 0.9, -0.4;
  const std::string text = joints_line(WrittenIn::urscript, joints, 1, 9);
  return correct_program(text, read_program(WrittenIn::urscript, text, "p.script", model.nominal.chain), model,
                         {.payload_kg = payload_kg, .temperature_celsius = temperature_celsius});
}

TEST(UnstatedPayload, IsInTheRadiusAsFarAsTheArmWasMeasuredWith) {
  const CommandModel model = weighed_model();
  const CorrectedTarget untold = carried_by(model, {}).targets[0], empty = carried_by(model, 0.0).targets[0];
  ASSERT_EQ(untold.outcome, CorrectionOutcome::corrected);
  EXPECT_EQ(untold.command, empty.command);
  Stop carrying = empty.stop;
  const Eigen::Vector3d bare_m = model.robot.predict(carrying, "").translation();
  carrying.payload_kg = 5.0;
  const double given_by_m = (model.robot.predict(carrying, "").translation() - bare_m).norm();
  EXPECT_GT(given_by_m, 1e-5);
  EXPECT_NEAR(*untold.error95_m - *empty.error95_m, given_by_m, 1e-9);
}

TEST(Payload, BeyondWhatWasMeasuredWidensTheRadiusAndIsSaid) {
  const CommandModel model = weighed_model();
  const CorrectedProgram within = carried_by(model, 5.0), beyond = carried_by(model, 20.0);
  EXPECT_GT(*beyond.targets[0].error95_m, 5.0 * *within.targets[0].error95_m);
  const auto says = [](const CorrectedProgram& program) {
    return std::ranges::any_of(program.warnings, [](const Remark& one) {
      return one.sentence.starts_with("the payload of 20 kg is outside the 0 .. 5 kg that the arm was measured with");
    });
  };
  EXPECT_FALSE(says(within));
  EXPECT_TRUE(says(beyond));
}

/// The same arm, whose joint 3 moves with warmth, measured at 20 to 25 degrees.
CommandModel warmed_model() {
  CommandModel model = weighed_model();
  model.robot.effects.push_back({.kind = "thermal_offset",
                                 .joint = 2,
                                 .settings = {{"reference_celsius", 22.0}},
                                 .form = {},
                                 .formula = {},
                                 .values = {1e-5}});
  model.robot.temperatures_celsius = Interval{20.0, 25.0};
  return model;
}

TEST(UnstatedTemperature, IsInTheRadiusAsFarAsTheArmWasMeasuredAt) {
  const CommandModel model = warmed_model();
  const CorrectedTarget untold = carried_by(model, 0.0).targets[0], at = carried_by(model, 0.0, 22.0).targets[0];
  Stop warm = at.stop;
  warm.temperature_celsius = 25.0;
  const double given_by_m =
      (model.robot.predict(warm, "").translation() - model.robot.predict(at.stop, "").translation()).norm();
  EXPECT_GT(given_by_m, 1e-6);
  EXPECT_NEAR(*untold.error95_m - *at.error95_m, given_by_m, 1e-9);
  EXPECT_THAT(untold.widened_by, ElementsAre(HasSubstr("temperature not stated, measured 20 .. 25 °C")));
}

TEST(Temperature, BeyondWhatWasMeasuredWidensTheRadiusAndIsSaid) {
  const CommandModel model = warmed_model();
  const CorrectedProgram within = carried_by(model, 0.0, 25.0), beyond = carried_by(model, 0.0, 40.0);
  EXPECT_GT(*beyond.targets[0].error95_m, 3.0 * *within.targets[0].error95_m);
  EXPECT_THAT(beyond.targets[0].widened_by, ElementsAre("temperature at 40 °C, measured 20 .. 25 °C"));
  const auto says = [](const CorrectedProgram& program) {
    return std::ranges::any_of(program.warnings, [](const Remark& one) {
      return one.sentence.starts_with("the temperature of 40 °C is outside the 20 .. 25 °C that the arm was measured");
    });
  };
  EXPECT_FALSE(says(within));
  EXPECT_TRUE(says(beyond));
}

TEST(PathRemark, StandsAmongTheWarningsOfAProgram) {
  CommandModel model = weighed_model();
  const auto says = [&] {
    return std::ranges::any_of(carried_by(model, 0.0).warnings, [](const Remark& one) {
      return one.sentence.find("follow each other along a path") != std::string::npos;
    });
  };
  EXPECT_FALSE(says());
  model.interval->along_path = true;
  EXPECT_TRUE(says());
}

}  // namespace
}  // namespace demecal

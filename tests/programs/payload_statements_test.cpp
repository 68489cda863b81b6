// Statements that set the payload: where a model depends on it, they are named instead of missed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corrected_arm.hpp"
#include "languages/named_languages.hpp"
#include "languages/written_program.hpp"
#include "parsed_programs/payload_flow.hpp"

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
    for (const PayloadStatement& one : read_program(language, text, "p", wrist_arm()).payload_statements)
      lines.push_back(one.place.line);
    EXPECT_THAT(lines, ElementsAre(3, 5)) << text;
  }
}

TEST(PayloadStatements, AreReadWhereTheyHoldKilograms) {
  const std::map<WrittenIn, std::vector<std::optional<double>>> expected{{WrittenIn::fanuc_ls, {{}, {}}},
                                                                         {WrittenIn::krl, {{}, 6.0}},
                                                                         {WrittenIn::urscript, {6.0, 2.0}},
                                                                         {WrittenIn::rapid, {0.0, {}}},
                                                                         {WrittenIn::kawasaki_as, {0.0, 6.0}}};
  for (const auto& [language, text] : kSetting) {
    std::vector<std::optional<double>> kilograms;
    for (const PayloadStatement& one : read_program(language, text, "p", wrist_arm()).payload_statements)
      kilograms.push_back(one.kg);
    EXPECT_EQ(kilograms, expected.at(language)) << text;
  }
}

std::optional<double> first_kg(WrittenIn language, const std::string& text) {
  const std::vector<PayloadStatement> all = read_program(language, text, "p", wrist_arm()).payload_statements;
  return all.empty() ? std::nullopt : all.front().kg;
}

TEST(PayloadStatements, AreReadWithTheLoadsThatTheProgramDeclares) {
  const auto krl = [](const std::string& lines) { return first_kg(WrittenIn::krl, "DEF m()\n" + lines + "\nEND\n"); };
  EXPECT_EQ(krl("$LOAD = {M 4.5,CM {X 0.0,Y 0.0,Z 90.0,A 0.0,B 0.0,C 0.0}}"), 4.5);
  EXPECT_EQ(krl("LOAD_DATA[3]={M 12.0,CM {X 0,Y 0,Z 0}}\n$LOAD=LOAD_DATA[3]"), 12.0);
  EXPECT_EQ(krl("DECL LOAD part={M 3,CM {X 0,Y 0,Z 0}}\n$LOAD=part"), 3.0);
  EXPECT_EQ(krl("$LOAD={M -1.0,CM {X 0,Y 0,Z 0}}"), std::nullopt) << "the controller's own";
  EXPECT_EQ(krl("LOAD_DATA[3]={M 12.0}\nLOAD_DATA[3].M=2\n$LOAD=LOAD_DATA[3]"), std::nullopt) << "changed";
  EXPECT_EQ(krl("; LOAD_DATA[3]={M 12.0}\n$LOAD=LOAD_DATA[3]"), std::nullopt) << "a comment";
  EXPECT_EQ(krl("LOAD_DATA[3]={M 12.0}\n$LOAD=LOAD_DATA[n]"), std::nullopt) << "computed";
  EXPECT_EQ(krl("$LOAD.CM={X 0,Y 0,Z 5}"), std::nullopt);
  const std::string loads = "LOAD_DATA[1]={M 8.0,CM {X 0,Y 0,Z 0}}\nLOAD_DATA[2]={M 9.0}\n";
  EXPECT_EQ(krl(loads + "DECL FDAT FP1={TOOL_NO 2,BASE_NO 1,IPO_FRAME #BASE}\nFDAT_ACT=FP1"), 9.0);
  EXPECT_EQ(krl(loads + "FDAT_ACT=FP1"), std::nullopt) << "in a file that is not given";
  EXPECT_EQ(krl(loads + "BAS (#TOOL,1)"), 8.0);
  EXPECT_EQ(krl(loads + "BAS(#TOOL,0)"), std::nullopt) << "the controller's own";
  const auto rapid = [](const std::string& declared) {
    return first_kg(WrittenIn::rapid, "MODULE M\n" + declared + "\nPROC main()\nGripLoad part1;\nENDPROC\nENDMODULE\n");
  };
  EXPECT_EQ(rapid("PERS loaddata part1:=[5.5,[50,0,50],[1,0,0,0],0,0,0];"), 5.5);
  EXPECT_EQ(rapid("PERS loaddata part1 := [ 5.5 ,[50,0,50],[1,0,0,0],0,0,0];\nPROC f()\npart1:=load0;\nENDPROC"),
            std::nullopt);
  EXPECT_EQ(rapid("PERS loaddata part12:=[5.5,[50,0,50],[1,0,0,0],0,0,0];"), std::nullopt);
}

/// The payload of each target of the program, behind statements that are followed.
std::vector<std::optional<double>> payloads_in(WrittenIn language, const std::string& text) {
  std::vector<std::optional<double>> payloads;
  for (const Target& target : with_followed_payloads(read_program(language, text, "p", wrist_arm())).targets)
    payloads.push_back(target.payload_kg);
  return payloads;
}

TEST(PayloadStatements, AreFollowedOnAllWaysToATarget) {
  const std::string move = " movej([0.1,-0.7,0.5,0.3,0.9,0.2])\n";
  const auto ur = [&](const std::string& lines) { return payloads_in(WrittenIn::urscript, lines); };
  EXPECT_THAT(ur("def f():\n" + move + " set_payload(0)\n" + move + " set_payload(6.0)\n" + move + "end\n"),
              ElementsAre(std::nullopt, 0.0, 6.0));
  EXPECT_THAT(ur("def f():\n set_payload(2)\n if a:\n  set_payload(3)\n" + move + " end\n" + move + "end\n"),
              ElementsAre(3.0, std::nullopt))
      << "ways that differ meet";
  EXPECT_THAT(ur("def f():\n set_payload(2)\n if a:\n  set_payload(2)\n end\n" + move + "end\n"), ElementsAre(2.0));
  EXPECT_THAT(ur("def f():\n set_payload(2)\n while a:\n" + move + "  set_payload(3)\n" + move + " end\nend\n"),
              ElementsAre(std::nullopt, 3.0))
      << "a loop comes back with another";
  EXPECT_THAT(ur("def f():\n set_payload(2)\n" + move + " set_payload(m)\n" + move + "end\n"),
              ElementsAre(2.0, std::nullopt))
      << "computed";
}

TEST(PayloadStatements, AreFollowedIntoAndOutOfRoutines) {
  const std::string axes = "PTP {A1 10,A2 -70,A3 50,A4 20,A5 60,A6 10}\n";
  EXPECT_THAT(payloads_in(WrittenIn::krl, "DEF m()\n$LOAD={M 4}\nfetch()\n" + axes + "END\nDEF fetch()\n" + axes +
                                              "$LOAD={M 7}\n" + axes + "END\n"),
              ElementsAre(7.0, 4.0, 7.0));
  EXPECT_THAT(payloads_in(WrittenIn::krl, "DEF m()\n$LOAD={M 4}\nfetch()\n$LOAD={M 5}\nfetch()\n" + axes +
                                              "END\nDEF fetch()\n" + axes + "END\n"),
              ElementsAre(5.0, std::nullopt))
      << "called with two payloads";
  const std::string lsv = "/PROG  T\n/MN\n   1:J P[1] 20% FINE ;\n   2:  PAYLOAD[3] ;\n   3:J P[2] 20% FINE ;\n/POS\n";
  const auto position = [](const std::string& number) {
    return "P[" + number + "]{\n GP1:\n UF : 0, UT : 0,\n J1= 1 deg, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 50 deg, " +
           "J6= 6 deg\n};\n";
  };
  EXPECT_THAT(payloads_in(WrittenIn::fanuc_ls, lsv + position("1") + position("2") + "/END\n"),
              ElementsAre(std::nullopt, std::nullopt));
}

TEST(PayloadStatements, AreNamedWhereTheyDoNotTellAndTheModelDependsOnThem) {
  const std::string text =
      "def f():\n set_payload(0)\n movej([0.1,-0.7,0.5,0.3,0.9,0.2])\n set_payload(m)\n "
      "movej([0.2,-0.7,0.5,0.3,0.9,0.2])\nend\n";
  EXPECT_THAT(
      said_of_all(WrittenIn::urscript, text, {.temperature_celsius = 20.0}),
      AllOf(HasSubstr("the program sets in lines 2, 4; of 1 target it is not told (line 4 names it by a number"),
            HasSubstr("an empty hand is taken"), Not(HasSubstr("does not state"))));
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.payload_kg = 6.0, .temperature_celsius = 20.0}),
              HasSubstr("6 kg, of --payload-kg, is taken"));
}

TEST(PayloadStatements, CorrectTheLinesBehindThemForWhatTheyState) {
  const CommandModel model = compliant_model();
  const std::string move = " movej([0.1,-0.7,0.5,0.3,0.9,0.2])\n";
  const auto corrected = [&](const std::string& statement, std::optional<double> given) {
    const std::string text = "def f():\n" + statement + move + "end\n";
    return correct_program(text, read_program(WrittenIn::urscript, text, "p", model.nominal.chain), model,
                           {.payload_kg = given, .temperature_celsius = 20.0})
        .targets.front()
        .command;
  };
  EXPECT_EQ(corrected(" set_payload(6.0, [0,0,0.1])\n", {}), corrected("", 6.0));
  EXPECT_EQ(corrected(" set_payload(6.0)\n", 2.0), corrected("", 6.0)) << "what the program states comes first";
  EXPECT_NE(corrected("", 6.0), corrected("", 0.0));
  EXPECT_EQ(corrected(" set_payload(m)\n", 6.0), corrected("", 6.0));
  EXPECT_EQ(corrected(" set_payload(m)\n", {}), corrected("", {}));
}

TEST(PayloadStatements, ThatStandAloneAreWhatTheUserTells) {
  const std::string text = "def f():\n set_payload(6.0)\n movej([0.1,-0.7,0.5,0.3,0.9,0.2])\nend\n";
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.payload_kg = 6.0, .temperature_celsius = 20.0}),
              Not(HasSubstr("payload")));
  EXPECT_THAT(said_of_all(WrittenIn::urscript, text, {.temperature_celsius = 20.0}), Not(HasSubstr("payload")))
      << "it is read";
  const std::string index =
      "/PROG  T\n/MN\n   1:  PAYLOAD[3] ;\n   2:J P[1] 20% FINE ;\n/POS\nP[1]{\n GP1:\n UF : 0, "
      "UT : 0,\n J1= 1 deg, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 50 deg, J6= 6 deg\n};\n/END\n";
  EXPECT_THAT(said_of_all(WrittenIn::fanuc_ls, index, {.temperature_celsius = 20.0}),
              AllOf(HasSubstr("the program sets in line 3;"), HasSubstr("--payload-kg tells it")));
  EXPECT_THAT(said_of_all(WrittenIn::fanuc_ls, index, {.payload_kg = 6.0, .temperature_celsius = 20.0}),
              Not(HasSubstr("payload")));
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

// Poses of FANUC, Yaskawa and VAL3 programs that branch, jump and call are corrected by the joints before them in the
// text only where the arm is known to come from there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "judged_points.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Of a pose that other joints than those before it in the text, with the wrist turned over, would reach otherwise.
struct Arrival {
  bool known = false;  ///< whether it was corrected
  std::string said{};  ///< by the reader
};

Arrival arrival(WrittenIn language, const std::string& text, const std::string& name,
                const ControllerData& controller = {}) {
  RandomStream stream{7521};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const ProgramSource source(text, "p");
  const Program program = read_program(row_of(language), source, model.nominal.chain, controller);
  const CorrectedProgram corrected = correct_program(text, program, model, {.temperature_celsius = 20.0});
  Arrival found;
  for (std::size_t i = 0; i < corrected.targets.size(); ++i)
    found.known = found.known || (program.targets[i].name == name && !corrected.targets[i].is_uncorrected());
  for (const std::vector<Remark>* remarks : {&program.uncorrected, &program.remarks}) {
    for (const Remark& remark : *remarks) found.said += remark.sentence + '\n';
  }
  return found;
}

JointVector near_usual() {
  return usual_joints().array() + 0.1;
}

JointVector turned_over() {
  JointVector joints = usual_joints();
  joints[3] -= std::numbers::pi;
  joints[4] *= -1.0;
  joints[5] -= std::numbers::pi;
  return joints;
}

Arrival fanuc(const std::string& between, const std::string& behind = "") {
  const std::string pose = fanuc_position("2", " UT : 0,", {"X", "Y", "Z", "W", "P", "R"},
                                          six_numbers(flange_pose(), about_fixed_xyz(flange_pose())), 4);
  return arrival(WrittenIn::fanuc_ls,
                 "/MN\n 1:J P[1] 9% FINE ;\n" + between + " 8:J P[2] 9% FINE ;\n" + behind + "/POS\n" +
                     joints_line(WrittenIn::fanuc_ls, near_usual(), 1, 4) + '\n' + pose + '\n' +
                     joints_line(WrittenIn::fanuc_ls, turned_over(), 3, 4) + "\n/END\n",
                 "P[2]");
}

Arrival yaskawa(const std::string& between, const std::string& behind = "") {
  const auto pulses = [](int number, const JointVector& joints) {
    const std::vector<double> values = in_degrees(1e3 * joints);
    return 'C' + std::to_string(number) + '=' + listed(values, 0, ",") + '\n';
  };
  return arrival(WrittenIn::yaskawa_jbi,
                 "//POS\n///PULSE\n" + pulses(1, near_usual()) + pulses(3, turned_over()) +
                     "///POSTYPE BASE\n///RECTAN\n" +
                     pose_line(WrittenIn::yaskawa_jbi, tool_pose(), usual_joints(), 2, 4) +
                     "\n//INST\nNOP\nMOVJ C1 VJ=9\n" + between + "MOVJ C2 VJ=9\n" + behind + "END\n",
                 "C00002", {.pulses_per_deg = std::vector<double>(6, 1e3)});
}

Arrival val3(const std::string& between, const std::string& behind = "") {
  const auto data = [](const std::string& name, const std::string& type, const std::string& value) {
    return "<Data name=\"" + name + "\" type=\"" + type + "\">" + value + "</Data>\n";
  };
  const auto program = [](const std::string& name, const std::string& code) {
    return "<Program name=\"" + name + "\"><Code>begin\n" + code + "end</Code></Program>\n";
  };
  return arrival(WrittenIn::val3,
                 data("a", "jointRx", joints_line(WrittenIn::val3, near_usual(), 0, 4)) +
                     data("b", "pointRx", pose_line(WrittenIn::val3, flange_pose(), usual_joints(), 0, 4)) +
                     data("c", "jointRx", joints_line(WrittenIn::val3, turned_over(), 0, 4)) +
                     program("start", " movej(a,flange,m)\n" + between + " movej(b,flange,m)\n" + behind) +
                     program("goes", " movej(c,flange,m)\n") + program("waits", " delay(1)\n"),
                 "b[0]");
}

TEST(ArrivingPoints, OfFanucAreNotKnownBehindBranchesAndJumps) {
  const std::string move = " 3:J P[3] 9% FINE ;\n";
  for (const std::string& between :
       {" 2:IF (DI[1]=ON) THEN ;\n" + move + " 4:ENDIF ;\n", " 2:IF DI[1]=ON,JMP LBL[5] ;\n" + move + " 4:LBL[5] ;\n",
        " 2:IF (DI[1]) THEN ;\n" + move + " 4:ELSE ;\n 5:ENDIF ;\n", " 2:JMP LBL[R[1]] ;\n" + move + " 4:LBL[5:on] ;\n",
        " 2:SELECT R[1]=1,JMP LBL[5] ;\n" + move + " 4:LBL[5] ;\n",
        " 2:WAIT DI[1]=ON TIMEOUT,LBL[5] ;\n" + move + " 4:LBL[5] ;\n"})
    EXPECT_FALSE(fanuc(between).known) << between;
  EXPECT_FALSE(fanuc(" 4:LBL[5] ;\n", move + " 9:JMP LBL[5] ;\n").known) << "it comes back from the last";
}

TEST(ArrivingPoints, OfFanucAreKnownWhereTheWayIsStraight) {
  for (const char* between :
       {"", " 2:IF (DI[1]=ON) THEN ;\n 3:DO[1]=ON ;\n 4:ENDIF ;\n", " 2:LBL[5] ;\n", " 2:!JMP LBL[5] ;\n 3:LBL[5] ;\n",
        " 2:// CALL PICK ;\n", " 2:IF DI[1]=ON,JMP LBL[9] ;\n", " 2:UFRAME_NUM=0 ;\n"}) {
    const Arrival found = fanuc(between, " 9:LBL[9] ;\n");
    EXPECT_TRUE(found.known) << between;
    EXPECT_THAT(found.said, IsEmpty()) << between;
  }
}

TEST(ArrivingPoints, OfFanucAreBelievedThroughCallsWhichAreNamedOnce) {
  for (const char* between :
       {" 2:CALL PICK ;\n", " 2:PICK ;\n", " 2:  PICK(1,R[2]) ;\n 3:PICK ;\n",
        " 2:J P[1] 9% FINE TB .10sec,CALL PICK ;\n", " 2:IF DI[1]=ON,CALL PICK(1,2) ;\n 3:CALL PICK ;\n",
        " 2:SELECT R[1]=1,CALL PICK ;\n 3:       =2,CALL PICK ;\n"}) {
    const Arrival found = fanuc(between);
    EXPECT_TRUE(found.known) << between;
    EXPECT_THAT(found.said, AllOf(HasSubstr("PICK is not in the files given"), HasSubstr("the arm"))) << between;
    EXPECT_EQ(std::ranges::count(found.said, '\n'), 1) << found.said;
  }
  EXPECT_THAT(fanuc("", " 9:CALL PICK ;\n").said, IsEmpty()) << "no motion comes behind it";
}

TEST(ArrivingPoints, OfFanucAreKnownThroughInstructionsThatAreNoMacros) {
  for (const std::string instruction : {"DO[1]=ON",
                                        "RO[2:grip]=PULSE,0.5sec",
                                        "R[1]=R[1]+1",
                                        "PR[1]=LPOS",
                                        "$MCR.$GENOVERRIDE=50",
                                        "OVERRIDE=50%",
                                        "TIMER[1]=START",
                                        "WAIT   .50(sec)",
                                        "WAIT DI[1]=ON",
                                        "PAYLOAD[3]",
                                        "COL DETECT ON",
                                        "MESSAGE[PICK]",
                                        "UALM[1]",
                                        "Arc Start[1]",
                                        "Weave Sine[1]",
                                        "Weave End",
                                        "RUN TASK",
                                        "LOCK PREG",
                                        "MONITOR PICK",
                                        "PAUSE",
                                        "F[1]=(ON)",
                                        "JOINT_MAX_SPEED[1]=20",
                                        "--eg:PICK",
                                        "SR[1]='PICK'",
                                        "IF (R[1]=1),R[2]=(3)",
                                        "VISION RUN_FIND 'PICK'",
                                        ""}) {
    const Arrival found = fanuc(" 2:  " + instruction + " ;\n");
    EXPECT_TRUE(found.known) << instruction;
    EXPECT_THAT(found.said, IsEmpty()) << instruction;
  }
}

TEST(ArrivingPoints, OfYaskawaAreNotKnownBehindBranchesAndJumps) {
  const std::string move = "MOVJ C3 VJ=9\n";
  for (const std::string& between :
       {"JUMP *A IF IN#(1)=ON\n" + move + "*A\n", "IFTHEN IN#(1)=ON\n" + move + "ENDIF\n",
        "IFTHEN I000=1\n" + move + "ELSEIF I000=2\n" + move + "ELSE\nENDIF\n",
        "SWITCH I000\nCASE 1\n" + move + "DEFAULT\nENDSWITCH\n", "JUMP S000\n" + move + "*A\n",
        "IFTHENEXP B000=1\n" + move + "ENDIF\n", "IFTHENEXP B000=1\nELSEIFEXP B000=2\n" + move + "ELSE\nENDIF\n",
        "WHILEEXP IN#(1)=ON\n" + move + "ENDWHILE\n", "FOR I000=1 TO 3\n" + move + "NEXT I000\n",
        std::string("IFANY B000=1\n")})
    EXPECT_FALSE(yaskawa(between).known) << between;
  EXPECT_FALSE(yaskawa("*A\n", move + "JUMP *A\n").known) << "it comes back from the last";
}

TEST(ArrivingPoints, OfYaskawaAreKnownWhereTheWayIsStraight) {
  for (const char* between :
       {"", "IFTHEN IN#(1)=ON\nDOUT OT#(1) ON\nENDIF\n", "*B\n", "'JUMP *B\n*B\n", "JUMP *Z IF IN#(1)=ON\n",
        "JUMP JOB:ERROR IF IN#(1)=ON\n", "RET IF IN#(1)=ON\n", "SET B000 1\n", "TIMER T=1.00\n",
        "WAIT IN#(1)=ON T=2.0\n", "PULSE OT#(1) T=0.5\n", "ADD I000 1\n", "ARCON ASF#(1)\n", "MSG \"PICK\"\n",
        "PAUSE IF IN#(1)=ON\n", "IFTHENEXP B000=1\nINC I000\nELSEIFEXP B000=2\nELSE\nENDIF\n"}) {
    const Arrival found = yaskawa(between, "*Z\n");
    EXPECT_TRUE(found.known) << between;
    EXPECT_THAT(found.said, IsEmpty()) << between;
  }
}

TEST(ArrivingPoints, OfYaskawaAreBelievedThroughCallsWhichAreNamedOnce) {
  for (const char* between :
       {"CALL JOB:PICK\n", "CALL JOB:PICK IF IN#(1)=ON\nCALL JOB:PICK ARGF1\n", "PICK\n", "PICK ARGF1 ARGF2\n"}) {
    const Arrival found = yaskawa(between);
    EXPECT_TRUE(found.known) << between;
    EXPECT_THAT(found.said, AllOf(HasSubstr("PICK is not in the files given"), HasSubstr("the arm"))) << between;
    EXPECT_EQ(std::ranges::count(found.said, '\n'), 1) << found.said;
  }
  EXPECT_THAT(yaskawa("", "CALL JOB:PICK\n").said, IsEmpty()) << "no motion comes behind it";
}

TEST(ArrivingPoints, OfVal3AreNotKnownBehindBranchesAndCallsOfProgramsThatMove) {
  const std::string move = " movej(c,flange,m)\n";
  for (const std::string& between :
       {" if bX\n" + move + " endIf\n", " if bX\n" + move + " elseIf bY\n else\n" + move + " endIf\n",
        " switch n\n case 1\n" + move + " break\n default\n break\n endSwitch\n", std::string(" call goes()\n"),
        std::string(" stopMove()\n resetMotion()\n restartMove()\n"), std::string(" resetMotion(a)\n"),
        std::string(" if bX\n call goes()\n endIf\n")})
    EXPECT_FALSE(val3(between).known) << between;
}

TEST(ArrivingPoints, OfVal3AreKnownWhereTheWayIsStraight) {
  for (const char* between : {"", " if bX\n bY=true\n endIf\n", " call waits()\n", " // call goes()\n", " x.if=1\n"}) {
    const Arrival found = val3(between);
    EXPECT_TRUE(found.known) << between;
    EXPECT_THAT(found.said, Not(HasSubstr("are not in the files given"))) << between;
  }
  const Arrival called = val3(" call pick()\n");
  EXPECT_TRUE(called.known);
  EXPECT_THAT(called.said, AllOf(HasSubstr("pick, are not in the files given"), HasSubstr("the arm")));
}

TEST(ArrivingPoints, OfAnIndexThatIsComputedDoNotComeFromEachOther) {
  const auto value = [](const std::string& key, double away) {
    std::string text = joints_line(WrittenIn::val3, usual_joints().array() + away, 0, 4);
    return text.replace(text.find("\"0\""), 3, '"' + key + '"');
  };
  RandomStream stream{7521};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  for (const std::string goal : {"b[n]", "b[1]"}) {
    const std::string text = "<Data name=\"a\" type=\"jointRx\">" + value("0", 0.0) +
                             "</Data>\n<Data name=\"b\" type=\"jointRx\">" + value("0", 0.2) + value("1", 0.1) +
                             "</Data>\n<Program name=\"start\"><Code>begin\nmovej(a,flange,m)\nmovej(" + goal +
                             ",flange,m)\nend</Code></Program>\n";
    const CorrectedProgram corrected =
        correct_program(text, read_program(WrittenIn::val3, text, "p", model.nominal.chain), model, {});
    ASSERT_EQ(corrected.program.targets.at(2).name, "b[1]");
    const ApproachSigns& signs = corrected.targets.at(2).stop.approach;
    EXPECT_GE(signs.minCoeff(), 0.0) << goal << ": from b[0], joints would come down";
    EXPECT_TRUE(goal == "b[n]" || signs.minCoeff() == 1.0);
  }
}

TEST(ArrivingPoints, OfTablesComeFromTheSideThatTheySayOfEachJoint) {
  const std::string text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,s2,s3\n1,2,3,4,5,6,0,0\n2,3,4,5,6,7,-1,0\n";
  RandomStream stream{7521};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::csv, text, "p", model.nominal.chain), model, {});
  ApproachSigns expected = ApproachSigns::Ones(6);
  expected[1] = -1.0;
  expected[2] = 0.0;
  EXPECT_EQ(corrected.targets.at(1).stop.approach, expected);
}

}  // namespace
}  // namespace demecal

// Tools and frames that programs state: constant ones are used, computed ones leave their lines as they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "languages/written_program.hpp"
#include "programs/target_correction.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kExternal = "[9E9,9E9,9E9,9E9,9E9,9E9]";
const std::string kRobtarget = "[[100,200,300],[1,0,0,0],[0,0,0,0]," + kExternal + "]";

Target only_target(WrittenIn language, const std::string& text) {
  const Program program = read_program(language, text, "p", wrist_arm());
  EXPECT_EQ(program.targets.size(), 1u) << text;
  return program.targets.empty() ? Target{} : program.targets.front();
}

void expect_point(const Target& target, const Eigen::Vector3d& in_base_m) {
  EXPECT_TRUE(stated_point(target).isApprox(in_base_m, 1e-9)) << stated_point(target).transpose();
}

TEST(KrlFrames, AreThoseThatHoldWhereTheMotionStands) {
  const std::string lin = "LIN {X 10,Y 0,Z 0,A 0,B 0,C 0}\n";
  const Target target =
      only_target(WrittenIn::krl, "$TOOL={X 1,Y 2,Z 3,A 90,B 0,C 0}\n$BASE={X 500,Y 0,Z 0,A 90,B 0,C 0}\n" + lin);
  EXPECT_TRUE(target.frames.tool->translation().isApprox(Eigen::Vector3d(0.001, 0.002, 0.003), 1e-12));
  expect_point(target, {0.5, 0.01, 0.0});
  expect_point(only_target(WrittenIn::krl, "BASE_DATA[2]={X 5,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=BASE_DATA[2]\n" + lin),
               {0.015, 0.0, 0.0});
  expect_point(only_target(WrittenIn::krl, "BASE_DATA[2]={X 5,Y 0,Z 0,A 0,B 0,C 0}\nBAS(#BASE,2)\n" + lin),
               {0.015, 0.0, 0.0});
  for (const char* null : {"$BASE=$NULLFRAME\n", "BASE_DATA[2]=$NULLFRAME ; none\n$BASE=BASE_DATA[2]\n",
                           "BASE_DATA[2] = $nullframe\nBAS(#BASE,2)\n"})
    expect_point(only_target(WrittenIn::krl, null + lin), {0.01, 0.0, 0.0});
  const Target bare = only_target(WrittenIn::krl, "TOOL_DATA[3]=$NULLFRAME\n$TOOL=TOOL_DATA[3]\n" + lin);
  EXPECT_TRUE(bare.frames.tool.has_value() && bare.frames.tool->translation().isZero(0.0));
  EXPECT_EQ(target.motion, Motion::line);
}

TEST(KrlFrames, ThatAreComputedAreUnknown) {
  const std::string lin = "LIN {X 10,Y 0,Z 0,A 0,B 0,C 0}\n";
  for (const char* statement : {"$ROBROOT={X 9,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=$WORLD\n", "$BASE=$ROBROOT:shift\n",
                                "$BASE=my_base\n", "$BASE=BASE_DATA[3]\n", "BAS(#BASE,n)\n", "$BASE.X=5\n",
                                "$BASE=$WORLD:shift\n", "BASE_DATA[3]=$NULLFRAME:shift\n$BASE=BASE_DATA[3]\n",
                                "$BASE={X x1,Y 0,Z 0,A 0,B 0,C 0}\n", "FDAT_ACT=somewhere\n"}) {
    EXPECT_NE(only_target(WrittenIn::krl, statement + lin).frames.unknown_frame, "") << statement;
  }
  EXPECT_NE(only_target(WrittenIn::krl, "BAS(#TOOL,4)\n" + lin).frames.unknown_tool, "");
}

TEST(KrlFrames, OfPointsAreThoseOfTheMotionsThatNameThem) {
  const std::string point = "DECL E6POS XP1={X 10,Y 0,Z 0,A 0,B 0,C 0,S 2,T 2}\n";
  const std::string data = "DECL FDAT FP1={TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}\n";
  const std::string base = "BASE_DATA[2]={X 5,Y 0,Z 0,A 0,B 0,C 0}\n";
  const Target listed = only_target(WrittenIn::krl, base + point + data);
  expect_point(listed, {0.015, 0.0, 0.0});
  EXPECT_THAT(listed.frames.unknown_tool, HasSubstr("TOOL_DATA[1] is given neither"));
  const Target moved = only_target(WrittenIn::krl, point + "$BASE={X 7,Y 0,Z 0,A 0,B 0,C 0}\nPTP XP1\nLIN XP1\n");
  expect_point(moved, {0.017, 0.0, 0.0});
  EXPECT_EQ(moved.motion, Motion::joints);
  EXPECT_THAT(
      only_target(WrittenIn::krl, point + "PTP XP1\n$BASE={X 7,Y 0,Z 0,A 0,B 0,C 0}\nLIN XP1\n").frames.unknown_frame,
      HasSubstr("different frames"));
}

TEST(RapidFrames, AreThoseThatMotionsName) {
  const std::string tool = "PERS tooldata grip:=[TRUE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
  const std::string object =
      "PERS wobjdata table:=[FALSE,TRUE,\"\",[[500,0,0],[0.70710678,0,0,0.70710678]],[[0,0,10],[1,0,0,0]]];\n";
  const std::string point = "CONST robtarget p:=" + kRobtarget + ";\n";
  const Target named = only_target(WrittenIn::rapid, tool + object + point + "MoveL p,v100,fine,grip\\WObj:=table;\n");
  EXPECT_DOUBLE_EQ(named.frames.tool->translation().z(), 0.15);
  EXPECT_LT((stated_point(named) - Eigen::Vector3d(0.3, 0.1, 0.31)).norm(), 1e-7);
  EXPECT_EQ(named.motion, Motion::line);
  const Target held = only_target(WrittenIn::rapid, tool + "MoveJ " + kRobtarget + ",v100,fine,grip;\n");
  EXPECT_DOUBLE_EQ(held.frames.tool->translation().z(), 0.15);
  EXPECT_EQ(held.motion, Motion::joints);
  EXPECT_TRUE(only_target(WrittenIn::rapid, point + "MoveJ p,v9,fine,tool0;\n")
                  .frames.tool->isApprox(Eigen::Isometry3d::Identity()));
}

TEST(RapidFrames, ThatAreComputedOrUnknownAreSaid) {
  const std::string point = "CONST robtarget p:=" + kRobtarget + ";\n";
  const std::string object = "wobjdata w:=[FALSE,TRUE,\"\",[[500,0,0],[1,0,0,0]],[[0,0,10],[1,0,0,0]]];\n";
  const auto frame = [&](const std::string& text) { return only_target(WrittenIn::rapid, text).frames.unknown_frame; };
  EXPECT_THAT(frame(point + "MoveL p,v1,fine,tool0\\WObj:=elsewhere;\n"),
              HasSubstr("elsewhere is given neither in this program nor by --frames"));
  EXPECT_THAT(frame(point + "MoveL p,v1,fine,tool0 \\ WObj := elsewhere;\n"),
              HasSubstr("elsewhere is given neither in this program nor by --frames"));
  EXPECT_THAT(frame("VAR wobjdata w;\n" + point + "MoveL p,v1,fine,tool0\\WObj:=w;\n"), HasSubstr("is computed"));
  EXPECT_THAT(frame("PERS " + object + point + "w.uframe.trans.x:=3;\nMoveL p,v1,fine,tool0\\WObj:=w;\n"),
              HasSubstr("is computed"));
  EXPECT_THAT(frame("PERS " + object + point + "MoveL p,v1,fine,tool0\\WObj:=w;\nMoveL p,v1,fine,tool0;\n"),
              HasSubstr("different frames"));
  EXPECT_THAT(only_target(WrittenIn::rapid, point + "MoveL p,v1,fine,tGripper;\n").frames.unknown_tool,
              HasSubstr("tool tGripper is given neither"));
  EXPECT_THAT(frame(point + "MoveL p,v1,fine,tool0\\WObj:=wTable;\n"),
              HasSubstr("work object wTable is given neither"));
}

TEST(UrScriptFrames, AreTheToolsOfSetTcp) {
  const Target first = only_target(WrittenIn::urscript, "set_tcp(p[0,0,0.2,0,0,0])\nmovel(p[0.1,0.2,0.3,0,0,0])\n");
  EXPECT_DOUBLE_EQ(first.frames.tool->translation().z(), 0.2);
  const std::string named = "t=p[0,0,0.3,0,0,0]\np1=p[0.1,0.2,0.3,0,0,0]\nset_tcp(t)\nmovel(p1)\n";
  const Target second = only_target(WrittenIn::urscript, named);
  EXPECT_DOUBLE_EQ(second.frames.tool->translation().z(), 0.3);
  EXPECT_THAT(
      only_target(WrittenIn::urscript, "set_tcp(get_tool())\nmovel(p[0.1,0.2,0.3,0,0,0])\n").frames.unknown_tool,
      HasSubstr("is computed"));
  EXPECT_THAT(only_target(WrittenIn::urscript, named + "set_tcp(p[0,0,0,0,0,0])\nmovel(p1)\n").frames.unknown_tool,
              HasSubstr("different tools"));
}

TEST(UrScriptFrames, AreTheFeaturesOfPoseTrans) {
  const std::string plane = "plane=p[0.5,0,0.1,0,0,1.5707963267948966]\n", point = "p[0.1,0.2,0.3,0,0,0]";
  const auto frames = [](const std::string& text) { return only_target(WrittenIn::urscript, text).frames; };
  const Target named = only_target(WrittenIn::urscript, plane + "movel(pose_trans(plane, " + point + "), a=1)\n");
  expect_point(named, {0.3, 0.1, 0.4});
  EXPECT_EQ(named.motion, Motion::line);
  expect_point(only_target(WrittenIn::urscript, "movel(pose_trans(p[0.5,0,0,0,0,0]," + point + "))\n"),
               {0.6, 0.2, 0.3});
  expect_point(only_target(WrittenIn::urscript, plane + "q=" + point + "\nmovel(pose_trans(plane,q))\n"),
               {0.3, 0.1, 0.4});
  EXPECT_THAT(frames("plane=get_plane()\nmovel(pose_trans(plane," + point + "))\n").unknown_frame,
              HasSubstr("feature plane is computed"));
  EXPECT_THAT(frames("movel(pose_trans(plane," + point + "))\n").unknown_frame,
              HasSubstr("feature plane is given neither in this program nor by --frames"));
  EXPECT_THAT(frames("movel(pose_trans(p[x,0,0,0,0,0]," + point + "))\n").unknown_frame, HasSubstr("is computed"));
  EXPECT_THAT(frames(plane + "q=" + point + "\nmovel(pose_trans(plane,q))\nmovel(q)\n").unknown_frame,
              HasSubstr("different frames"));
  const Program nested = read_program(
      WrittenIn::urscript, plane + "movel(pose_trans(plane,pose_trans(plane," + point + ")))\n", "p", wrist_arm());
  EXPECT_TRUE(nested.targets.empty());
  EXPECT_EQ(nested.uncorrected.size(), 1u);
  const Program approached =
      read_program(WrittenIn::urscript, "pick=" + point + "\nmovel(pose_trans(pick,p[0,0,-0.1,0,0,0]))\nmovel(pick)\n",
                   "p", wrist_arm());
  ASSERT_EQ(approached.targets.size(), 2u);
  EXPECT_EQ(approached.targets[0].frames.unknown_frame, "");
  EXPECT_THAT(approached.targets[1].frames.unknown_frame, HasSubstr("hangs on pick, which is itself moved to"));
}

TEST(Val2Frames, AreThoseOfToolAndBase) {
  const std::string points = ".END\n.LOCATIONS\np 1 0 0 0 1 0 0 0 1 10 20 30\nt 1 0 0 0 1 0 0 0 1 0 0 150\n.END\n";
  const Target tool = only_target(WrittenIn::val2, ".PROGRAM a\n 10 TOOL t\n" + points);
  EXPECT_EQ(tool.name, "p");
  EXPECT_DOUBLE_EQ(tool.frames.tool->translation().z(), 0.15);
  const Program based = read_program(WrittenIn::val2, ".PROGRAM a\n BASE 100,,-50\n" + points, "p", wrist_arm());
  ASSERT_EQ(based.targets.size(), 2u);
  EXPECT_LT((stated_point(based.targets[0]) - Eigen::Vector3d(-0.09, 0.02, 0.08)).norm(), 1e-12);
  EXPECT_THAT(
      read_program(WrittenIn::val2, ".PROGRAM a\n TOOL u\n" + points, "p", wrist_arm()).targets[0].frames.unknown_tool,
      HasSubstr("computed"));
  EXPECT_THAT(read_program(WrittenIn::val2, ".PROGRAM a\n BASE dx,0,0\n" + points, "p", wrist_arm())
                  .targets[0]
                  .frames.unknown_frame,
              HasSubstr("computed"));
}

TEST(UnknownFrames, LeaveTheirLinesAndSaySo) {
  RandomStream stream{7505};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const std::string text =
      "$BASE=my_base\nPTP {A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\n"
      "LIN {X 500,Y 200,Z 300,A 0,B 90,C 0,S 2,T 2}\n";
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::krl, text, "p", model.nominal.chain), model, {});
  EXPECT_EQ(corrected.targets[0].outcome, CorrectionOutcome::corrected);
  EXPECT_EQ(corrected.targets[1].outcome, CorrectionOutcome::uncorrected);
  EXPECT_EQ(corrected.text.substr(corrected.text.find("LIN")), text.substr(text.find("LIN")));
  ASSERT_FALSE(corrected.warnings.empty());
  EXPECT_THAT(corrected.warnings.back().sentence,
              HasSubstr("$BASE is computed when the program runs; this line was not"));
}

TEST(GivenTool, StandsInForOneThatTheFileDoesNotGiveAndGivesWayToOneThatItStates) {
  RandomStream stream{7512};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const Circumstances given{.temperature_celsius = 20.0, .tool_given = true};
  const std::string move = "PTP {A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\nLIN {X 500,Y 200,Z 300,A 0,B 90,C 0}\n";
  const auto first_warning = [&](const std::string& text) {
    const CorrectedProgram corrected =
        correct_program(text, read_program(WrittenIn::krl, text, "p", model.nominal.chain), model, given);
    EXPECT_EQ(corrected.targets[0].outcome, CorrectionOutcome::corrected);
    return corrected.warnings.empty() ? "" : corrected.warnings[0].sentence;
  };
  EXPECT_THAT(first_warning("BAS(#TOOL,3)\n" + move), HasSubstr("stands in for one"));
  EXPECT_THAT(first_warning("$TOOL={X 0,Y 0,Z 300,A 0,B 0,C 0}\n" + move), HasSubstr("that one is corrected"));
}

TEST(GivenTool, LeavesTheMeasuredToolToTargetsThatStateTheirs) {
  RandomStream stream{7513};
  const Robot nominal = elbow_arm(stream);
  const CommandModel own = erring_model(stream, nominal);
  const CommandModel model = with_stated_tool(own, Eigen::Vector3d(0.0, 0.0, 0.1));
  const auto text_of = [&](const std::string& text, WrittenIn language, const Circumstances& given,
                           const CommandModel& used) {
    return correct_program(text, read_program(language, text, "p", nominal.chain), used, given).text;
  };
  const Circumstances beside{.temperature_celsius = 20.0, .tool_given = true, .own_tool = &own};
  const Circumstances alone{.temperature_celsius = 20.0};
  const std::string joints = "PTP {A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\n",
                    script = "movej([0.2,-1.0,1.2,0.35,0.9,0.1])\n";
  for (const auto& [language, text] : {std::pair{WrittenIn::krl, "$TOOL={X 150,Y 2,Z 56,A 0,B 0,C 0}\n" + joints},
                                       {WrittenIn::urscript, "set_tcp(p[0.15,0.002,0.056,0,0,0])\n" + script}})
    EXPECT_EQ(text_of(text, language, beside, model), text_of(text, language, alone, own));
  EXPECT_EQ(text_of(script, WrittenIn::urscript, beside, model), text_of(script, WrittenIn::urscript, alone, model))
      << "where none is stated, the one that is given";
  EXPECT_NE(text_of(script, WrittenIn::urscript, beside, model), text_of(script, WrittenIn::urscript, alone, own));
}

TEST(GivenTool, IsNoWorkObjectOfAPointThatNoMotionNames) {
  RandomStream stream{7515};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const std::string text =
      "MODULE m\nCONST robtarget pOther:=[[500,200,300],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\n"
      "MoveAbsJ [[10,-60,70,20,50,5],[9E9,9E9,9E9,9E9,9E9,9E9]],v9,fine,tGrip;\nENDPROC\nENDMODULE\n";
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::rapid, text, "p", model.nominal.chain), model,
                      {.temperature_celsius = 20.0, .tool_given = true});
  ASSERT_EQ(corrected.targets.size(), 2u);
  EXPECT_EQ(corrected.targets[0].outcome, CorrectionOutcome::uncorrected);
  EXPECT_EQ(corrected.targets[0].remarks, std::vector<std::string>{"no motion names it; this line was not corrected"});
  EXPECT_EQ(corrected.targets[1].outcome, CorrectionOutcome::corrected);
}

TEST(GivenTool, StandsInForOneToolAlone) {
  RandomStream stream{7514};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const Circumstances given{.temperature_celsius = 20.0, .tool_given = true};
  const auto said_of = [&](WrittenIn language, const std::string& text) {
    std::string said;
    for (const Remark& warning :
         correct_program(text, read_program(language, text, "p", model.nominal.chain), model, given).warnings)
      said += warning.sentence + '\n';
    return said;
  };
  const std::string axes = "PTP {A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\n",
                    joints = "DECL E6AXIS XP1={A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\n";
  EXPECT_THAT(said_of(WrittenIn::krl, "BAS(#TOOL,3)\n" + axes + "BAS(#TOOL,4)\n" + axes),
              AllOf(HasSubstr("TOOL_DATA[3] is given neither in this program nor by --frames; this line was not "
                              "corrected; --tool-mm states one "
                              "tool, and the program has 2 that are not known (TOOL_DATA[3], TOOL_DATA[4]): --frames"),
                    HasSubstr("TOOL_DATA[4] is given neither in this program nor by --frames; this line was not"),
                    Not(HasSubstr("stands in"))));
  EXPECT_THAT(said_of(WrittenIn::krl, "BAS(#TOOL,3)\n" + axes + axes), HasSubstr("stands in for one that"));
  EXPECT_THAT(said_of(WrittenIn::krl, joints + "BAS(#TOOL,3)\nPTP XP1\nBAS(#TOOL,4)\nPTP XP1\n"),
              HasSubstr("it is moved to with different tools; this line was not corrected\n"));
  const std::string listed = "/MN\n  1:J P[1] 9% FINE ;\n  2:J P[2] 9% FINE ;\n/POS\n";
  const auto position = [](const std::string& number, const std::string& tool) {
    return "P[" + number + "]{\n GP1:\n UF : 0, UT : " + tool +
           ",\n J1= 10 deg, J2= -60 deg, J3= 70 deg, J4= 20 deg, J5= 50 deg, J6= 5 deg\n};\n";
  };
  EXPECT_THAT(said_of(WrittenIn::fanuc_ls, listed + position("1", "1") + position("2", "2") + "/END\n"),
              AllOf(HasSubstr("UT 1 is given neither in this program nor by --frames; this line was not corrected"),
                    HasSubstr("UT 2 is given neither in this program nor by --frames; this line was not corrected")));
  EXPECT_THAT(said_of(WrittenIn::fanuc_ls, listed + position("1", "1") + position("2", "1") + "/END\n"),
              HasSubstr("stands in for one that"));
}

/// What is corrected of the tool: the described one as the identified one sees it.
TEST(BelievedTool, LeavesOfTheToolWhatProgramsAreCorrectedBy) {
  const Eigen::Vector3d described_m(0.02, 0.01, 0.15);
  for (const double error_m : {0.0, 1e-4, 9e-3, 0.02}) {
    for (const double turn_rad : {0.0, 3e-3, 0.04, 0.8}) {
      Robot nominal;
      nominal.chain = wrist_arm();
      nominal.chain.tool_m = described_m;
      CorrectedRobot robot;
      robot.chain = nominal.chain;
      robot.described = nominal;
      robot.corrections.resize(nominal.chain.joints.size());
      robot.tools[""] = Eigen::Translation3d(described_m + error_m * Eigen::Vector3d::UnitX()) *
                        Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ());
      const CommandModel model = command_model(nominal, robot, std::vector<double>(6, 1.0));
      const Eigen::Isometry3d corrected =
          model.robot.tool("").inverse() * Eigen::Translation3d(model.nominal.chain.tool_m);
      const Eigen::Isometry3d left = robot.tool("").inverse() * believed_tool(described_m, robot.tool(""));
      const Eigen::Isometry3d turned(robot.tool("").linear());
      // Where a turn is that of a mount, it stands on both sides.
      const Eigen::Isometry3d expected = turn_rad > 0.05 ? turned.inverse() * corrected * turned : corrected;
      EXPECT_LT((left.matrix() - expected.matrix()).norm(), 1e-12) << error_m << " m, " << turn_rad << " rad";
    }
  }
}

}  // namespace
}  // namespace demecal

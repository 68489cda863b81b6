// Programs written by hand, as controllers and people write them: what is a target, what is not, and where faults are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinematics/random_arm.hpp"
#include "kinematics/units.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Val2, ReadsBothKindsOfPointsOfSeveralPrograms) {
  const Program program =
      read_program(WrittenIn::val2,
                   ".PROGRAM t1\n MOVE #cp[1]\n HERE #cp[9] 1 2\n.END\n.LOCATIONS\n"
                   "#cp[1] 10.5 -20.25 +30 0 -5.125 6\r\n"
                   "mcp[1]\t16384 0 0 0 16384 0 0 0 16384 8000 -160 16\n"
                   "home 1 0 0 0 0 1 0 -1 0 500.5 -1 2 ; a comment 7\n"
                   ".END\n.REALS\nspeed 30\n.END\n.PROGRAM t2\n.END\n.locations\n#cp[2,3] 1 2 3\n   4 5 6\n.END",
                   "p", wrist_arm());
  EXPECT_THAT(names(program), ElementsAre("#cp[1]", "mcp[1]", "home", "#cp[2,3]"));
  EXPECT_THAT(values(program.targets[0].joints), ElementsAre(10.5, -20.25, 30, 0, -5.125, 6));
  EXPECT_DOUBLE_EQ(program.targets[0].joints[0].inside(), radians(10.5));
  EXPECT_DOUBLE_EQ(program.targets[1].position[0].inside(), 0.5);
  EXPECT_DOUBLE_EQ(program.targets[1].position[1].inside(), -0.01);
  EXPECT_DOUBLE_EQ(program.targets[2].position[0].inside(), 0.5005);
  EXPECT_DOUBLE_EQ(program.targets[2].position[1].inside(), -0.001);
  EXPECT_EQ(program.targets[3].place.line, 16u);
  EXPECT_THAT(values(program.targets[3].joints), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(Val2, NamesTheFault) {
  const std::string head = ".LOCATIONS\n";
  expect_fault(WrittenIn::val2, head + "#p 1 2 3 4 5\n.END", 2, "'#p': has 5 numbers");
  expect_fault(WrittenIn::val2, head + "#p 1 2 3 4 5 6 7\n.END", 2, "has 7 numbers");
  expect_fault(WrittenIn::val2, head + "#p 1 2 x3 4 5 6\n.END", 2, "'x3': must be a number (column 8)");
  expect_fault(WrittenIn::val2, head + "#p 1 2 3.1.2 4 5 6\n.END", 2, "'3.1.2': must be a number (column 8)");
  expect_fault(WrittenIn::val2, head + "#p[1 1 2 3 4 5 6\n.END", 2, "opens a bracket that its line does not close");
  expect_fault(WrittenIn::val2, head + "p 1 0 0 0 1 0 0 0 1 5 6\n", 2, "'p': has 11 numbers");
  expect_fault(WrittenIn::val2, head + "p 1 0 0 0 1 0 0 0 0 5 6 7\n", 2, "no rotation");
  expect_fault(WrittenIn::val2, head + "1 2 3 4 5 6\n", 2, "before the name");
  expect_fault(WrittenIn::val2, head + "#p 1 2 3 4 5 nan\n", 2, "'nan': must be a number");
}

TEST(Csv, FindsItsColumnsByTheirNames) {
  const Program joints =
      read_program(WrittenIn::csv,
                   "\xEF\xBB\xBF# made by "
                   "hand\r\n\r\nname;J6_deg;j1_rad;j2_deg;j3_deg;j4_deg;j5_deg;s1;s2;s3;s4;s5;s6;payload_kg\r\n"
                   "\"a;b\"; \"6\" ;0.5;2;3;4;5;1;-1;0;1;1;1;2.5",
                   "p", wrist_arm());
  ASSERT_THAT(names(joints), ElementsAre("a;b"));
  EXPECT_THAT(values(joints.targets[0].joints), ElementsAre(0.5, 2, 3, 4, 5, 6));
  EXPECT_EQ(joints.targets[0].joints[0].inside(), 0.5);
  EXPECT_EQ((*joints.targets[0].approach)[1], -1.0);
  EXPECT_EQ(joints.targets[0].payload_kg, 2.5);
  const Program poses =
      read_program(WrittenIn::csv, "qw,qx,qy,qz,z_m,y_m,x_m\n1,0,0,0,0.3,0.2,0.1\n", "p", wrist_arm());
  EXPECT_THAT(values(poses.targets[0].position), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_EQ(poses.targets[0].form, OrientationForm::quaternion);
  const Program points = read_program(WrittenIn::csv, "x_mm,y_mm,z_mm\n1,2,3\n", "p", wrist_arm());
  EXPECT_EQ(points.targets[0].form, OrientationForm::unknown);
}

TEST(Csv, TakesTheSideOfEveryJointByItself) {
  const auto approach = [](const std::string& columns, const std::string& row) {
    return read_program(WrittenIn::csv,
                        "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg" + columns + "\n1,2,3,4,5,6" + row + '\n', "p",
                        wrist_arm())
        .targets.at(0)
        .approach;
  };
  const auto some = approach(",s3,s2", ",1,-1");
  ASSERT_TRUE(some);
  for (Eigen::Index joint = 0; joint < 6; ++joint) EXPECT_EQ(std::isnan((*some)[joint]), joint != 1 && joint != 2);
  EXPECT_EQ((*some)[1], -1.0);
  EXPECT_EQ((*some)[2], 1.0);
  EXPECT_EQ(approach("", ""), std::nullopt);
  EXPECT_EQ(approach(",s7", ",1"), std::nullopt);
}

TEST(Csv, NamesTheFault) {
  const std::string head = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
  expect_fault(WrittenIn::csv, head + "1,2,3,4,5,6\n1,2,,4,5,6\n", 3, "a number is missing (column 5)");
  expect_fault(WrittenIn::csv, head + "1,2,3,4,5,six\n", 2, "'six': must be a number (column 11)");
  expect_fault(WrittenIn::csv, head + "1,2,3,4,5\n", 2, "has 5 fields");
  expect_fault(WrittenIn::csv, head + "1,2,3,4,5,\"6\n", 2, "opens a quote");
  expect_fault(WrittenIn::csv, "q1,q2,q3,q4,q5,q6\n1,2,3,4,5,6\n", 1, "unit");
  expect_fault(WrittenIn::csv, "x_mm,y_mm,z_mm,qw,qx,qy,qz\n1,2,3,1,1,0,0\n", 2, "unit quaternion");
  expect_fault(WrittenIn::csv, "", 0, "is empty");
}

TEST(Csv, RefusesColumnsThatContradictEachOtherOrTheArm) {
  const std::string head = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg", row = "\n1,2,3,4,5,6,7\n";
  expect_fault(WrittenIn::csv, "# a comment\n" + head + ",q1_rad" + row, 2, "'q1_rad': stands beside 'q1_deg'");
  expect_fault(WrittenIn::csv, head + ",Q2_DEG" + row, 1, "'Q2_DEG': stands beside 'q2_deg'");
  expect_fault(WrittenIn::csv, head + ",j1_deg,j2_deg,j3_deg,j4_deg,j5_deg,j6_deg" + row, 1,
               "'j1_deg': stands beside 'q1_deg'");
  expect_fault(WrittenIn::csv, head + ",q7_deg" + row, 1, "'q7_deg': the arm has 6 joints");
  expect_fault(WrittenIn::csv, "x_mm,y_mm,z_mm,z_m\n1,2,3,4\n", 1, "'z_m': stands beside 'z_mm'");
  expect_fault(WrittenIn::csv, head + ",payload_kg\n1,2,3,4,5,6,-5\n", 2, "'-5': must be 0 or more");
  expect_fault(WrittenIn::csv, head + ",temperature_celsius\n1,2,3,4,5,6,20\n1,2,3,4,5,6,-400\n", 3,
               "'-400': must not be below -273.15");
  expect_fault(WrittenIn::csv, head + ",payload_kg,payload_kg\n1,2,3,4,5,6,1,5\n", 1, "is the name of two columns");
  expect_fault(WrittenIn::csv, "x_mm,y_mm,z_mm,qw,qx,qy,qz,QW\n1,2,3,1,0,0,0,0\n", 1, "'QW': is the name of two");
  expect_fault(WrittenIn::csv, head + ",s2,s2\n1,2,3,4,5,6,1,1\n", 1, "'s2': is the name of two");
  EXPECT_EQ(read_program(WrittenIn::csv, head + ",note,note\n1,2,3,4,5,6,a,b\n", "p", wrist_arm()).targets.size(), 1u);
  EXPECT_EQ(read_program(WrittenIn::csv, head + ",a7\n1,2,3,4,5,6,x\n", "p", wrist_arm()).targets.size(), 1u);
}

TEST(Krl, ReadsTargetsAndNeitherFramesNorRelativeMotions) {
  const Program program =
      read_program(WrittenIn::krl,
                   "&ACCESS RVP\nDEF prog()\n"
                   "DECL E6POS XP1={X 500.0,Y -20,Z 3.5E2,A 0.0,B 90.0,C -180,S 2,T 35,E1 0.0}\n"
                   "decl global e6axis home = {a1 0, a2 -90, a3 90, a4 0, a5 1.5, a6 -2} ; {A1 1}\n"
                   "DECL FRAME F={X 1,Y 2,Z 3,A 4,B 5,C 6}\n$TOOL={X 1,Y 2,Z 3,A 4,B 5,C 6}\n"
                   "BASE_DATA[1]={X 1,Y 2,Z 3,A 4,B 5,C 6}\nDECL FDAT FP1={TOOL_NO 1,BASE_NO 0,POINT2[] \"{A1\"}\n"
                   "PTP {E6POS: X 1,Y 2,Z 3,A 4,B 5,C 6}\nLIN {X 7,Y 8,Z 9,A 1,B 2,C 3} C_DIS\n"
                   "LIN_REL {X 7,Y 8,Z 9,A 1,B 2,C 3}\nPTP {A1 10}\nPTP {A1 q,A2 0,A3 0,A4 0,A5 0,A6 0}\n"
                   "XP2[3]={X 1,Y 2,Z 3,A 4,B 5,C 6,S 1,T 'B000101'}\nEND\n",
                   "p", wrist_arm());
  EXPECT_THAT(names(program), ElementsAre("XP1", "home", "", "", "XP2[3]"));
  EXPECT_THAT(values(program.targets[0].position), ElementsAre(500, -20, 350));
  EXPECT_THAT(values(program.targets[0].orientation), ElementsAre(0, 90, -180));
  EXPECT_TRUE(*program.targets[0].hint.negative[0] && *program.targets[0].hint.negative[5]);
  EXPECT_FALSE(*program.targets[0].hint.negative[2]);
  EXPECT_TRUE(*program.targets[4].hint.negative[2]);
  EXPECT_FALSE(*program.targets[4].hint.negative[1]);
  EXPECT_THAT(values(program.targets[1].joints), ElementsAre(0, -90, 90, 0, 1.5, -2));
  ASSERT_EQ(program.uncorrected.size(), 2u);
  EXPECT_THAT(program.uncorrected[0].sentence, HasSubstr("only some of A1 to A6"));
  EXPECT_THAT(program.uncorrected[1].sentence, HasSubstr("'q' is no number"));
}

TEST(Krl, NamesTheFault) {
  expect_fault(WrittenIn::krl, "\nDECL E6AXIS A={A1 0,A2 abc,A3 0,A4 0,A5 0,A6 0}", 2,
               "'abc': must be a number (column 24)");
  expect_fault(WrittenIn::krl, "DECL E6POS P={X 1,Y 2,Z 3,A 4,B 5,C 1.2.3}", 1, "'1.2.3': must be a number");
  expect_fault(WrittenIn::krl, "DECL E6POS P={X 1,Y ,Z 3,A 4,B 5,C 6}", 1, "a number is missing");
  expect_fault(WrittenIn::krl, "PTP {A1 0,A2 0", 1, "never closed");
}

TEST(Rapid, ReadsTargetsWhereverTheyStand) {
  const Program program = read_program(
      WrittenIn::rapid,
      "MODULE m\n CONST robtarget "
      "p10:=[[500,-20.5,300],[0.707107,0,0.707107,0],[0,-1,0,1],[9E+09,9E9,9E9,9E9,9E9,9E9]];\n"
      " ! CONST robtarget p11:=[[1]];\n PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
      " const JOINTTARGET jp{2}:=[[[1,2,3,4,5,6],[0,0,0,0,0,0]],\n  [[7,8,9,1,2,3],[0,0,0,0,0,0]]];\n"
      " VAR robtarget later; PROC main(robtarget p)\n  TPWrite \"[[1,2,3],[1\";\n"
      "  MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v1000,z50,tool0;\n"
      "  MoveL Offs(p10,0,0,50),v100,fine,tool0;\n  MoveL [[x,0,0],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v1,fine,t;\n "
      "ENDPROC\n",
      "p", wrist_arm());
  EXPECT_THAT(names(program), ElementsAre("p10", "jp{1}", "jp{2}", ""));
  EXPECT_THAT(values(program.targets[0].position), ElementsAre(500, -20.5, 300));
  EXPECT_EQ(program.targets[0].hint.quadrants[3], -1);
  EXPECT_EQ(program.targets[2].place.line, 6u);
  ASSERT_EQ(program.uncorrected.size(), 1u);
  EXPECT_THAT(program.uncorrected[0].sentence, HasSubstr("'x'"));
}

TEST(Rapid, NamesTheFault) {
  expect_fault(WrittenIn::rapid, "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0]];", 1, "must be a robtarget");
  expect_fault(WrittenIn::rapid, "CONST robtarget p:=[[1,2,3o],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]];", 1,
               "'3o': must be a number");
  expect_fault(WrittenIn::rapid, "CONST robtarget p:=[[1,2,3],[1,1,0,0],[0,0,0,0],[0,0,0,0,0,0]];", 1,
               "unit quaternion");
  expect_fault(WrittenIn::rapid, "\nVAR jointtarget p:=[[1,2,3,4,5],[0,0,0,0,0,0]];", 2, "must be a jointtarget");
  expect_fault(WrittenIn::rapid, "CONST jointtarget p:=[[1,2,3,4,5,6],[0,0,0", 1, "never closed");
}

TEST(UrScript, ReadsWhatMotionsAreSentTo) {
  const Program program = read_program(
      WrittenIn::urscript,
      "def prog():\n  set_tcp(p[0,0,0.1,0,0,0])\n  global w_p=p[.4,-.2,.3,0,3.14,0]\n  global "
      "w_q=[0,-1.5,1.5,0,1.5,0]\n"
      "  other = [1,2,3,4,5,6]\n  movej(get_inverse_kin(w_p, qnear=w_q), a=1.4, v=1.05)\n"
      "  movel(p[0.1, 0.2,0.3 , 0,0,1.5],a=1.2) # movej([9,9,9,9,9,9])\n  movej( q = [1,2,3,4,5,6], t=0)\n"
      "  movec(p[1,0,0,0,0,0], w_p, a=1)\n  movel(pose_trans(f, p[0,0,0,0,0,0]))\n  movej([d2r(1),0,0,0,0,0])\n"
      "  movej(unknown)\nend\n",
      "p", wrist_arm());
  EXPECT_THAT(names(program), ElementsAre("w_p", "", "", "", ""));
  EXPECT_TRUE(program.targets[0].is_pose());
  ASSERT_EQ(program.targets[0].hint.near.size(), 6);
  EXPECT_EQ(program.targets[0].hint.near[1], -1.5);
  EXPECT_THAT(values(program.targets[2].joints), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(program.targets[4].frames.frame, "feature f");
  EXPECT_NE(program.targets[4].frames.unknown_frame, "");
  EXPECT_EQ(program.uncorrected.size(), 2u);
}

TEST(UrScript, NamesTheFault) {
  expect_fault(WrittenIn::urscript, "\n movej([1,2,3,4,5], a=1)", 2, "must have six joint angles (column 8)");
  expect_fault(WrittenIn::urscript, "movel(p[1,2,3,4,5])", 1, "must have six numbers");
  expect_fault(WrittenIn::urscript, "movel(p[1,2,3,4,5,1.2.3])", 1, "'1.2.3': must be a number (column 19)");
  expect_fault(WrittenIn::urscript, "movej([1,2,3,4,5,6", 1, "never closed");
}

TEST(Readers, RefuseArmsOfAnotherNumberOfJoints) {
  RandomStream stream{7301};
  const Chain arm = random_arm(stream, 5, Convention::standard_dh);
  for (const WrittenIn language : kLanguages) {
    if (language == WrittenIn::val2 || language == WrittenIn::csv) continue;
    EXPECT_THROW(read_program(language, "", "p", arm), InputError);
  }
}

std::string recognized(const std::string& text, const std::string& file) {
  const Language* const language = recognize_language(text, file);
  return language == nullptr ? "" : std::string(language->name);
}

TEST(Language, IsToldByEndingOrWords) {
  EXPECT_EQ(recognized("", "a.CSV"), "csv");
  EXPECT_EQ(recognized("", "dir.csv/a.src"), "krl");
  EXPECT_EQ(recognized(".Program x\n", "a"), "val2");
  EXPECT_EQ(recognized("CONST robtarget p", "a.prg"), "rapid");
  EXPECT_EQ(recognized("DECL E6POS P", "a.dat"), "krl");
  EXPECT_EQ(recognized("  movej([1", "a.txt"), "urscript");
  EXPECT_EQ(recognized("", "A.LS"), "fanuc_ls");
  EXPECT_EQ(recognized("/PROG  A\n/MN\n", "a.txt"), "fanuc_ls");
  EXPECT_EQ(recognized("/JOB\n//POS\n///NPOS 1,0,0,0,0,0\n", "a.txt"), "yaskawa_jbi");
  EXPECT_EQ(recognized(".PROGRAM a()\n.END\n.JOINTS\n", "a.txt"), "kawasaki_as");
  EXPECT_EQ(recognized(".PROGRAM a()\n.END\n.TRANS\n", "a.pg"), "kawasaki_as");
  EXPECT_EQ(recognized(".PROGRAM a()\n.END\n.LOCATIONS\n", "a.pg"), "val2");
  EXPECT_EQ(recognized("<Database xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\">", "a.xml"), "val3");
  EXPECT_EQ(recognized("hello", "a.txt"), "");
}

}  // namespace
}  // namespace demecal

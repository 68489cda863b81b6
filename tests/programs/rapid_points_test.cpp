// RAPID's targets that the program changes, displaces, hands on or comes near only: left as they are, or said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "judged_points.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string rapid_point(const std::string& name, const std::string& kind = "VAR") {
  const std::string line = pose_line(WrittenIn::rapid, flange_pose(), usual_joints(), 1, 4);
  const std::size_t begin = line.find("[[");
  return kind + " robtarget " + name + ":=" + line.substr(begin, line.find(",v200") - begin) + ";\n";
}

std::string of_rapid(const std::string& statements, const std::string& name = "pA") {
  return judged(WrittenIn::rapid,
                "MODULE m\n" + rapid_point("pA") + rapid_point("pB", "CONST") +
                    "PERS jointtarget jA:=[[10,-60,70,20,50,5],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\n" +
                    "MoveAbsJ jA,v9,fine,tool0;\nMoveJ pB,v9,fine,tool0;\n" + statements + "ENDPROC\nENDMODULE\n",
                name);
}

TEST(Rapid, LeavesPointsThatTheProgramChanges) {
  const std::string move = "MoveJ pA,v9,fine,tool0;\n";
  EXPECT_THAT(of_rapid(move), StartsWith("corrected:"));
  EXPECT_THAT(of_rapid(move, "jA"), StartsWith("corrected:"));
  for (const char* change : {"pA.trans.z:=pA.trans.z+50;\n", "pA.trans:=[500,0,300];\n", "pA:=CRobT(\\Tool:=tool0);\n",
                             "PA := Offs(pB,0,0,50);\n"}) {
    for (const std::string& text : {move + change + move, change + move})
      EXPECT_THAT(of_rapid(text), AllOf(StartsWith("left: line "), HasSubstr(kChanged))) << text;
    EXPECT_THAT(of_rapid(move + change, "pB"), StartsWith("corrected:"));
  }
  EXPECT_THAT(of_rapid(move + "jA.robax.rax_2:=40;\nMoveAbsJ jA,v9,fine,tool0;\n", "jA"),
              AllOf(StartsWith("left:"), HasSubstr("line 9 changes it")));
}

TEST(Rapid, LeavesPointsThatAreHandedOn) {
  const std::string move = "MoveJ pA,v9,fine,tool0;\n";
  for (const char* use : {"Grp pA;\n", "Grp(pA);\n", "w.uframe:=DefFrame(pA,pB,pB);\n", "MoveHome pA,v9,fine,tool0;\n",
                          "SearchL\\Stop,di1,pA,pB,v9,tool0;\n", "MoveL ORobT(pA),v9,fine,tool0;\n"})
    EXPECT_THAT(of_rapid(move + use), AllOf(StartsWith("left:"), HasSubstr(kUsed))) << use;
  EXPECT_THAT(of_rapid(move + "MoveL Offs(pA,0,0,50)\\ID:=5,v9,fine,tool0;\n"), StartsWith("corrected:"));
  EXPECT_THAT(of_rapid(move + "pC:=pA;\nWaitTime 1;\n"), StartsWith("corrected:"));
}

TEST(Rapid, SaysWhichMotionsGoToNoTarget) {
  for (const char* place : {"CalcRobT(jA,tool0)", "Offs(pIn,0,0,300)", "pElsewhere"})
    EXPECT_THAT(of_rapid(std::string("MoveL ") + place + ",v9,fine,tool0;\n", ""),
                HasSubstr(std::string("'") + place + "' is not given as numbers in this program"));
  EXPECT_THAT(of_rapid("MoveL Offs(pB,0,0,30),v9,fine,tool0;\n", ""), ::testing::Not(HasSubstr("as numbers")));
}

TEST(Rapid, LeavesPointsThatAreDisplaced) {
  const std::string set = "PDispSet [[0,0,100],[1,0,0,0]];\n", move = "MoveJ pA,v9,fine,tool0;\n";
  EXPECT_THAT(of_rapid(set + move), AllOf(StartsWith("left:"), HasSubstr("displaced by PDispSet")));
  EXPECT_THAT(of_rapid(set + move, "jA"), StartsWith("corrected:"));
  EXPECT_THAT(of_rapid(set + "MoveL pB,v9,fine,tool0;\nPDispOff;\n" + move), StartsWith("corrected:"));
  EXPECT_THAT(of_rapid(set + "Grp;\nPDispOff;\n" + move), StartsWith("left:"));
}

TEST(Rapid, LeavesPointsWhereSensorsShiftTheMotion) {
  const std::string before = "MoveJ pA,v9,fine,tool0;\n";
  for (const char* guided : {"MoveL pA,v9,fine,tool0\\Corr;\n", "MoveL pA\\ID:=5,v9,fine,tool0\\WObj:=wobj0\\Corr;\n",
                             "TriggL pA,v9,gunon,fine,tool0\\Corr;\n", "MoveL pA,v9,fine,tool0\\ Corr;\n",
                             "MoveL pA,v9,fine,tool0 \\\tCorr;\n"}) {
    EXPECT_THAT(of_rapid(guided), AllOf(StartsWith("left: line 8 moves to it with \\"), HasSubstr("by which sensors")))
        << guided;
    EXPECT_THAT(of_rapid(before + guided), AllOf(StartsWith("left:"), HasSubstr("by which sensors"))) << guided;
    EXPECT_EQ(of_rapid(guided, "pB"), of_rapid("", "pB")) << guided;
    EXPECT_EQ(of_rapid(guided, "jA"), of_rapid("", "jA")) << guided;
  }
  EXPECT_THAT(of_rapid("MoveL pA,v9,fine,tool0 \\\n  Corr;\n"), StartsWith("left: line 9 moves to it with \\Corr"));
  EXPECT_THAT(of_rapid("ArcL pA,v9,sm1,wd1,fine,tool0\\Track:=tr1;\n"), StartsWith("left:"));
  // Numbers in the motion itself.
  const std::string point = rapid_point("pA"),
                    numbers = point.substr(point.find("[["), point.rfind(';') - point.find("[["));
  EXPECT_THAT(of_rapid("MoveL " + numbers + ",v9,fine,tool0;\n", ""), StartsWith("corrected:"));
  EXPECT_THAT(of_rapid("MoveL " + numbers + ",v9,fine,tool0\\Corr;\n", ""),
              AllOf(StartsWith("left:"), HasSubstr("with \\Corr, by which sensors")));
}

TEST(Rapid, LeavesNumbersThatAreHandedToInstructionsThatAreNotFollowed) {
  const std::string point = rapid_point("pA"),
                    numbers = point.substr(point.find("[["), point.rfind(';') - point.find("[["));
  const std::string joints = "[[10,-60,70,20,50,5],[9E9,9E9,9E9,9E9,9E9,9E9]]";
  for (const std::string& handed : {numbers, joints}) {
    const std::string weld = "ArcL " + handed + ",v9,sm1,wd1,fine,tool0\\WObj:=w1;\n";
    EXPECT_THAT(of_rapid(weld, ""), AllOf(StartsWith("left:"), HasSubstr("handed to an instruction"))) << weld;
    EXPECT_THAT(judged(WrittenIn::rapid, "MODULE m\nPROC main()\n" + weld + "ENDPROC\nENDMODULE\n", ""),
                AllOf(StartsWith("left:"), HasSubstr("handed to an instruction")));
  }
}

TEST(Rapid, ReadsMotionsThatGoOnWithTheProgram) {
  for (const char* const option : {"\\Conc,", " \\Conc, ", ""}) {
    const std::string one = std::string("MoveL") + (*option == '\0' ? " " : option) + "pA,v9,fine,tOne;\n";
    EXPECT_THAT(of_rapid("MoveJ pA,v9,fine,tool0;\n" + one), HasSubstr("different tools")) << one;
  }
  EXPECT_THAT(of_rapid("MoveJ\\Conc,pA,v9,fine,tool0;\n"), StartsWith("corrected:"));
}

TEST(Rapid, WarnsWhereTheArmGivesWayToForces) {
  for (const char* const statement : {"CSSAct X\\StiffnessNonDir:=50;\n", "SoftAct 1,20;\n", "FCAct tool0;\n"})
    EXPECT_THAT(of_rapid(std::string(statement) + "MoveL pA,v9,fine,tool0;\n", ""),
                HasSubstr("the arm gives way to forces"))
        << statement;
}

TEST(Rapid, WarnsOfPlacesFarFromThePointThatCorrectsThem) {
  const std::string move = "MoveJ pA,v9,fine,tool0;\n";
  EXPECT_EQ(of_rapid(move + "MoveL Offs(pA,0,0,50),v9,fine,tool0;\n"), of_rapid(move));
  EXPECT_THAT(of_rapid(move + "MoveL Offs(pA,0,0,-300),v9,fine,tool0;\n"),
              AllOf(StartsWith("corrected:"), HasSubstr("300 mm away from it")));
  EXPECT_THAT(of_rapid(move + "MoveL RelTool(pA,0,0,n),v9,fine,tool0;\n"), HasSubstr("is not known"));
}

TEST(Rapid, LeavesPointsThatNoMotionNamesOrThatATrackMayCarry) {
  EXPECT_THAT(of_rapid(""), AllOf(StartsWith("left:"), HasSubstr("no motion names it")));
  std::string point = rapid_point("pT");
  point.replace(point.find("[9E+09"), 6, "[150");
  EXPECT_THAT(judged(WrittenIn::rapid, point + "MoveJ pT,v9,fine,tool0;\n", "pT"),
              AllOf(StartsWith("left:"), HasSubstr("eax_a, may carry the arm")));
}

}  // namespace
}  // namespace demecal

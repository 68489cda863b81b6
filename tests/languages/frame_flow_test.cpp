// Tools and frames that hold at a motion, whatever way the program takes there: through branches, loops, jumps and
// routines that it calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string base_of(int number) {
  return "$BASE={X " + std::to_string(number) + "00,Y 0,Z 0,A 0,B 0,C 0}\n";
}

const std::string kLine = "LIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\n";

/// Of every motion in the order of the text: the base's x in hundreds of mm as a word, "unset", or why it is unknown.
std::vector<std::string> bases(const Program& program) {
  std::vector<std::string> found;
  for (const Target& target : program.targets) {
    const StatedFrames& frames = target.frames;
    found.push_back(!frames.unknown_frame.empty() ? frames.unknown_frame
                    : frames.frame.empty()
                        ? "unset"
                        : std::to_string(std::lround(10.0 * frames.base_from_frame.translation().x())));
  }
  return found;
}

std::vector<std::string> krl_bases(const std::string& text) {
  return bases(read_program(WrittenIn::krl, text, "p", wrist_arm()));
}

const char* const kPath = "$BASE depends on the path that the program takes here";

TEST(KrlFlow, FollowsRoutinesThatSetTheBase) {
  const std::string sub = "DEF sub()\n" + base_of(2) + "END\n", keeps = "DEF keeps()\nHALT\nEND\n";
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + kLine + "sub()\n" + kLine + "END\n" + sub),
              ::testing::ElementsAre("1", "2"));
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + "keeps()\n" + kLine + "END\n" + keeps), ::testing::ElementsAre("1"));
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + "outer ( )\n" + kLine + "END\nDEF outer()\nSUB()\nEND\n" + sub),
              ::testing::ElementsAre("2"));
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + "IF f(1)==2 THEN\nHALT\nENDIF\n" + kLine +
                        "END\nDEFFCT INT f(n:IN)\n" + base_of(3) + "RETURN 1\nENDFCT\n"),
              ::testing::ElementsAre("3"));
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + "r()\n" + kLine + "END\nDEF r()\nIF x THEN\nr()\nENDIF\n" +
                        base_of(4) + "END\n"),
              ::testing::ElementsAre("4"));
}

TEST(KrlFlow, BeginsRoutinesWithWhatTheirCallersHold) {
  const std::string moves = "DEF go()\n" + kLine + "END\n";
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + "go()\n" + base_of(1) + "go()\n" + kLine + "END\n" + moves),
              ::testing::ElementsAre("1", "1"));
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + "go()\n" + base_of(2) + "go()\n" + kLine + "END\n" + moves),
              ::testing::ElementsAre("2", kPath));
  EXPECT_THAT(krl_bases("DEF m()\n" + base_of(1) + kLine + "END\n" + moves),
              ::testing::ElementsAre("1", "$BASE is set in another routine of the program"));
  EXPECT_THAT(krl_bases("DEF m()\n" + kLine + "END\n" + moves), ::testing::ElementsAre("unset", "unset"));
}

TEST(KrlFlow, JoinsThePathsThatMeet) {
  const auto one = [](const std::string& statements) {
    return krl_bases("DEF m()\n" + base_of(1) + statements + "END\n");
  };
  EXPECT_THAT(one("IF x THEN\n" + base_of(2) + kLine + "ENDIF\n" + kLine), ::testing::ElementsAre("2", kPath));
  EXPECT_THAT(one("IF x THEN\n" + base_of(2) + kLine + "ELSE\n" + kLine + base_of(2) + "ENDIF\n" + kLine),
              ::testing::ElementsAre("2", "1", "2"));
  EXPECT_THAT(one("IF x THEN\n" + base_of(2) + "RETURN\nENDIF\n" + kLine), ::testing::ElementsAre("1"));
  EXPECT_THAT(
      one("SWITCH n\nCASE 1\n" + base_of(2) + "CASE 2\n" + kLine + "DEFAULT\n" + base_of(2) + "ENDSWITCH\n" + kLine),
      ::testing::ElementsAre("1", kPath));
  EXPECT_THAT(one("SWITCH n\nCASE 1\n" + base_of(2) + "DEFAULT\n" + base_of(2) + "ENDSWITCH\n" + kLine),
              ::testing::ElementsAre("2"));
  EXPECT_THAT(one("LOOP\n" + kLine + base_of(2) + "IF x THEN\nEXIT\nENDIF\n" + kLine + "ENDLOOP\n" + kLine),
              ::testing::ElementsAre(kPath, "2", "2"));
  EXPECT_THAT(one("FOR n=1 TO 3\n" + base_of(2) + "ENDFOR\n" + kLine), ::testing::ElementsAre(kPath));
  EXPECT_THAT(one("REPEAT\n" + base_of(2) + "UNTIL x\n" + kLine), ::testing::ElementsAre("2"));
  EXPECT_THAT(one("WHILE x\nWAIT FOR y\nENDWHILE\n" + kLine), ::testing::ElementsAre("1"));
  EXPECT_THAT(one("again:\n" + kLine + base_of(2) + "IF x THEN\nGOTO again\nENDIF\n" + kLine),
              ::testing::ElementsAre(kPath, "2"));
  EXPECT_THAT(one("GOTO there\n" + base_of(2) + "there:\n" + kLine), ::testing::ElementsAre("1"));
}

TEST(KrlFlow, KnowsNothingBehindRoutinesThatMayRunAtAnyTime) {
  const std::string sub = "DEF stop()\n" + base_of(2) + "END\n";
  EXPECT_THAT(krl_bases("DEF m()\nINTERRUPT DECL 3 WHEN $IN[1] DO stop()\n" + base_of(1) + kLine + "END\n" + sub),
              ::testing::ElementsAre(HasSubstr("is set by stop, which may run at any time")));
}

TEST(KrlFlow, SaysOnceWhichOtherRoutinesAreBelieved) {
  const auto remarks = [](const std::string& text) {
    return read_program(WrittenIn::krl, "DEF m()\n" + text + "END\n", "p", wrist_arm()).remarks;
  };
  const auto said = remarks(base_of(1) + "GRIP(1)\n" + kLine + "GRIP(0)\nopen()\n" + kLine + kLine);
  ASSERT_THAT(said, SizeIs(1));
  EXPECT_EQ(said[0].place.line, 3u);
  EXPECT_THAT(said[0].sentence, HasSubstr("GRIP(), open() are not in the files given"));
  EXPECT_THAT(remarks(kLine + "GRIP(1)\n"), IsEmpty()) << "no motion comes after it";
  EXPECT_THAT(remarks("GRIP(1)\n$TOOL=$NULLFRAME\n" + base_of(1) + kLine), IsEmpty()) << "both are set after it";
  EXPECT_THAT(remarks("GRIP(1)\nPTP {A1 0,A2 0,A3 0,A4 0,A5 0,A6 0}\n"), IsEmpty()) << "joints are in no frame";
  EXPECT_THAT(remarks("BAS(#INITMOV,0)\nPULSE($OUT[1],TRUE,1)\n$OUT[2]=F(3)\n" + kLine), IsEmpty());
}

// AS and VAL II, whose statements of the kind are the same

struct LocationLanguage {
  WrittenIn language;
  std::string points;  ///< p, q and the tools a and b, 100 and 200 mm long
};

const std::vector<LocationLanguage>& location_languages() {
  static const std::vector<LocationLanguage> all{
      {WrittenIn::kawasaki_as, ".TRANS\np 1 2 3 4 5 6\nq 1 2 3 4 5 6\na 0 0 100 0 0 0\nb 0 0 200 0 0 0\n.END\n"},
      {WrittenIn::val2,
       ".LOCATIONS\np 1 0 0 0 1 0 0 0 1 1 2 3\nq 1 0 0 0 1 0 0 0 1 1 2 3\na 1 0 0 0 1 0 0 0 1 0 0 100\nb 1 0 0 0 1 0 0 "
       "0 1 0 0 200\n.END\n"}};
  return all;
}

/// The length in mm of the tool with which `name` is reached, as a word, "unset", or why it is unknown.
std::string tool_at(const LocationLanguage& in, const std::string& program, const std::string& name) {
  const std::string motion = in.language == WrittenIn::val2 ? "MOVES" : "LMOVE";
  std::string text = ".PROGRAM m\n" + program + ".END\n" + in.points;
  for (std::size_t at = 0; (at = text.find("GO ", at)) != std::string::npos; at += 3)
    if (text[at - 1] == ' ') text.replace(at, 2, motion);
  for (const Target& target : read_program(in.language, text, "p", wrist_arm()).targets) {
    if (target.name != name) continue;
    if (!target.frames.unknown_tool.empty()) return target.frames.unknown_tool;
    return target.frames.tool ? std::to_string(std::lround(1e3 * target.frames.tool->translation().z())) : "unset";
  }
  return "no target";
}

TEST(LocationFlow, FollowsProgramsThatSetTheTool) {
  for (const LocationLanguage& in : location_languages()) {
    SCOPED_TRACE(to_string(in.language));
    const auto of = [&](const std::string& program, const std::string& name = "p") {
      return tool_at(in, program, name);
    };
    const std::string sub = ".END\n.PROGRAM sub\n TOOL b\n";
    EXPECT_EQ(of(" TOOL a\n GO p\n TOOL b\n GO q\n"), "100");
    EXPECT_EQ(of(" TOOL a\n GO p\n TOOL b\n GO q\n", "q"), "200");
    EXPECT_EQ(of(" TOOL a\n GO q\n CALL sub\n GO p\n" + sub), "200");
    EXPECT_EQ(of(" TOOL a\n GO q\n CALL other\n GO p\n" + sub), "100");
    EXPECT_EQ(of(" GO p\n TOOL a\n"), "TOOL is set only after a motion to it");
    EXPECT_EQ(of(" GO p\n CALL sub\n GO p\n" + sub), "it is moved to with different tools");
    EXPECT_EQ(of(" CALL sub\n GO p\n" + sub), "200");
    const std::string depends = "TOOL depends on the path that the program takes here";
    EXPECT_EQ(of(" TOOL a\n IF x THEN\n TOOL b\n END\n GO p\n"), depends);
    EXPECT_EQ(of(" TOOL a\n IF x THEN\n TOOL b\n ELSE\n TOOL b\n END\n GO p\n"), "200");
    EXPECT_EQ(of(" TOOL a\n10 GO p\n TOOL b\n IF x GOTO 10\n"), depends);
    EXPECT_EQ(of(" TOOL a\n FOR i = 1 TO 3\n GO p\n TOOL b\n END\n"), depends);
    EXPECT_EQ(of(" TOOL a\n CASE x OF\n VALUE 1:\n TOOL b\n END\n GO p\n"), depends);
    EXPECT_EQ(of(" GO p\n"), "unset");
    EXPECT_EQ(of(" TOOL a\n GO p\n TOOL b\n GO p\n"), "it is moved to with different tools");
  }
}

TEST(LocationFlow, SaysOnceWhichOtherProgramsAreBelieved) {
  for (const LocationLanguage& in : location_languages()) {
    const std::string motion = in.language == WrittenIn::val2 ? " MOVES p\n" : " LMOVE p\n";
    const auto remarks = [&](const std::string& program) {
      return read_program(in.language, ".PROGRAM m\n" + program + ".END\n" + in.points, "p", wrist_arm()).remarks;
    };
    const auto said = remarks(" CALL grip\n" + motion + " CALL grip\n" + motion);
    ASSERT_THAT(said, SizeIs(1));
    EXPECT_EQ(said[0].place.line, 2u);
    EXPECT_THAT(said[0].sentence, HasSubstr("grip is not in the files given"));
    EXPECT_THAT(remarks(motion + " CALL grip\n"), IsEmpty());
  }
}

TEST(LocationFlow, TakesTheBaseFromTheControllersData) {
  const Eigen::Isometry3d base(Eigen::Translation3d(0.5, 0, 0));
  for (const LocationLanguage& in : location_languages()) {
    SCOPED_TRACE(to_string(in.language));
    const bool as = in.language == WrittenIn::kawasaki_as;
    const auto read = [&](const std::string& program, const ControllerData& controller) {
      const std::string motion = as ? " LMOVE p\n" : " MOVES p\n";
      const ProgramSource source(".PROGRAM m\n" + program + motion + ".END\n" + in.points, "p");
      return read_program(row_of(in.language), source, wrist_arm(), controller).targets.at(0).frames;
    };
    const std::string moved = as ? " BASE fixture\n" : " BASE dx,dy\n", key = as ? "fixture" : "base";
    EXPECT_THAT(read(moved, {}).unknown_frame, HasSubstr("--frames"));
    EXPECT_TRUE(read(moved, {.frames = {{key, base}}}).base_from_frame.isApprox(base));
    EXPECT_EQ(read(moved, {.frames = {{key, base}}}).unknown_frame, "");
    EXPECT_TRUE(read("", {.frames = {{"base", base}}}).base_from_frame.isApprox(base)) << "the program sets none";
    EXPECT_TRUE(read(as ? " BASE NULL\n" : " BASE\n", {.frames = {{"base", base}}})
                    .base_from_frame.isApprox(Eigen::Isometry3d::Identity()));
  }
  const ProgramSource named(".PROGRAM m\n BASE q\n LMOVE p\n.END\n" + location_languages()[0].points, "p");
  const Program program = read_program(row_of(WrittenIn::kawasaki_as), named, wrist_arm());
  for (const Target& target : program.targets) EXPECT_NE(target.name, "q") << "a correction would move the base";
}

TEST(KrlFrames, OfNumbersThatStatementsChangeAreComputed) {
  const std::string given = "BASE_DATA[1]={X 100,Y 0,Z 0,A 0,B 0,C 0}\n", use = "$BASE=BASE_DATA[1]\n" + kLine;
  EXPECT_THAT(krl_bases(given + use), ::testing::ElementsAre("1"));
  for (const char* change : {"BASE_DATA[1]=camera()\n", "BASE_DATA[n]=camera()\n", "BASE_DATA[1].X=7\n"})
    EXPECT_THAT(krl_bases(given + change + use), ::testing::ElementsAre(HasSubstr("is computed"))) << change;
  EXPECT_THAT(krl_bases(given + "x=BASE_DATA[1].X\nBASE_DATA[2].X=7\n" + use), ::testing::ElementsAre("1"));
}

TEST(RapidFrames, OfDataThatProceduresMayChangeAreComputed) {
  const std::string data =
      "PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
      "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n";
  const auto unknown = [&](const std::string& statements) {
    const std::string text = "MODULE m\n" + data + "PROC main()\n" + statements + "MoveL p,v1,fine,t;\nENDPROC\n" +
                             "PROC longer(PERS tooldata x)\nx.tframe.trans.z:=300;\nENDPROC\nPROC reads(tooldata x)\n" +
                             "TPWrite \"x\";\nENDPROC\nENDMODULE\n";
    return read_program(WrittenIn::rapid, text, "p", wrist_arm()).targets.at(0).frames.unknown_tool;
  };
  EXPECT_THAT(unknown("reads t;\n"), IsEmpty());
  EXPECT_THAT(unknown("longer t;\n"), HasSubstr("is computed"));
  EXPECT_THAT(unknown("MToolTCPCalib j1,j2,j3,j4,t,err;\n"), HasSubstr("is computed"));
}

/// Why the tool of each target is not known, or its frame; empty where both are.
std::vector<std::string> unknown_of(WrittenIn language, const std::string& text) {
  std::vector<std::string> found;
  for (const Target& target : read_program(language, text, "p", wrist_arm()).targets)
    found.push_back(target.frames.unknown_tool + target.frames.unknown_frame + target.not_sent_to);
  return found;
}

TEST(KrlFrames, OfWithHoldForTheirMotionAlone) {
  const std::string line = kLine.substr(0, kLine.size() - 1);
  EXPECT_THAT(unknown_of(WrittenIn::krl, base_of(1) + line + " WITH $BASE={X 7,Y 0,Z 0,A 0,B 0,C 0}\n" + kLine),
              ::testing::ElementsAre(HasSubstr("by WITH"), IsEmpty()));
  EXPECT_THAT(unknown_of(WrittenIn::krl,
                         base_of(1) + "SPLINE WITH $TOOL=f(1)\nSPL {X 1,Y 0,Z 0,A 0,B 0,C 0}\nENDSPLINE\n" + kLine),
              ::testing::ElementsAre(HasSubstr("by WITH"), IsEmpty()));
}

TEST(KrlFrames, AreUnknownWhereTheControllerChangesThem) {
  const auto only = [](const std::string& text) { return unknown_of(WrittenIn::krl, text).at(0); };
  EXPECT_THAT(only(base_of(1) + kLine), IsEmpty());
  EXPECT_THAT(only(base_of(1) + "$IPO_MODE=#TCP\n" + kLine), HasSubstr("$IPO_MODE"));
  EXPECT_THAT(only(base_of(1) + "$IPO_MODE=#BASE\n" + kLine), IsEmpty());
  EXPECT_THAT(only(base_of(1) + "BAS(#EX_BASE,1)\n" + kLine), HasSubstr("is computed"));
  const std::string data = "FDAT FP1={TOOL_NO 0,BASE_NO 0,IPO_FRAME #BASE}\n", act = "FDAT_ACT=FP1\n";
  EXPECT_THAT(only(data + act + kLine), IsEmpty());
  EXPECT_THAT(only(data + act + "FDAT_ACT.TOOL_NO=2\n" + kLine), HasSubstr("is computed"));
  EXPECT_THAT(only(data + "FP1.TOOL_NO=2\n" + act + kLine), HasSubstr("is changed"));
  EXPECT_THAT(only("BASE_DATA[1]={X 1,Y 0,Z 0,A 0,B 0,C 0}\nchange(BASE_DATA[1])\n$BASE=BASE_DATA[1]\n" + kLine),
              HasSubstr("is computed"));
  EXPECT_THAT(only(kLine.substr(0, kLine.size() - 1) + ":f\n"), HasSubstr("part of a sum"));
}

TEST(RapidConfigurations, AreNotBelievedWhereTheyAreOff) {
  const auto quadrants = [](const std::string& statement) {
    const std::string text = "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n" +
                             statement + "MoveL p,v1,fine,tool0;\n";
    return read_program(WrittenIn::rapid, text, "p", wrist_arm()).targets.at(0).hint.quadrants;
  };
  EXPECT_THAT(quadrants("ConfL\\On;\n"), SizeIs(6));
  EXPECT_THAT(quadrants("ConfL\\Off;\n"), IsEmpty());
}

TEST(OtherFrames, AreUnknownWhereInstructionsMoveThem) {
  const std::string as = ".TRANS\np 1 2 3 4 5 6\nta 0 0 9 0 0 0\n.END\n.PROGRAM s()\n TOOL ta\n.END\n.PROGRAM a()\n";
  EXPECT_THAT(unknown_of(WrittenIn::kawasaki_as, as + " TOOL ta\n ON 5 CALL s\n LMOVE p\n.END\n"),
              ::testing::Contains(HasSubstr("at any time")));
  EXPECT_THAT(
      unknown_of(WrittenIn::kawasaki_as, as + " TOOL ta\n SCASE $x OF\n SVALUE \"b\":\n TOOL\n END\n LMOVE p\n.END\n"),
      ::testing::Contains(HasSubstr("depends on the path")));
  const std::string job = "//POS\n///POSTYPE BASE\n///RECTAN\nC00001=1,2,3,4,5,6\nP00002=1,2,3,4,5,6\n//INST\nNOP\n";
  EXPECT_THAT(unknown_of(WrittenIn::yaskawa_jbi, job + "MOVL C00001\nMOVL P002\nEND\n"), SizeIs(2));
  EXPECT_THAT(unknown_of(WrittenIn::yaskawa_jbi, job + "MOVL C00001\nGETS PX002 $PX000\nMOVL P002\nEND\n"), SizeIs(1));
  EXPECT_THAT(
      unknown_of(WrittenIn::yaskawa_jbi, job + "JUMP *A IF IN#(1)=ON\nSFTON P002\nSFTOF\n*A\nMOVL C00001\nEND\n"),
      IsEmpty());
  const std::string fanuc = "/MN\n  1:L P[1] 9mm/sec FINE ;\n",
                    at = "/POS\nP[1]{\n GP1:\n UF : 0, UT : 0,\n X = 1 mm, Y = 1 mm, Z = 1 mm, W = 1 deg, P = 1 deg, R "
                         "= 1 deg\n};\n/END\n";
  EXPECT_THAT(unknown_of(WrittenIn::fanuc_ls, fanuc + at), ::testing::ElementsAre(IsEmpty()));
  EXPECT_THAT(unknown_of(WrittenIn::fanuc_ls, fanuc + "  2:  LINE[1] ON ;\n" + at),
              ::testing::ElementsAre(HasSubstr("a line that is tracked")));
  EXPECT_THAT(unknown_of(WrittenIn::val2,
                         ".LOCATIONS\np 1 0 0 0 1 0 0 0 1 10 20 30\n.END\n.PROGRAM a\n FLIP\n MOVES p\n.END\n"),
              ::testing::ElementsAre(HasSubstr("configuration (flip)")));
  const std::string drives = ".TRANS\np 1 2 3 4 5 6\n.END\n.PROGRAM a()\n LMOVE p\n DRIVE 5,180\n LMOVE p\n.END\n";
  EXPECT_THAT(read_program(WrittenIn::kawasaki_as, drives, "p", wrist_arm()).joints_lost_at,
              ::testing::Contains(drives.find("DRIVE")));
}

}  // namespace
}  // namespace demecal

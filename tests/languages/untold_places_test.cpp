// Motions to places that no number of the program tells are reported, each in its line, and end what is known of the
// joints before the next.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"
#include "parsed_programs/arrivals.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// What is said in this line (from 1): "" where nothing is, else all sentences.
std::string said_in_line(const Program& program, std::size_t line) {
  std::string said;
  for (const std::vector<Remark>* remarks : {&program.uncorrected, &program.remarks}) {
    for (const Remark& remark : *remarks) {
      if (remark.place.line == line) said += remark.name + ": " + remark.sentence + '\n';
    }
  }
  return said;
}

/// Whether what is known of the joints ends in this line of the text.
bool ends_in_line(const Program& program, const std::string& text, std::size_t line) {
  const auto is_there = [&](std::size_t at) {
    const std::string_view before = std::string_view(text).substr(0, at);
    return static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1 == line;
  };
  std::set<std::size_t> behind_others;
  for (const Stretch& stretch : program.way) behind_others.insert(stretch.next.begin(), stretch.next.end());
  for (std::size_t i = 0; i < program.way.size(); ++i) {
    if (!behind_others.contains(i) && is_there(program.way[i].begin)) return true;
  }
  return std::ranges::any_of(program.joints_lost_at, is_there);
}

/// Expects that the line of `text` is reported so, and that what is known of the joints ends there.
void expect_untold(WrittenIn language, const std::string& text, std::size_t line, const std::string& sentence) {
  SCOPED_TRACE(text);
  const Program program = read_program(language, text, "p", wrist_arm());
  EXPECT_THAT(said_in_line(program, line), HasSubstr(sentence));
  EXPECT_TRUE(ends_in_line(program, text, line));
}

const std::string kKrl =
    "DEF t()\nDECL E6POS XP1={X 1,Y 2,Z 3,A 4,B 5,C 6}\nDECL E6POS XAR[2]\nXAR[1]={X 1,Y 2,Z 3,A 4,B 5,C 6,S 2,T 2}\n";

TEST(UntoldPlaces, OfKrlAreReported) {
  for (const char* motion : {"PTP XHOME", "LIN XP5 C_DIS", "SPTP XP5 WITH $VEL_AXIS[1]=20", "CIRC XP1, XP5, CA 90",
                             "SPLINE\nSPL XP5", "lin xp5"})
    expect_untold(WrittenIn::krl, kKrl + motion + "\nEND\n", std::string_view(motion).starts_with("SPLINE") ? 6 : 5,
                  "which is no point that this program gives as numbers");
  expect_untold(WrittenIn::krl, kKrl + "PTP XHOME\n", 5, "XHOME: ");
  expect_untold(WrittenIn::krl, kKrl + "PTP XHOME\nLIN XHOME\n", 6, "'XHOME'");
  for (const char* motion : {"LIN XP1:XP5", "LIN XP1 : XAR[1]", "PTP XP5:XP1", "LIN $POS_ACT:XP5", "PTP INVERSE(XP1)"})
    expect_untold(WrittenIn::krl, kKrl + motion + "\n", 5, "is computed when the program runs");
  for (const char* motion :
       {"LIN {X 5}", "PTP {A1 x,A2 1,A3 1,A4 1,A5 1,A6 1}", "LIN {FRAME: X 1,Y 2,Z 3,A 4,B 5,C 6}"})
    expect_untold(WrittenIn::krl, kKrl + motion + "\n", 5, "left as it is");
}

TEST(UntoldPlaces, OfKrlAreNotSeenWhereEveryPlaceIsTold) {
  for (const char* motion : {"PTP XP1", "LIN XP1 C_DIS", "CIRC XP1, XP1, CA 90", "PTP XAR[1]", "PTP XAR[n]",
                             "LIN {X 1,Y 2,Z 3,A 4,B 5,C 6}", "WAIT FOR mode==#LIN", "PTP $AXIS_ACT", "; LIN XP7"}) {
    const std::string text = kKrl + motion + "\n";
    EXPECT_THAT(said_in_line(read_program(WrittenIn::krl, text, "p", wrist_arm()), 5), IsEmpty()) << motion;
  }
}

TEST(UntoldPlaces, AuxiliaryPointsOfCirclesOfKrlAreReportedAlone) {
  const std::string text = kKrl + "CIRC XP5, XP1\n";
  const Program program = read_program(WrittenIn::krl, text, "p", wrist_arm());
  EXPECT_THAT(said_in_line(program, 5), HasSubstr("'XP5', which is no point"));
  EXPECT_FALSE(ends_in_line(program, text, 5)) << "where the arm comes to is told";
}

TEST(UntoldPlaces, BothPointsOfACircleOfKrlAreReported) {
  const std::string said = said_in_line(read_program(WrittenIn::krl, kKrl + "CIRC XP5, XP6\n", "p", wrist_arm()), 5);
  EXPECT_THAT(said, HasSubstr("'XP5'"));
  EXPECT_THAT(said, HasSubstr("'XP6'"));
}

TEST(UntoldPlaces, OfRelativeMotionsOfKrlHaveTheCorrectionOfThePlaceBefore) {
  const auto said = [](const std::string& motions, std::size_t line) {
    const std::string text = kKrl + motions;
    const Program program = read_program(WrittenIn::krl, text, "p", wrist_arm());
    EXPECT_TRUE(ends_in_line(program, text, line)) << motions;
    return said_in_line(program, line);
  };
  EXPECT_THAT(said("LIN XP1\nLIN_REL {Z 90}\n", 6), IsEmpty());
  EXPECT_THAT(said("LIN XP1\nLIN_REL {X 300,Z -400} #TOOL\n", 6), HasSubstr("500 mm"));
  EXPECT_THAT(said("LIN XP1\nLIN_REL {Z 90}\nLIN_REL {Z 90}\n", 7), HasSubstr("180 mm"));
  EXPECT_THAT(said("LIN XP1\nLIN_REL {Z 90}\nLIN XP1\nSLIN_REL {Z 90}\n", 8), IsEmpty());
  EXPECT_THAT(said("PTP_REL {A1 10}\n", 5), HasSubstr("not known"));
  EXPECT_THAT(said("LIN_REL XP1\n", 5), HasSubstr("not known"));
}

// Other languages

TEST(UntoldPlaces, OfVal3AreReported) {
  const std::string data =
      "<Data name=\"j\" type=\"jointRx\"><Value j1=\"1\" j2=\"2\" j3=\"3\" j4=\"4\" j5=\"5\" j6=\"6\"/></Data>"
      "<Data name=\"k\" type=\"jointRx\"><Value j1=\"1\"/></Data>"
      "<Program name=\"start\"><Code><![CDATA[begin\nmovej(j,flange,m)\n";
  const auto of = [&](const std::string& motion) { return data + motion + "\nend]]></Code></Program>\n"; };
  expect_untold(WrittenIn::val3, of("movej(jLost,flange,m)"), 3, "jLost[0]: it is not given in this program");
  expect_untold(WrittenIn::val3, of("movej(j,flange,m)\nmovel(pLost[4],flange,m)"), 4, "pLost[4]: it is not given");
  expect_untold(WrittenIn::val3, of("movel(pLost,flange,m)\nmovel(pLost,flange,m)"), 4, "pLost[0]: it is not given");
  expect_untold(WrittenIn::val3, of("movel(appro(pLost,tr),flange,m)"), 3, "pLost[0]: it is not given");
  expect_untold(WrittenIn::val3, of("movel(compose(a,b,c),flange,m)"), 3, "a[0]: it is not given in this program");
  expect_untold(WrittenIn::val3, of("movel(compose(a,b,c)+d,flange,m)"), 3, "which is computed when the program runs");
  expect_untold(WrittenIn::val3, of("movej(j[n],flange,m)"), 3, "");
  const std::string bad = of("movej(k,flange,m)"), changed = of("movej(j,flange,m)\nj.j1=3");
  EXPECT_TRUE(ends_in_line(read_program(WrittenIn::val3, bad, "p", wrist_arm()), bad, 3)) << "it leaves numbers out";
  EXPECT_TRUE(ends_in_line(read_program(WrittenIn::val3, changed, "p", wrist_arm()), changed, 3));
  const std::string told = of("movej(j,flange,m)");
  EXPECT_THAT(read_program(WrittenIn::val3, told, "p", wrist_arm()).joints_lost_at, IsEmpty());
}

TEST(UntoldPlaces, OfYaskawaAreReported) {
  const std::string job =
      "//POS\n///POSTYPE BASE\n///RECTAN\nC00001=1,2,3,4,5,6\nP00003=1,2,3,4,5,6\n//INST\nNOP\nMOVJ C00001\n";
  expect_untold(WrittenIn::yaskawa_jbi, job + "MOVL C00002\nEND\n", 9, "C2: it is not given in this file");
  expect_untold(WrittenIn::yaskawa_jbi, job + "MOVL C00001\nMOVJ P007\nMOVJ P007\nEND\n", 11, "P7: it is not given");
  expect_untold(WrittenIn::yaskawa_jbi, job + "MOVL P[I001]\nEND\n", 9, "which is computed when the program runs");
  expect_untold(WrittenIn::yaskawa_jbi, job + "MOVL LP001\nEND\n", 9, "which is computed when the program runs");
  for (const char* motion : {"IMOV P003", "SFTON P001\nMOVL C00001", "SMOVL C00001", "SET P003 P004\nMOVL P003"}) {
    const std::string text = job + motion + "\nEND\n";
    EXPECT_TRUE(ends_in_line(read_program(WrittenIn::yaskawa_jbi, text, "p", wrist_arm()), text,
                             std::string_view(motion).find('\n') == std::string_view::npos ? 9 : 10))
        << motion;
  }
  EXPECT_THAT(read_program(WrittenIn::yaskawa_jbi, job + "MOVL P003 V=5.0 +MOVJ EC00001\nEND\n", "p", wrist_arm())
                  .joints_lost_at,
              IsEmpty());
}

TEST(UntoldPlaces, OfYaskawaAreWhereASearchStopsOnTheWay) {
  const auto of = [](const std::string& more) {
    return "//POS\n///POSTYPE BASE\n///RECTAN\nC1=1,2,3,4,5,6\nC2=2,2,3,4,5,6\n//INST\nNOP\nMOVL C1 V=10.0" + more +
           "\nMOVL C2\nEND\n";
  };
  for (const char* const search : {" UNTIL IN#(1)=ON", " PL=0 UNTIL IN#(3)=OFF"}) {
    const Program program = read_program(WrittenIn::yaskawa_jbi, of(search), "p", wrist_arm());
    EXPECT_THAT(names(program), ::testing::ElementsAre("C1", "C2")) << search;
    EXPECT_THAT(said_in_line(program, 8), IsEmpty()) << search;
    EXPECT_THAT(arrivals(program).at(program.targets.at(1).order), IsEmpty()) << search;
  }
  for (const char* const other : {"", " PL=0", " NWAIT"}) {
    const Program program = read_program(WrittenIn::yaskawa_jbi, of(other), "p", wrist_arm());
    EXPECT_THAT(arrivals(program).at(program.targets.at(1).order), ::testing::ElementsAre(program.targets.at(0).order))
        << other;
  }
}

TEST(UntoldPlaces, OfYaskawaAreAllPositionsWhereOneOfThemChangesWhoseNumberIsComputed) {
  const auto of = [](const std::string& instruction) {
    return "//POS\n///POSTYPE BASE\n///RECTAN\nC1=1,2,3,4,5,6\nP3=1,2,3,4,5,6\n//INST\nNOP\n" + instruction +
           "\nMOVJ C1\nMOVL P3\nEND\n";
  };
  for (const char* instruction : {"ADD P[I000] P010", "SET P[I000] P002", "GETS PX[B001] $PX000"}) {
    const Program program = read_program(WrittenIn::yaskawa_jbi, of(instruction), "p", wrist_arm());
    EXPECT_THAT(said_in_line(program, 5), HasSubstr("P3: it may be the one that")) << instruction;
    EXPECT_TRUE(ends_in_line(program, of(instruction), 10)) << instruction;
    EXPECT_THAT(names(program), ::testing::ElementsAre("C1"));
  }
  for (const char* instruction : {"ADD P010 P[I000]", "SET I000 1", "REFP 1 P[I000]", "MOVJ P[I000]"})
    EXPECT_THAT(names(read_program(WrittenIn::yaskawa_jbi, of(instruction), "p", wrist_arm())),
                ::testing::ElementsAre("C1", "P3"))
        << instruction;
}

TEST(UntoldPlaces, OfFanucAreReported) {
  const auto of = [](const std::string& motions, const std::string& positions = "") {
    return "/MN\n  1:J P[1] 100% FINE ;\n" + motions + "/POS\nP[1]{\n GP1:\n UF : 0, UT : 0,\n J1= 1 deg, J2= 2 deg, " +
           "J3= 3 deg, J4= 4 deg, J5= 5 deg, J6= 6 deg\n};\n" + positions + "/END\n";
  };
  expect_untold(WrittenIn::fanuc_ls, of("  2:L P[4] 9mm/sec FINE ;\n"), 3, "P[4]: it is not given in this file");
  expect_untold(WrittenIn::fanuc_ls, of("  2:J P[1] 9% FINE ;\n  3:J P[4:up] 9% FINE ;\n"), 4, "P[4]: it is not given");
  const std::string untaught =
      of("  2:L P[4] 9mm/sec FINE ;\n",
         "P[4]{\n GP1:\n UF : 0, UT : 0,\n X = ******** mm, Y = 1 mm, Z = 1 mm, W = 1 deg, P = 1 deg, R = 1 deg\n};\n");
  EXPECT_TRUE(ends_in_line(read_program(WrittenIn::fanuc_ls, untaught, "p", wrist_arm()), untaught, 3));
  EXPECT_THAT(read_program(WrittenIn::fanuc_ls, of(""), "p", wrist_arm()).joints_lost_at, IsEmpty());
}

TEST(UntoldPlaces, OfRapidAreWhereInstructionsMoveThatAreHandedTargets) {
  const auto is_known_behind = [](const std::string& statement) {
    const std::string text =
        "MODULE m\nCONST robtarget pA:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "CONST robtarget pB:=[[2,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nVAR robtarget pC;\n"
        "PROC main()\nMoveJ pA,v9,fine,tool0;\n" +
        statement + "\nMoveL pB,v9,fine,tool0;\nENDPROC\nENDMODULE\n";
    const Program program = read_program(WrittenIn::rapid, text, "p", wrist_arm());
    return !arrivals(program).at(program.targets.at(1).order).empty();
  };
  for (const char* const moves : {"SearchL\\Stop,di1,pC,pA,v9,tool0;", "ArcLStart pA,v9,sm1,wd1,fine,tool0;",
                                  "MoveHome pA,v9;", "IF di1=1 SearchC\\Stop,di1,pC,pA,pA,v9,tool0;"})
    EXPECT_FALSE(is_known_behind(moves)) << moves;
  for (const char* const stays :
       {"", "WaitTime 1;", "pC:=pA;", "TPWrite \"at\"\\Pos:=pA.trans;",
        "IF Distance(pA.trans,pB.trans)>5 THEN\nWaitTime 1;\nENDIF", "d:=Distance(pA.trans,pA.trans);",
        "MoveAbsJ [[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v9,fine,tool0;"})
    EXPECT_TRUE(is_known_behind(stays)) << stays;
}

TEST(UntoldPlaces, OfAsAndVal2AreReported) {
  const std::string as = ".TRANS\np 1 2 3 4 5 6\n.END\n.PROGRAM a()\n";
  const std::string val2 = ".LOCATIONS\np 1 0 0 0 1 0 0 0 1 10 20 30\n.END\n.PROGRAM a\n";
  for (const auto& [language, head, motion] :
       {std::tuple{WrittenIn::kawasaki_as, as, " LMOVE "}, std::tuple{WrittenIn::val2, val2, " MOVES "}}) {
    expect_untold(language, head + motion + "lost\n", 5, "lost: it is not given as numbers in this program");
    expect_untold(language, head + motion + "p\n" + motion + "#lost[2]\n", 6, "#lost[2]: it is not given as numbers");
    EXPECT_THAT(read_program(language, head + motion + "p\n", "p", wrist_arm()).joints_lost_at, IsEmpty());
  }
  expect_untold(WrittenIn::kawasaki_as, as + " LAPPRO lost,50\n", 5, "lost: it is not given as numbers");
  expect_untold(WrittenIn::val2, val2 + " APPRO lost,50\n", 5, "lost: it is not given as numbers");
  expect_untold(WrittenIn::kawasaki_as, as + " POINT lost = TRANS(x,2,3,4,5,6)\n LMOVE lost\n", 6, "lost: ");
}

TEST(UntoldPlaces, EndsOfRoutinesAndCallsOfThoseThatMoveEndWhatIsKnown) {
  const std::string krl_point = "{X 1,Y 2,Z 3,A 4,B 5,C 6}\n";
  const std::string krl = "DEF a()\nLIN " + krl_point + "b()\nLIN " + krl_point + "END\nDEF b()\nLIN " + krl_point +
                          "c()\nEND\nDEF c()\nHALT\nEND\n";
  const std::string rapid =
      "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]];\nPROC a()\nMoveL "
      "p,v1,fine,tool0;\nb;\n"
      "MoveL p,v1,fine,tool0;\nENDPROC\nPROC b()\nMoveL p,v1,fine,tool0;\nc;\nENDPROC\nPROC c()\nStop;\nENDPROC\n";
  const std::string as =
      ".TRANS\np 1 2 3 4 5 6\n.END\n.PROGRAM a()\n LMOVE p\n CALL b\n LMOVE p\n.END\n.PROGRAM b()\n LMOVE p\n CALL "
      "c\n.END\n.PROGRAM c()\n PAUSE\n.END\n";
  for (const auto& [language, text, call, next] :
       {std::tuple{WrittenIn::krl, krl, 3, 6}, std::tuple{WrittenIn::rapid, rapid, 5, 8},
        std::tuple{WrittenIn::kawasaki_as, as, 6, 9}}) {
    SCOPED_TRACE(text);
    const Program program = read_program(language, text, "p", wrist_arm());
    EXPECT_TRUE(ends_in_line(program, text, static_cast<std::size_t>(call))) << "the program called moves";
    EXPECT_TRUE(ends_in_line(program, text, static_cast<std::size_t>(next))) << "another begins";
    EXPECT_FALSE(ends_in_line(program, text, static_cast<std::size_t>(next + 2))) << "the program called does not move";
  }
}

TEST(UntoldPlaces, AreThoseOfNamesThatStandInTwoFiles) {
  const ProgramSource source({{"a.src", "PTP XP1\nLIN XP2\n"},
                              {"a.dat", "E6POS XP1={X 1,Y 2,Z 3,A 4,B 5,C 6}\nE6POS XP2={X 1,Y 2,Z 3,A 4,B 5,C 6}\n"},
                              {"b.dat", "E6POS XP1={X 9,Y 2,Z 3,A 4,B 5,C 6}\n"}});
  const Program program = read_program(row_of(WrittenIn::krl), source, wrist_arm());
  ASSERT_THAT(program.targets, SizeIs(1));
  EXPECT_TRUE(ends_in_line(program, source.text(), 1));
}

TEST(UntoldPlaces, AreWhereAConditionMayStopAMotionOfAs) {
  const std::string as = ".PROGRAM t()\n JMOVE p\n";
  const auto rest = std::string("\n LMOVE p\n.END\n.TRANS\np 1 2 3 4 5 6\n.END\n");
  const auto program_with = [&](const std::string& motion) {
    return read_program(WrittenIn::kawasaki_as, as + motion + rest, "p", wrist_arm());
  };
  const Program stopped = program_with(" XMOVE p TILL 1001"), straight = program_with(" XMOVE p");
  EXPECT_TRUE(ends_in_line(stopped, as + " XMOVE p TILL 1001" + rest, 3));
  EXPECT_FALSE(ends_in_line(straight, as + " XMOVE p" + rest, 3));
  EXPECT_THAT(said_in_line(stopped, 3), IsEmpty());
}

TEST(UntoldPlaces, OfBlockStepsAreReportedAndChangeTheTool) {
  const std::string as = ".TRANS\np 1 2 3 4 5 6\nt 0 0 50 0 0 0\n.END\n.PROGRAM a()\n TOOL t\n";
  const std::string aside = " ACCU1 TIMER0 TOOL1 WORK0 CLAMP1 (OFF,0,0,O) OX= WX= #[1,2,3,4,5,6] ;\n";
  for (const char* const step : {" JOINT SPEED9", " LINEAR 250.", " CIR1 SPEED9"}) {
    const std::string text = as + step + aside + " LMOVE p\n.END\n";
    expect_untold(WrittenIn::kawasaki_as, text, 7, "the block step goes to #[1,2,3,4,5,6], which is not corrected");
    const Program program = read_program(WrittenIn::kawasaki_as, text, "p", wrist_arm());
    ASSERT_THAT(program.targets, SizeIs(1));
    EXPECT_THAT(program.targets[0].frames.unknown_tool, HasSubstr("a block step selects")) << text;
  }
  const std::string alone = ".TRANS\np 1 2 3 4 5 6\n.END\n.PROGRAM a()\n JOINT SPEED9" + aside + " LMOVE p\n.END\n";
  EXPECT_EQ(read_program(WrittenIn::kawasaki_as, alone, "p", wrist_arm()).targets.at(0).frames.unknown_tool, "");
  const std::string told = as + " LMOVE p\n PRINT \"#[1,2]\"\n.END\n";
  EXPECT_THAT(said_in_line(read_program(WrittenIn::kawasaki_as, told, "p", wrist_arm()), 8), IsEmpty());
}

TEST(UntoldPlaces, ThatAreToolsOrBasesAreReported) {
  const std::string as = ".TRANS\np 1 2 3 4 5 6\n.END\n.PROGRAM a()\n BASE p\n LMOVE p\n.END\n",
                    val2 = ".LOCATIONS\np 1 0 0 0 1 0 0 0 1 1 2 3\n.END\n.PROGRAM a()\n TOOL p\n MOVES p\n.END\n";
  for (const auto& [language, text] : {std::pair{WrittenIn::kawasaki_as, as}, std::pair{WrittenIn::val2, val2}}) {
    const Program program = read_program(language, text, "p", wrist_arm());
    EXPECT_THAT(said_in_line(program, 2), HasSubstr("p: TOOL or BASE of this program is set to it"));
    EXPECT_TRUE(ends_in_line(program, text, 6));
  }
}

}  // namespace
}  // namespace demecal

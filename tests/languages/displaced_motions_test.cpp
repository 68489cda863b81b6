// Motions that end elsewhere than at their point: those that sensors, registers or other groups shift, points that
// statements compute with, and arms that give way. Each is left, or said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// A program, and what became of it.
struct DisplacedProgram {
  Program program;
  std::vector<std::string> corrected{};  ///< the names of targets that nothing keeps from being corrected
  std::string left{};                    ///< "NAME: why", in lines
  std::string warned{};                  ///< the sentences of remarks
};

DisplacedProgram read_displaced(WrittenIn language, const std::string& text) {
  const Eigen::Isometry3d any(Eigen::Translation3d(1, 2, 3));
  const ProgramSource source(text, "p");
  DisplacedProgram read{read_program(row_of(language), source, wrist_arm(), {.tools = {{"0", any}}})};
  for (const Target& target : read.program.targets) {
    const std::string why = target.not_sent_to + target.frames.unknown_frame + target.frames.unknown_tool;
    if (why.empty()) read.corrected.push_back(target.name);
    if (!why.empty()) read.left += target.name + ": " + why + '\n';
  }
  for (const Remark& remark : read.program.uncorrected) read.left += remark.name + ": " + remark.sentence + '\n';
  for (const Remark& remark : read.program.remarks) read.warned += remark.sentence + '\n';
  return read;
}

/// Whether what is known of the joints ends at `statement`.
bool loses_joints(const DisplacedProgram& read, const std::string& text, const std::string& statement) {
  return std::ranges::count(read.program.joints_lost_at, text.find(statement)) > 0;
}

// FANUC

std::string fanuc_listing(const std::string& instructions, int positions) {
  std::string text = "/PROG T\n/MN\n" + instructions + "/POS\n";
  for (int number = 1; number <= positions; ++number)
    text += "P[" + std::to_string(number) +
            "]{\n GP1:\n UF : 0, UT : 0,\n X = 1 mm, Y = 2 mm, Z = 3 mm, W = 4 deg, P = 5 deg, R = 6 deg\n};\n";
  return text + "/END\n";
}

DisplacedProgram read_fanuc(const std::string& instructions, int positions) {
  return read_displaced(WrittenIn::fanuc_ls, fanuc_listing(instructions, positions));
}

TEST(DisplacedMotions, OfFanucWithOtherGroupsAndStandingToolsAreLeft) {
  const DisplacedProgram read = read_fanuc(
      " 1:L P[1] 9mm/sec FINE ;\n 2:L P[2] 9mm/sec FINE COORD PTH ;\n 3:L P[3] 9mm/sec FINE COORD[LDR] ;\n"
      " 4:L P[4] 9mm/sec FINE RTCP ;\n",
      4);
  EXPECT_THAT(read.corrected, ElementsAre("P[1]"));
  EXPECT_THAT(read.left,
              AllOf(HasSubstr("P[2]: a motion to it goes with what another group of motion moves (COORD)"),
                    HasSubstr("P[3]: a motion to it goes with"), HasSubstr("P[4]: a motion to it is told by a tool")));
}

TEST(DisplacedMotions, OfFanucThatSensorsAndPassesShiftAreLeft) {
  const DisplacedProgram read = read_fanuc(
      " 1:L P[1] 9mm/sec FINE ;\n 2:  Track TAST[1] RPM[2] ;\n 3:L P[2] 9mm/sec FINE ;\n 4:  Track End ;\n"
      " 5:L P[3] 9mm/sec FINE ;\n 6:  MP Offset PR[1] RPM[1] ;\n 7:L P[4] 9mm/sec FINE ;\n 8:  MP Offset End ;\n"
      " 9:L P[5] 9mm/sec FINE ;\n 10:  !Track AVC[1] ;\n 11:L P[6] 9mm/sec FINE ;\n",
      6);
  EXPECT_THAT(read.corrected, ElementsAre("P[1]", "P[3]", "P[5]", "P[6]"));
  EXPECT_THAT(read.left, AllOf(HasSubstr("P[2]: a motion to it is shifted by Track, which follows sensors"),
                               HasSubstr("P[4]: a motion to it is shifted by MP Offset, which is computed")));
}

TEST(DisplacedMotions, OfFanucAreLeftWhereJumpsAndBranchesLeadIntoOrOutOfAShift) {
  const std::string inside = " 2:  Track TAST[1] ;\n 3:L P[2] 9mm/sec FINE ;\n", last = " 9:L P[3] 9mm/sec FINE ;\n";
  const auto read = [&](const std::string& before, const std::string& middle, const std::string& after) {
    return read_fanuc(" 1:L P[1] 9mm/sec FINE ;\n" + before + inside + middle + " 4:  Track End ;\n" + after + last, 3);
  };
  EXPECT_THAT(read("", "", "").corrected, ElementsAre("P[1]", "P[3]"));
  EXPECT_THAT(read("", " 5:  LBL[1] ;\n 6:  JMP LBL[1] ;\n", "").corrected, ElementsAre("P[1]", "P[3]"));
  EXPECT_THAT(read("", " 5:  IF R[1]=1,JMP LBL[7] ;\n", " 6:  LBL[7] ;\n").corrected, IsEmpty());
  EXPECT_THAT(read(" 5:  LBL[7] ;\n", " 6:  JMP LBL[7] ;\n", "").left,
              HasSubstr("P[3]: the program jumps or branches"));
  EXPECT_THAT(read(" 5:  IF (R[1]=1) THEN ;\n", "", " 6:  ENDIF ;\n").corrected, ElementsAre("P[1]", "P[3]"));
  EXPECT_THAT(read("", " 5:  IF (R[1]=1) THEN ;\n", " 6:  ENDIF ;\n").corrected, IsEmpty());
}

TEST(DisplacedMotions, OfFanucThatMoveGroupsByThemselvesAreThoseOfTheFirst) {
  const std::string moves =
      " 1:J P[1] 9% FINE ;\n 2:  Independent GP \n  :  GP1:L P[2] 9mm/sec FINE INC\n  :  GP2:J P[3] 9% FINE ;\n"
      " 3:L P[4] 9mm/sec FINE ;\n 4:  Simultaneous GP \n  :  GP1:L P[5] 9mm/sec FINE\n  :  GP2:J P[5] 9% FINE INC ;\n";
  const DisplacedProgram read = read_fanuc(moves, 5);
  EXPECT_THAT(read.corrected, ElementsAre("P[1]", "P[3]", "P[4]", "P[5]"));
  EXPECT_THAT(read.left, HasSubstr("P[2]: a motion goes by it and not to it (INC)"));
  const auto last = std::ranges::find(read.program.targets, std::string("P[5]"), &Target::name);
  EXPECT_EQ(last->motion, Motion::line);
  EXPECT_EQ(last->order, fanuc_listing(moves, 5).find("L P[5]"));
  EXPECT_THAT(last->further_motions, IsEmpty()) << "GP2 moves by itself";
}

TEST(DisplacedMotions, OfFanucThatTrackALineByAnyInstructionAreLeft) {
  for (const char* const tracking :
       {"LINECOUNT[1] R[1]", "SELBOUND LNSCH[1] BOUND[1]", "STOP_TRACKING", "ACCUTRIG LNSCH[1]"})
    EXPECT_THAT(read_fanuc(" 1:  " + std::string(tracking) + " ;\n 2:L P[1] 9mm/sec FINE ;\n", 1).left,
                HasSubstr("P[1]: it may move with a line that is tracked"))
        << tracking;
}

TEST(DisplacedMotions, ToPositionsThatFanucComputesWithAreLeft) {
  const auto corrected = [](const std::string& instruction) {
    return read_fanuc(" 1:L P[1] 9mm/sec FINE ;\n 2:  " + instruction + " ;\n", 2).corrected;
  };
  for (const char* const computes : {"PR[1]=P[1]-P[2]", "PR[1]=PR[2]+P[1]", "R[1]=P[1,3]", "UFRAME[3]=P[1]"})
    EXPECT_THAT(corrected(computes), Not(::testing::Contains("P[1]"))) << computes;
  for (const char* const keeps : {"PR[1]=P[1]", "PR[1:up]=P[1:home]", "PR[1]=PR[2]", "!R[1]=P[1,3]", "R[1]=R[2]"})
    EXPECT_THAT(corrected(keeps), ElementsAre("P[1]", "P[2]")) << keeps;
  EXPECT_THAT(read_fanuc(" 1:  PR[1]=P[1]-P[2] ;\n", 2).left, HasSubstr("line 3 uses it otherwise than to move to it"));
}

TEST(DisplacedMotions, OfFanucAlongSplinesAreLines) {
  const DisplacedProgram read = read_fanuc(" 1:S P[1] 9mm/sec CNT100 ;\n 2:S P[2] 9mm/sec CNT100 Offset,PR[1] ;\n", 2);
  EXPECT_THAT(read.corrected, ElementsAre("P[1]"));
  EXPECT_EQ(read.program.targets.front().motion, Motion::line);
}

TEST(DisplacedMotions, OfArmsThatGiveWayAreSaid) {
  const std::string fanuc =
      " 1:  SOFTFLOAT[1] ;\n 2:L P[1] 9mm/sec FINE ;\n 3:  SOFTFLOAT END ;\n 4:  FORCE CTRL[2] ;\n";
  EXPECT_THAT(read_fanuc(fanuc, 1).warned,
              AllOf(HasSubstr("behind SOFTFLOAT the arm gives way to forces, up to SOFTFLOAT END"),
                    HasSubstr("behind FORCE CTRL")));
  EXPECT_THAT(read_fanuc(fanuc, 1).corrected, SizeIs(1));
  const std::string ur = "def t():\n movel(p[1,2,3,0,1,0])\n force_mode(p[0,0,0,0,0,0])\n end_force_mode()\nend\n";
  EXPECT_THAT(read_displaced(WrittenIn::urscript, ur).warned, HasSubstr("behind force_mode() the arm gives way"));
  const std::string abb =
      "VAR robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC a()\n MoveL p,v9,fine,tool0;\n";
  EXPECT_THAT(read_displaced(WrittenIn::rapid, abb + " SoftAct 2,20;\nENDPROC\n").warned, HasSubstr("behind SoftAct"));
  EXPECT_THAT(read_displaced(WrittenIn::rapid, abb + " FCAct tool0;\nENDPROC\n").warned, HasSubstr("behind FCAct"));
  EXPECT_THAT(read_displaced(WrittenIn::rapid, abb + "ENDPROC\n").warned, IsEmpty());
}

// Other languages

TEST(DisplacedMotions, OfRapidWhoseExternalAxesAreOffsetAreLeft) {
  const auto left = [](const std::string& axes, const std::string& statement) {
    return read_displaced(WrittenIn::rapid, "VAR robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[" + axes +
                                                ",9E9,9E9,9E9,9E9,9E9]];\nPROC a()\n " + statement +
                                                "\n MoveL p,v9,fine,tool0;\nENDPROC\n")
        .left;
  };
  EXPECT_THAT(left("0", "EOffsSet [100,0,0,0,0,0];"),
              HasSubstr("eax_a, may carry the arm (EOffsOn or EOffsSet moves it)"));
  EXPECT_THAT(left("0", "EOffsOn \\ExeP:=q,r;"), HasSubstr("eax_a, may carry the arm"));
  EXPECT_THAT(left("0", "EOffsOff;"), IsEmpty());
  EXPECT_THAT(left("9E9", "EOffsSet [100,0,0,0,0,0];"), IsEmpty());
}

TEST(DisplacedMotions, OfKrlThatSensorsShiftAreLeft) {
  const auto left = [](const std::string& statement) {
    return read_displaced(WrittenIn::krl,
                          "DEF t()\n$TOOL=TOOL_DATA[0]\n$BASE=$NULLFRAME\n" + statement +
                              "\nPTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}\nLIN {X 1,Y 2,Z 3,A 4,B 5,C 6}\nEND\n")
        .left;
  };
  for (const char* const sensor : {"RET=RSI_ON(#RELATIVE)", "ST_ON(id,0)", "$TECH[1].MODE=#CYCLE", "RSI_MOVECORR()"})
    EXPECT_THAT(left(sensor), HasSubstr("the program lets sensors displace motions")) << sensor;
  for (const char* const other : {"RET=RSI_OFF()", "$TECH[1].MODE=#OFF", "; RSI_ON()", "$ORI_TYPE=#VAR", "rsi_on=1"})
    EXPECT_THAT(left(other), IsEmpty()) << other;
  EXPECT_THAT(left("$ORI_TYPE=#CONSTANT"), HasSubstr(": lines may end with another orientation")) << "the pose alone";
  EXPECT_EQ(std::ranges::count(left("$ORI_TYPE = #CONSTANT"), '\n'), 1);
}

TEST(DisplacedMotions, OfKrlAlongCirclesByAnAngleEndWhatIsKnown) {
  const std::string text = "DEF t()\nCIRC {X 1,Y 2,Z 3,A 4,B 5,C 6},{X 2,Y 2,Z 3,A 4,B 5,C 6},CA 360\nEND\n";
  EXPECT_TRUE(loses_joints(read_displaced(WrittenIn::krl, text), text, "CA 360"));
  const std::string plain = "DEF t()\nCIRC {X 1,Y 2,Z 3,A 4,B 5,C 6},{X 2,Y 2,Z 3,A 4,B 5,C 6} C_DIS\nEND\n";
  EXPECT_THAT(read_displaced(WrittenIn::krl, plain).program.joints_lost_at, IsEmpty());
}

TEST(DisplacedMotions, OfVal2AreLeft) {
  const auto read = [](const std::string& statement) {
    return read_displaced(WrittenIn::val2,
                          ".PROGRAM t\n MOVES p\n " + statement +
                              "\n MOVES q\n.END\n.LOCATIONS\np 1 0 0 0 1 0 0 0 1 10 20 30\nq 1 0 0 0 1 0 0 0 "
                              "1 40 50 60\n#r 1 2 3 4 5 6\n.END\n");
  };
  EXPECT_THAT(read("ALTER (-1) 0,0,10").corrected, IsEmpty());
  EXPECT_THAT(read("ALTER (-1) 0,0,10").left,
              HasSubstr("q: the program lets motions be altered while they run (ALTER)"));
  for (const char* const computes : {"WINDOW %b = p,30", "y = DX(p)", "IF DISTANCE(p,#r) < 5 THEN"})
    EXPECT_THAT(read(computes).left, HasSubstr("p: line 3 uses it otherwise than to move to it")) << computes;
  for (const char* const other : {"TYPE \"at p\"", "DECOMPOSE x[1] = p", "y = x", "SIGNAL 3", "NOALTER"})
    EXPECT_THAT(read(other).corrected, ElementsAre("p", "q", "#r")) << other;
  EXPECT_THAT(read("CIRCLE p,q").program.joints_lost_at, Not(IsEmpty())) << "it may move";
  EXPECT_THAT(read("SPEED x").program.joints_lost_at, IsEmpty());
}

TEST(DisplacedMotions, OfKawasakiAreLeft) {
  const auto read = [](const std::string& statement) {
    return read_displaced(WrittenIn::kawasaki_as, ".PROGRAM t()\n TOOL NULL\n LMOVE p\n " + statement +
                                                      "\n LMOVE q\n.END\n.TRANS\np 1 2 3 4 5 6\nq 1 2 3 4 5 6\n.END\n");
  };
  EXPECT_THAT(read("ALTER ON").left,
              AllOf(HasSubstr("p: the program lets motions be altered"), HasSubstr("q: the program")));
  for (const char* const unknown : {"CVLMOVE p,1", "LWC p,1,2", "x = DX(p)", "IF DISTANCE(p,x)<5 THEN"}) {
    EXPECT_THAT(read(unknown).corrected, ElementsAre("q")) << unknown;
    EXPECT_THAT(read(unknown).left, HasSubstr("p: line 4 uses it otherwise than to move to it")) << unknown;
  }
  for (const char* const other : {"PRINT \"p\"", "DECOMPOSE a[0]=p", "x = 3", "SIGNAL 3", "SPEED 30 ALWAYS"})
    EXPECT_THAT(read(other).corrected, ElementsAre("p", "q")) << other;
  EXPECT_THAT(read("LWC p,1,2").program.joints_lost_at, SizeIs(2)) << "it may move, and its point is left";
}

TEST(DisplacedMotions, OfVal3AreLeftAndTheirToolIsKnown) {
  const std::string six = "x=\"1\" y=\"2\" z=\"3\" rx=\"4\" ry=\"5\" rz=\"6\"/>",
                    tool = "<Data name=\"t\" type=\"tool\"><Value ";
  const auto read = [&](const std::string& motion) {
    return read_displaced(WrittenIn::val3, tool + six + "</Data><Data name=\"p\" type=\"pointRx\"><Value key=\"0\" " +
                                               six + "<Value key=\"1\" " + six +
                                               "</Data><Program name=\"a\"><Code><![CDATA[begin\n movel(p[1],t,m)\n " +
                                               motion + "\nend]]></Code></Program>");
  };
  for (const char* const word : {"alterMovel", "alterMovej", "movelf", "movejf"}) {
    const DisplacedProgram found = read(std::string(word) + "(p[0],t,m)");
    EXPECT_THAT(found.corrected, ElementsAre("p[1]")) << word;
    EXPECT_THAT(found.left, HasSubstr("p[0]: the program uses it in " + std::string(word))) << word;
    EXPECT_THAT(found.program.joints_lost_at, SizeIs(1)) << word;
  }
  EXPECT_THAT(read("alterMovec(p[0],p[1],t,m)").corrected, IsEmpty());
  EXPECT_THAT(read("movel(p[0],t,m)").corrected, ElementsAre("p[0]", "p[1]"));
}

TEST(DisplacedMotions, OfYaskawaThatAnArcSensorShiftsAreLeft) {
  const auto read = [](const std::string& instructions) {
    return read_displaced(
        WrittenIn::yaskawa_jbi,
        "//POS\n///POSTYPE BASE\n///RECTAN\nC00001=1,2,3,4,5,6\nC00002=1,2,3,4,5,6\nC00003=1,2,3,4,5,6\n"
        "//INST\nNOP\n" +
            instructions + "END\n");
  };
  const std::string sensor = "MOVL C00001\nCOMARCON AMP=9\nMOVL C00002\nCOMARCOF\nMOVL C00003\n";
  EXPECT_THAT(read(sensor).corrected, ElementsAre("C00001", "C00003"));
  EXPECT_THAT(read(sensor).left, HasSubstr("C00002: it is moved to while an arc sensor shifts motions (COMARCON)"));
  EXPECT_THAT(read(sensor + "CALL JOB:B\n").corrected, IsEmpty());
  EXPECT_THAT(read("SFTON P001\nCOMARCON\nCOMARCOF\nMOVL C00001\nSFTOF\nMOVL C00002\nMOVL C00003\n").corrected,
              ElementsAre("C00002", "C00003"));
  EXPECT_THAT(read("MOVL C00001\nSYMOVL C00002 CV#(1)\nMOVL C00003\n").program.joints_lost_at, SizeIs(1));
}

}  // namespace
}  // namespace demecal

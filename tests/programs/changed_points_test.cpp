// Points whose numbers are not where the robot goes: a program changes them, displaces them or hands them on. They are
// left as they are, and a sentence says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "judged_points.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// KRL

std::string krl_point(int number) {
  return pose_line(WrittenIn::krl, flange_pose(), usual_joints(), number, 4) + '\n';
}

std::string of_krl(const std::string& statements, const std::string& name = "XP1") {
  const std::string points = krl_point(1) + krl_point(2) + "DECL E6AXIS XHOME={A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\n";
  const std::string code = "$BASE=$NULLFRAME\n$TOOL=$NULLFRAME\nPTP XHOME\nPTP XP1\nPTP XP2\n" + statements + "END\n";
  const std::string alone = judged(WrittenIn::krl, "DEF t()\n" + points + code, name);
  const std::string beside =
      judged(WrittenIn::krl, {{"t.src", "DEF t()\n" + code}, {"t.dat", "DEFDAT t\n" + points + "ENDDAT\n"}}, name);
  EXPECT_EQ(alone.substr(0, 5), beside.substr(0, 5)) << statements;
  return alone;
}

TEST(Krl, LeavesPointsThatTheProgramChanges) {
  EXPECT_THAT(of_krl("FDAT_ACT=FP1\nXP9=XP1\n"), StartsWith("corrected:"));
  EXPECT_THAT(of_krl("", "XHOME"), StartsWith("corrected:"));
  for (const char* change : {"XP1.X=300\n", "XP1=XP2\n", "xp1 = $POS_ACT\n", "XP1=XP2:XP3\n", "XP1=XAR[2]\n",
                             "XP1=INVERSE(XP2)\n", "IF $IN[1] THEN\n  XP1.Z=XP1.Z+100\nENDIF\n"})
    EXPECT_THAT(of_krl(change), AllOf(StartsWith("left: line "), HasSubstr(kChanged))) << change;
  EXPECT_THAT(of_krl("XHOME.A2=-60\n", "XHOME"), AllOf(StartsWith("left:"), HasSubstr(kChanged)));
}

TEST(Krl, LeavesPointsThatAreHandedOn) {
  for (const char* use : {"SUB(XP1)\n", "XP9=XP2:XP1\n", "LIN XP1:XP2\n", "F1=FRAME_OF(XP1)\n"})
    EXPECT_THAT(of_krl(use), AllOf(StartsWith("left:"), HasSubstr(kUsed))) << use;
}

TEST(Krl, ReadsEveryPointOfAMotionInItsPlace) {
  const std::string text = "DEF t()\n" + krl_point(3) +
                           "$BASE=$NULLFRAME\n$TOOL=$NULLFRAME\nPTP {A1 10,A2 -60,A3 70,A4 "
                           "20,A5 50,A6 5}\n";
  for (const char* motion : {"CIRC XP8,XP3,CA 90\n", "SPLINE\nSPL XP3\nENDSPLINE\n", "SCIRC XP8, XP3\n"}) {
    EXPECT_THAT(judged(WrittenIn::krl, {{"t.src", text + motion + "END\n"}, {"t.dat", "DEFDAT t\nENDDAT\n"}}, "XP3"),
                StartsWith("corrected:"))
        << motion;
    const std::string points = "DEFDAT t\n" + krl_point(3) + "ENDDAT\n";
    const std::string code = text.substr(0, 8) + text.substr(text.find("$BASE")) + motion + "END\n";
    EXPECT_THAT(judged(WrittenIn::krl, {{"t.src", code}, {"t.dat", points}}, "XP3"), StartsWith("corrected:"))
        << motion;
  }
}

TEST(Krl, LeavesPointsThatATrackMayCarry) {
  std::string point = krl_point(1);
  point.replace(point.find("E1 0.0"), 6, "E1 200");
  EXPECT_THAT(judged(WrittenIn::krl, "$BASE=$NULLFRAME\n$TOOL=$NULLFRAME\n" + point + "PTP XP1\n", "XP1"),
              AllOf(StartsWith("left:"), HasSubstr("E1, may carry the arm")));
}

// URScript

std::string of_urscript(const std::string& statements, const std::string& name) {
  return judged(
      WrittenIn::urscript,
      "qa = [0.2,-1.0,1.2,0.35,0.9,0.1]\nqb = [0.2,-1.0,1.2,0.35,0.9,0.1]\nmovej(qa)\nmovej(qb)\n" + statements, name);
}

TEST(UrScript, LeavesVariablesThatTheProgramChanges) {
  EXPECT_THAT(of_urscript("qc = qa\n", "qb"), StartsWith("corrected:"));
  EXPECT_THAT(of_urscript("movej(qa, a=1.2)\nqc = qb\n", "qa"), StartsWith("corrected:"));
  for (const char* change : {"qa[1] = -0.6\n", "qa = get_actual_joint_positions()\n", "qa = qb\n"})
    EXPECT_THAT(of_urscript(change + std::string("movej(qa)\n"), "qa"), AllOf(StartsWith("left:"), HasSubstr(kChanged)))
        << change;
  EXPECT_THAT(of_urscript("qc = qb\nqc[1] = -0.4\nmovej(qc)\n", "qc"),
              AllOf(StartsWith("left:"), HasSubstr("computed when the program runs")));
  for (const char* use : {"go(qa)\n", "qc = bent(qa, 0.1)\n"})
    EXPECT_THAT(of_urscript(use, "qa"), AllOf(StartsWith("left:"), HasSubstr(kUsed))) << use;
}

TEST(UrScript, LeavesRotationVectorsLongerThanATurn) {
  const auto first = [](const std::string& vector) {
    return judged(WrittenIn::urscript, "movej([0.2,-1.0,1.2,0.35,0.9,0.1])\nmovel(p[0.5,0.3,0.4," + vector + "])\n",
                  "");
  };
  EXPECT_THAT(first("27.687,61.358,127.069"), HasSubstr("143.8 rad long"));
  EXPECT_THAT(first("0.5,1.5,2.5"), ::testing::Not(HasSubstr("rad long")));
}

// VAL II, FANUC and Kawasaki AS

std::string of_val2(const std::string& statements, const std::string& name = "mcp[1]") {
  const std::string points = pose_line(WrittenIn::val2, tool_pose(), usual_joints(), 1, 5) + '\n' +
                             pose_line(WrittenIn::val2, tool_pose(), usual_joints(), 2, 5) + '\n' +
                             joints_line(WrittenIn::val2, usual_joints(), 1, 4) + '\n' +
                             joints_line(WrittenIn::val2, usual_joints(), 2, 4) + '\n';
  return judged(WrittenIn::val2,
                ".PROGRAM t\n  MOVE #cp[1]\n  MOVES mcp[1]\n" + statements + ".END\n.LOCATIONS\n" + points + ".END\n",
                name);
}

TEST(Val2, LeavesLocationsThatTheProgramChanges) {
  EXPECT_THAT(of_val2("  MOVES mcp[2]\n  SET x = mcp[1]\n"), StartsWith("corrected:"));
  for (const char* change : {"  SET mcp[1] = SHIFT(mcp[1] BY 0,0,100)\n", " 10 SET mcp[1]=TRANS(1,2,3,0,0,0)\n",
                             "  HERE mcp[1]\n", "  HERE mcp[i]\n", "  SET mcp[n+1] = x\n"})
    EXPECT_THAT(of_val2(change), AllOf(StartsWith("left:"), HasSubstr(kChanged))) << change;
  EXPECT_THAT(of_val2("  HERE mcp[2]\n"), StartsWith("corrected:"));
  EXPECT_THAT(of_val2("  SET #cp[1] = #PPOINT(1,2,3,4,5,6)\n", "#cp[1]"),
              AllOf(StartsWith("left:"), HasSubstr(kChanged)));
  for (const char* name : {"mcp[1]", "mcp[2]"})
    EXPECT_THAT(of_val2("  MOVES mcp[2]:mcp[1]\n", name), AllOf(StartsWith("left:"), HasSubstr(kUsed)));
}

TEST(Val2, KnowsTheJointsBeforeALineThatItsMotionsName) {
  EXPECT_EQ(of_val2("").find("is not known"), std::string::npos) << of_val2("");
  EXPECT_THAT(of_val2(""), StartsWith("corrected:"));
  EXPECT_THAT(of_val2("  APPROS mcp[1], 300\n"), HasSubstr("300 mm away from it"));
}

TEST(FanucLs, LeavesPositionsThatTheProgramChanges) {
  const auto of = [](const std::string& statement) {
    return judged(WrittenIn::fanuc_ls,
                  "/MN\n   1:J P[1] 100% FINE    ;\n" + statement + "/POS\n" +
                      joints_line(WrittenIn::fanuc_ls, usual_joints(), 1, 3) + '\n' + "/END\n",
                  "P[1]");
  };
  EXPECT_THAT(of("   2:  PR[1]=P[1]    ;\n"), StartsWith("corrected:"));
  for (const char* change :
       {"   2:  P[1]=LPOS    ;\n", "   2:  P[1,3:*]=P[1,3:*]+10    ;\n", "   2:  P[R[1]]=JPOS    ;\n",
        "   2:  P[1:up]=PR[2]    ;\n", "   2:  IF DI[1]=ON,P[1]=JPOS ;\n"})
    EXPECT_THAT(of(change), AllOf(StartsWith("left:"), HasSubstr(kChanged))) << change;
}

TEST(KawasakiAs, CorrectsLocationsOnTheWayToWhichAConditionMayStop) {
  const auto of_as = [](const std::string& motions) {
    return judged(WrittenIn::kawasaki_as,
                  ".PROGRAM t()\n" + motions + ".END\n.TRANS\n" +
                      pose_line(WrittenIn::kawasaki_as, tool_pose(), usual_joints(), 1, 4) + "\n.END\n.JOINTS\n" +
                      joints_line(WrittenIn::kawasaki_as, usual_joints(), 1, 4) + "\n.END\n",
                  "p1");
  };
  const std::string before = "  JMOVE #p1\n", straight = of_as(before + "  XMOVE p1\n");
  EXPECT_THAT(straight, StartsWith("corrected:"));
  for (const char* stopped : {"  XMOVE p1 TILL 1001\n", "  XMOVE p1 till -1001 \n", "  LMOVE p1 TILL sig1\n"})
    EXPECT_EQ(of_as(before + stopped), straight) << stopped;
}

TEST(KawasakiAs, LeavesLocationsThatTheProgramChanges) {
  const auto of = [](const std::string& statement) {
    return judged(WrittenIn::kawasaki_as,
                  ".PROGRAM t()\n  JMOVE #p1\n  LMOVE p1\n" + statement + ".END\n.TRANS\n" +
                      pose_line(WrittenIn::kawasaki_as, tool_pose(), usual_joints(), 1, 4) + "\n.END\n.JOINTS\n" +
                      joints_line(WrittenIn::kawasaki_as, usual_joints(), 1, 4) + "\n.END\n",
                  "p1");
  };
  EXPECT_THAT(of("  DECOMPOSE x[0] = p1\n  LAPPRO p1,50\n"), StartsWith("corrected:"));
  for (const char* change : {"  POINT/Z p1 = 200\n", "  POINT /OAT p1 = q\n", "  POINT p1 = q\n", "  HERE p1\n"})
    EXPECT_THAT(of(change), StartsWith("left:")) << change;
  for (const char* use : {"  POINT f = FRAME(p1,p2,p3,p1)\n", "  CALL go(p1)\n"})
    EXPECT_THAT(of(use), AllOf(StartsWith("left:"), HasSubstr("not followed"))) << use;
  EXPECT_THAT(of("  LAPPRO p1,300\n"), AllOf(StartsWith("corrected:"), HasSubstr("300 mm away from it")));
}

// Where the arm comes from

TEST(UnknownMotions, EndWhatIsKnownOfTheJointsBefore) {
  const auto of_as = [](const std::string& between) {
    return judged(WrittenIn::kawasaki_as,
                  ".PROGRAM t()\n  JMOVE #p1\n" + between + "  LMOVE p1\n.END\n.TRANS\n" +
                      pose_line(WrittenIn::kawasaki_as, tool_pose(), usual_joints(), 1, 4) + "\n.END\n.JOINTS\n" +
                      joints_line(WrittenIn::kawasaki_as, usual_joints(), 1, 4) + "\n.END\n",
                  "p1");
  };
  EXPECT_THAT(of_as(""), StartsWith("corrected:"));
  EXPECT_THAT(of_as("  JMOVE SHIFT(q BY 0,0,9)\n"), AllOf(StartsWith("left:"), HasSubstr("is not known")));
  const auto of_krl_line = [](const std::string& between) {
    const std::string line = krl_point(1);
    const std::string pose = line.substr(line.find('{'), line.find(",S 2") - line.find('{')) + "}\n";
    return judged(
        WrittenIn::krl,
        "$BASE=$NULLFRAME\n$TOOL=$NULLFRAME\nPTP {A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\n" + between + "LIN " + pose,
        "");
  };
  EXPECT_THAT(of_krl_line("; LIN_REL {Z 9}\n"), ::testing::Not(HasSubstr("is not known")));
  for (const char* between : {"PTP XP7\n", "LIN_REL {Z 9}\n", "PTP $AXIS_ACT\n"})
    EXPECT_THAT(of_krl_line(between), HasSubstr("is not known")) << between;
  const auto of_line = [](const std::string& between) {
    const Eigen::Isometry3d pose = tool_pose();
    return judged(WrittenIn::urscript,
                  joints_line(WrittenIn::urscript, usual_joints(), 1, 5) + '\n' + between +
                      pose_line(WrittenIn::urscript, pose, usual_joints(), 1, 5),
                  "");
  };
  EXPECT_THAT(of_line(""), ::testing::Not(HasSubstr("is not known")));
  EXPECT_THAT(of_line("movej(elsewhere)\n"), HasSubstr("is not known"));
}

}  // namespace
}  // namespace demecal

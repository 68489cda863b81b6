// UFRAME_NUM and UTOOL_NUM of FANUC programs against the UF and UT of their positions: where they disagree the
// controller stops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kMove = "L P[1] 9mm/sec FINE ;\n";

/// Why the position, of UF 2 and UT 3, is left; empty: it is not.
std::string left(const std::string& instructions, const std::string& position = "UF : 2, UT : 3,") {
  const std::string text = "/MN\n" + instructions + "/POS\nP[1]{\n GP1:\n " + position +
                           " CONFIG : 'N U T, 0, 0, 0',\n X = 1 mm, Y = 2 mm, Z = 3 mm,\n W = 4 deg, P = 5 deg, R = 6 "
                           "deg\n};\n/END\n";
  return read_program(WrittenIn::fanuc_ls, text, "p", wrist_arm()).targets.at(0).not_sent_to;
}

TEST(FanucFrameNumbers, LeavePositionsThatTheyDisagreeWith) {
  EXPECT_THAT(left("1: UFRAME_NUM=2 ;\n2: UTOOL_NUM=3 ;\n3:" + kMove), IsEmpty());
  EXPECT_THAT(left("1: UFRAME_NUM=4 ;\n2:" + kMove),
              AllOf(HasSubstr("line 3 moves to it with UFRAME_NUM=4"), HasSubstr("UF is 2"), HasSubstr("stops")));
  EXPECT_THAT(left("1: UTOOL_NUM = 1 ;\n2:" + kMove), AllOf(HasSubstr("UTOOL_NUM=1"), HasSubstr("UT is 3")));
  EXPECT_THAT(left("1: UFRAME_NUM=2 ;\n2:" + kMove + "3: UFRAME_NUM=0 ;\n4:" + kMove), HasSubstr("line 5 moves"));
  EXPECT_THAT(left("1: UFRAME_NUM=4 ;\n2: UFRAME_NUM=2 ;\n3:" + kMove), IsEmpty());
  EXPECT_THAT(left("1: UFRAME_NUM=4 ;\n2:" + kMove, "UF : F, UT : F,"), IsEmpty()) << "any frame";
  EXPECT_THAT(left("1:" + kMove + "2: UFRAME_NUM=4 ;\n"), IsEmpty()) << "what holds before is not told";
}

TEST(FanucFrameNumbers, OfTheFirstGroupOfMotionCount) {
  for (const char* number : {"UTOOL_NUM[GP1]=1", "UTOOL_NUM[1]=1", "$MNUTOOLNUM[1]=1"})
    EXPECT_THAT(left("1: " + std::string(number) + " ;\n2:" + kMove), HasSubstr("UTOOL_NUM=1")) << number;
  for (const char* number : {"UTOOL_NUM[GP1]=3", "UTOOL_NUM[GP2]=1", "$MNUTOOLNUM[2]=1", "UFRAME_NUM[GP1]=2"})
    EXPECT_THAT(left("1: " + std::string(number) + " ;\n2:" + kMove), IsEmpty()) << number;
}

TEST(FanucFrameNumbers, AreTakenForDifferentOnlyWhereTheyAreCertain) {
  for (const char* before :
       {"1: UFRAME_NUM=4 ;\n2: CALL SET ;\n", "1: UFRAME_NUM=4 ;\n2: IF R[1]=2,CALL SET ;\n", "1: UFRAME_NUM=R[1] ;\n",
        "1: UFRAME_NUM=4 ;\n2: IF (DI[1]),UFRAME_NUM=2 ;\n", "1: !UFRAME_NUM=4 ;\n",
        "1: UFRAME_NUM=4 ;\n2: IF (DI[1]) THEN ;\n3: UFRAME_NUM=2 ;\n4: ENDIF ;\n",
        "1: UFRAME_NUM=2 ;\n2: IF DI[1]=ON,JMP LBL[1] ;\n3: UFRAME_NUM=4 ;\n4: LBL[1:here] ;\n",
        "1: UFRAME_NUM=2 ;\n2: JMP LBL[1] ;\n3: UFRAME_NUM=4 ;\n4: LBL[1] ;\n"})
    EXPECT_THAT(left(before + kMove), IsEmpty()) << before;
  EXPECT_THAT(left("1: UFRAME_NUM=4 ;\n2: IF (DI[1]) THEN ;\n3: WAIT 1 ;\n4: ELSE ;\n5: ENDIF ;\n" + kMove),
              HasSubstr("UFRAME_NUM=4"));
  EXPECT_THAT(left("1: UFRAME_NUM=4 ;\n2: JMP LBL[1] ;\n3: UFRAME_NUM=2 ;\n4: LBL[1] ;\n" + kMove),
              HasSubstr("UFRAME_NUM=4"));
}

TEST(FanucFrameNumbers, OfFramesThatTheProgramSetsGiveNoKnownFrame) {
  const auto frames = [](const std::string& instruction) {
    const std::string text = "/MN\n 1: " + instruction +
                             " ;\n/POS\nP[1]{\n GP1:\n UF : 2, UT : 3,\n X = 1 mm, Y = 2 mm, "
                             "Z = 3 mm, W = 4 deg, P = 5 deg, R = 6 deg\n};\n/END\n";
    const ProgramSource source(text, "p");
    const Eigen::Isometry3d any(Eigen::Translation3d(1, 2, 3));
    return read_program(row_of(WrittenIn::fanuc_ls), source, wrist_arm(),
                        {.frames = {{"2", any}}, .tools = {{"3", any}}})
        .targets.at(0)
        .frames;
  };
  EXPECT_THAT(frames("UFRAME[1]=PR[4]").unknown_frame, IsEmpty());
  EXPECT_THAT(frames("UFRAME[2]=PR[4]").unknown_frame, HasSubstr("line 2 changes it"));
  EXPECT_THAT(frames("UTOOL[3]=PR[4]").unknown_tool, HasSubstr("line 2 changes it"));
  EXPECT_THAT(frames("UTOOL[R[1]]=PR[4]").unknown_tool, HasSubstr("line 2 changes it"));
  EXPECT_THAT(frames("PR[4]=UFRAME[2]").unknown_frame, IsEmpty());
}

TEST(FanucFrameNumbers, OfZeroAreTheBaseAndTheFlangeWhateverIsGiven) {
  const auto said = [](const std::string& numbers, const Eigen::Isometry3d& zero) {
    const std::string text = "/MN\n 1:" + kMove + "/POS\nP[1]{\n GP1:\n " + numbers +
                             "\n X = 1 mm, Y = 2 mm, Z = 3 mm, W = 4 deg, P = 5 deg, R = 6 deg\n};\n/END\n";
    const ProgramSource source(text, "p");
    const Eigen::Isometry3d any(Eigen::Translation3d(1, 2, 3));
    const Program program = read_program(row_of(WrittenIn::fanuc_ls), source, wrist_arm(),
                                         {.frames = {{"0", zero}, {"2", any}}, .tools = {{"0", zero}, {"3", any}}});
    std::string all;
    for (const Remark& remark : program.remarks) all += remark.sentence + '\n';
    return all;
  };
  const Eigen::Isometry3d none = Eigen::Isometry3d::Identity(), other(Eigen::Translation3d(0.5, 0, 0));
  EXPECT_THAT(said("UF : 0, UT : 3,", other), AllOf(HasSubstr("frame 0"), HasSubstr("they are not used")));
  EXPECT_THAT(said("UF : 2, UT : 0,", other), AllOf(HasSubstr("tool 0"), HasSubstr("the flange")));
  EXPECT_THAT(said("UF : 2, UT : 3,", other), IsEmpty());
  EXPECT_THAT(said("UF : 0, UT : 0,", none), IsEmpty());
}

}  // namespace
}  // namespace demecal

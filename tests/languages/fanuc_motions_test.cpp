// FANUC: positions of other groups of motion, and motions and changes that are not those of P[n].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"
#include "parsed_programs/arrivals.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Eigen::Isometry3d any_frame() {
  return Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3));
}

std::string listing(const std::string& instructions, const std::string& positions) {
  return "/MN\n" + instructions + "/POS\n" + positions + "/END\n";
}

std::string position(int number, const std::string& group = "GP1:") {
  return "P[" + std::to_string(number) + "]{\n " + group +
         "\n UF : 2, UT : 3,\n X = 1 mm, Y = 2 mm, Z = 3 mm, W = 4 deg, P = 5 deg, R = 6 deg\n};\n";
}

Program read_listing(const std::string& instructions, const std::string& positions) {
  const ProgramSource source(listing(instructions, positions), "p");
  return read_program(row_of(WrittenIn::fanuc_ls), source, wrist_arm(),
                      {.frames = {{"2", any_frame()}}, .tools = {{"3", any_frame()}}});
}

std::string said(const Program& program) {
  std::string all;
  for (const std::vector<Remark>* remarks : {&program.uncorrected, &program.remarks}) {
    for (const Remark& remark : *remarks)
      all += std::to_string(remark.place.line) + ' ' + remark.name + ": " + remark.sentence + '\n';
  }
  return all;
}

bool ends_at(const Program& program, const std::string& text, const std::string& statement) {
  const std::size_t begin = text.find(statement);
  return std::ranges::any_of(program.joints_lost_at, [&](std::size_t at) { return at == begin; });
}

/// The name of the target that the motion at a byte goes to.
std::string target_at(const Program& program, std::size_t motion) {
  const auto found = std::ranges::find(program.targets, motion, &Target::order);
  return found == program.targets.end() ? "?" : found->name;
}

TEST(FanucMotions, ToPositionsOfOtherGroupsAloneAreLeft) {
  const std::string moves = " 1:J P[1] 9% FINE ;\n 2:L P[2] 9mm/sec FINE ;\n";
  const Program other = read_listing(moves, position(1) + position(2, "GP2:"));
  EXPECT_THAT(names(other), ElementsAre("P[1]"));
  EXPECT_THAT(said(other), HasSubstr("P[2]: it is of another group of motion than the first"));
  EXPECT_TRUE(ends_at(other, listing(moves, ""), "L P[2]"));
  for (const std::string group : {"GP1:", "",
                                  "GP1:\n UF : 2, UT : 3,\n X = 1 mm, Y = 2 mm, Z = 3 mm, W = 4 deg, P = 5 "
                                  "deg, R = 6 deg\n GP2:"}) {
    const Program program = read_listing(moves, position(1) + position(2, group));
    EXPECT_THAT(names(program), ElementsAre("P[1]", "P[2]")) << group;
    EXPECT_EQ(program.targets.at(1).frames.frame, "UF 2") << group;
    EXPECT_THAT(said(program), IsEmpty()) << group;
  }
}

TEST(FanucMotions, ToPlacesOfPalletsAreSaidAndEndWhatIsKnown) {
  for (const std::string goal : {"PAL_1[A_1]", "PAL_2[BTM]", "PAL_1[R_2]"}) {
    const std::string moves = " 1:J P[1] 9% FINE ;\n 2:L " + goal + " 9mm/sec FINE ;\n 3:J P[2] 9% FINE ;\n";
    const Program program = read_listing(moves, position(1) + position(2));
    EXPECT_THAT(said(program), HasSubstr("3 : the motion goes to '" + goal + "', which is computed")) << goal;
    EXPECT_TRUE(ends_at(program, listing(moves, ""), "L " + goal)) << goal;
    EXPECT_THAT(names(program), ElementsAre("P[1]", "P[2]"));
  }
  EXPECT_THAT(said(read_listing(" 1:J PR[1] 9% FINE INC ;\n", position(1))), HasSubstr("goes to a register"));
}

TEST(FanucMotions, WhoseWristGoesByJointsKeepNoConfiguration) {
  const auto motion = [](const std::string& options) {
    return read_listing(" 1:L P[1] 9mm/sec FINE" + options + " ;\n", position(1)).targets.at(0).motion;
  };
  EXPECT_EQ(motion(" Wjnt"), Motion::joints);
  EXPECT_EQ(motion(" ACC50 Wjnt"), Motion::joints);
  EXPECT_EQ(motion(" ACC50"), Motion::line);
}

TEST(FanucMotions, ThatTouchOffsetShiftsAreLeft) {
  const Program program = read_listing(
      " 1:J P[1] 9% FINE ;\n 2:Touch Offset PR[1] ;\n 3:L P[2] 9mm/sec FINE ;\n 4:Touch Offset End ;\n 5:L P[3] "
      "9mm/sec FINE ;\n",
      position(1) + position(2) + position(3));
  EXPECT_THAT(names(program), ElementsAre("P[1]", "P[3]"));
  EXPECT_THAT(said(program), AllOf(HasSubstr("P[2]: "), HasSubstr("shifted by Touch Offset")));
}

TEST(FanucMotions, AreReadBehindAQuoteOfInches) {
  const std::string inches[] = {" 1:  ! a 5\" pipe ;\n 2:L P[1] 9mm/sec FINE INC ;\n",
                                " 1:L P[1:5\" up] 9mm/sec FINE INC ;\n", " 1:L P[1:\"up] 9mm/sec FINE INC ;\n"};
  for (const std::string& instructions : inches) {
    const Program program = read_listing(instructions, position(1));
    EXPECT_THAT(names(program), IsEmpty()) << instructions;
    EXPECT_THAT(said(program), HasSubstr("P[1]: a motion goes by it and not to it (INC)")) << instructions;
  }
}

TEST(FanucMotions, ThatMayStopOnTheWayAreNoPlaceToComeFrom) {
  const auto origins = [](const std::string& skip) {
    const std::string moves = " 1:J P[1] 9% FINE ;\n 2:L P[2] 9mm/sec FINE" + skip +
                              " ;\n 3:L P[3] 9mm/sec FINE ;\n 4:END ;\n 5:LBL[7:missed] ;\n 6:L P[4] 9mm/sec FINE ;\n";
    const Program program = read_listing(moves, position(1) + position(2) + position(3) + position(4));
    EXPECT_THAT(names(program), ElementsAre("P[1]", "P[2]", "P[3]", "P[4]")) << skip;
    EXPECT_THAT(said(program), IsEmpty()) << skip;
    std::map<std::string, std::string> names_of_origins;
    for (const auto& [motion, from] : arrivals(program)) {
      std::string& all = names_of_origins[target_at(program, motion)];
      for (const std::size_t origin : from) all += target_at(program, origin);
    }
    return names_of_origins;
  };
  using Origins = std::map<std::string, std::string>;
  for (const char* const skip : {" Skip,LBL[7]", " SKIP,LBL[7:missed]", " ACC50 Skip,LBL[7],PR[5:hit]=LPOS"})
    EXPECT_EQ(origins(skip), (Origins{{"P[1]", ""}, {"P[2]", "P[1]"}, {"P[3]", ""}, {"P[4]", "P[2]"}})) << skip;
  EXPECT_EQ(origins(" Search[-Z]"), (Origins{{"P[1]", ""}, {"P[2]", "P[1]"}, {"P[3]", ""}, {"P[4]", ""}}));
  EXPECT_EQ(origins(" ACC50"), (Origins{{"P[1]", ""}, {"P[2]", "P[1]"}, {"P[3]", "P[2]"}, {"P[4]", ""}}));
}

TEST(FanucMotions, OfProgramsThatDoNotMoveTheFirstGroupAreLeft) {
  const auto read_with = [](const std::string& groups) {
    const ProgramSource source("/PROG T\n/ATTR\nTCD: STACK_SIZE = 0;\nDEFAULT_GROUP\t= " + groups + ";\n" +
                                   listing(" 1:J P[1] 9% FINE ;\n", position(1)),
                               "p");
    return read_program(row_of(WrittenIn::fanuc_ls), source, wrist_arm(),
                        {.frames = {{"2", any_frame()}}, .tools = {{"3", any_frame()}}});
  };
  for (const char* const other : {"*,1,*,*,*", "*,*,*,*,*", " * , 1"}) {
    EXPECT_THAT(names(read_with(other)), IsEmpty()) << other;
    EXPECT_THAT(said(read_with(other)), HasSubstr("P[1]: the program does not move the first group of motion"))
        << other;
  }
  for (const char* const first : {"1,*,*,*,*", "1,1,*,*,*", "1"}) {
    EXPECT_THAT(names(read_with(first)), ElementsAre("P[1]")) << first;
    EXPECT_THAT(said(read_with(first)), IsEmpty()) << first;
  }
}

TEST(FanucMotions, AreInFramesThatSystemVariablesChange) {
  const auto frames = [](const std::string& instruction) {
    return read_listing(" 1:" + instruction + " ;\n 2:L P[1] 9mm/sec FINE ;\n", position(1)).targets.at(0).frames;
  };
  EXPECT_THAT(frames("$MNUTOOL[1,3]=PR[1]").unknown_tool, HasSubstr("line 2 changes it"));
  EXPECT_THAT(frames("$MNUFRAME[1,2]=PR[1]").unknown_frame, HasSubstr("line 2 changes it"));
  EXPECT_THAT(frames("$MNUFRAME[R[1],R[2]]=PR[1]").unknown_frame, HasSubstr("line 2 changes it"));
  for (const char* other :
       {"$MNUTOOL[1,4]=PR[1]", "$MNUTOOL[2,3]=PR[1]", "PR[1]=$MNUTOOL[1,3]", "$MNUFRAME[1,3]=PR[1]"})
    EXPECT_THAT(frames(other).unknown_tool + frames(other).unknown_frame, IsEmpty()) << other;
}

TEST(FanucJoints, SayHowJointThreeIsTakenToCountWhereTheRobotDoesNot) {
  const auto read = [](const std::string& position, const Chain& arm) {
    const ProgramSource source(listing("1: J P[1] 9% FINE ;\n", position), "p");
    return read_program(row_of(WrittenIn::fanuc_ls), source, arm, {}).joint_counting;
  };
  const std::string joints =
      "P[1]{\n GP1:\n UF : 0, UT : 0,\n J1 = 1 deg, J2 = 2 deg, J3 = 3 deg,"
      " J4 = 4 deg, J5 = 5 deg, J6 = 6 deg\n};\n";
  Chain arm = wrist_arm();
  EXPECT_THAT(read(joints, arm), HasSubstr("Joint 3 is taken to count against link 2"));
  EXPECT_THAT(read(position(1), arm), IsEmpty());
  arm.couplings.push_back({2, 1, 1.0});
  EXPECT_THAT(read(joints, arm), IsEmpty());
}

}  // namespace
}  // namespace demecal

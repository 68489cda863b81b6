// $BASE=$ROBROOT of KRL: the frame that the robot stands in, wherever in the world that is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "languages/named_languages.hpp"
#include "rail_cell.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(RobotRoot, IsTheFrameThatTheRobotStandsIn) {
  const std::string lin = "LIN {X 10,Y 0,Z 0,A 0,B 0,C 0}\n";
  for (const char* root : {"$BASE=$ROBROOT\n", "$BASE = $ROBROOT\n", "$BASE=$WORLD\n",
                           "$ROBROOT={X 9,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=$ROBROOT\n"}) {
    const std::string text = std::string("$BASE={X 5,Y 0,Z 0,A 0,B 0,C 0}\n") + root + lin;
    const Program program = read_program(WrittenIn::krl, text, "p", wrist_arm());
    ASSERT_EQ(program.targets.size(), 1u);
    EXPECT_EQ(program.targets[0].frames.unknown_frame, "") << root;
    EXPECT_LT((stated_point(program.targets[0]) - Eigen::Vector3d(0.01, 0.0, 0.0)).norm(), 1e-12) << root;
  }
}

TEST(RobotRoot, ThatIsMovedLeavesWhatIsStatedInTheWorld) {
  const std::string lin = "LIN {X 10,Y 0,Z 0,A 0,B 0,C 0}\n", moved = "$ROBROOT={X 9,Y 0,Z 0,A 0,B 0,C 0}\n";
  for (const std::string& statements :
       {moved, moved + "$BASE=$WORLD\n", moved + "$BASE={X 1,Y 0,Z 0,A 0,B 0,C 0}\n",
        std::string("$BASE=$ROBROOT:shift\n"), std::string("$ROBROOT.X=4\n$BASE=$WORLD\n")}) {
    const Program program = read_program(WrittenIn::krl, statements + lin, "p", wrist_arm());
    ASSERT_EQ(program.targets.size(), 1u);
    EXPECT_NE(program.targets[0].frames.unknown_frame, "") << statements;
  }
}

TEST(RobotRoot, OfAnArmOnARailMayMoveAlong) {
  const RailCell cell = rail_cell(20, 1);
  const std::string text = "$BASE=$ROBROOT\nLIN {X 10,Y 0,Z 0,A 0,B 0,C 0,E1 100}\n";
  const Program program = read_program(WrittenIn::krl, text, "p", cell.model.nominal.chain);
  ASSERT_EQ(program.targets.size(), 1u);
  EXPECT_THAT(program.targets[0].frames.unknown_frame, HasSubstr("may move along with the rail"));
}

}  // namespace
}  // namespace demecal

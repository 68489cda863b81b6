// Kawasaki AS: steps as pendants teach them (JOINT SPEED9 ... #[...]), their tools, and locations with external axes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string step(const std::string& kind, const std::string& numbers, const std::string& tool = "TOOL1") {
  return "  " + kind + " SPEED9 ACCU1 TIMER0 " + tool + " WORK0 CLAMP1 (OFF,0,0,O) 2 (OFF,0,0,O) OX= WX= #[" + numbers +
         "] ;\n";
}

Program read_steps(const std::string& statements, const ControllerData& controller = {}) {
  const ProgramSource source(".PROGRAM t() #0\n" + statements + ".END\n.TRANS\np 1 2 3 4 5 6\ng 0 0 100 0 0 0\n.END\n",
                             "p");
  return read_program(row_of(WrittenIn::kawasaki_as), source, wrist_arm(), controller);
}

const Target& location_p(const Program& program) {
  return *std::ranges::find(program.targets, std::string("p"), &Target::name);
}

TEST(KawasakiSteps, AreMotionsToJoints) {
  const Program program =
      read_steps(step("JOINT", "-97.059,-38.081,-121,0.062402,39.309,15.375") + step("LINEAR", "1, 2 ,3,4,5,6,700"));
  EXPECT_THAT(program.uncorrected, IsEmpty());
  ASSERT_THAT(program.targets, SizeIs(4));  // and p and g
  const Target &first = program.targets.at(0), &second = program.targets.at(1);
  EXPECT_THAT(values(first.joints), ElementsAre(-97.059, -38.081, -121, 0.062402, 39.309, 15.375));
  EXPECT_THAT(values(second.joints), ElementsAre(1, 2, 3, 4, 5, 6)) << "external axes are kept";
  EXPECT_EQ(first.motion, Motion::joints);
  EXPECT_EQ(second.motion, Motion::line);
  EXPECT_EQ(first.place.line, 2U);
}

TEST(KawasakiSteps, ThatAreNotReadAreSaid) {
  for (const char* const numbers : {"1,2,3,4,5", "1,2,x,4,5,6", "1,2,3"}) {
    const Program program = read_steps(step("JOINT", numbers));
    ASSERT_THAT(program.uncorrected, SizeIs(1)) << numbers;
    EXPECT_EQ(program.uncorrected.front().place.line, 2U);
  }
  EXPECT_THAT(read_steps("  JOINT SPEED9 TOOL1 #[1,2\n").uncorrected, SizeIs(1)) << "it is never closed";
}

TEST(KawasakiSteps, SelectTheToolOfLocationsAfterThem) {
  const auto frames = [](const std::string& statements, const ControllerData& controller = {}) {
    return location_p(read_steps(statements, controller)).frames;
  };
  const std::string joints = "1,2,3,4,5,6";
  EXPECT_THAT(frames("  TOOL g\n" + step("JOINT", joints) + "  LMOVE p\n").unknown_tool,
              HasSubstr("tool 1 is given neither in this program nor by --frames"));
  EXPECT_THAT(frames(step("JOINT", joints) + "  TOOL g\n  LMOVE p\n").tool_name, "g");
  EXPECT_THAT(frames("  LMOVE p\n  TOOL g\n  LMOVE p\n" + step("JOINT", joints)).unknown_tool,
              ::testing::Not(IsEmpty()));
  const Eigen::Isometry3d third(Eigen::Translation3d(0, 0, 3));
  const StatedFrames known = frames(step("JOINT", joints, "TOOL3") + "  LMOVE p\n", {.tools = {{"3", third}}});
  EXPECT_THAT(known.unknown_tool, IsEmpty());
  ASSERT_TRUE(known.tool);
  EXPECT_TRUE(known.tool->isApprox(third));
}

TEST(KawasakiLocations, WithAnExternalAxisThatMayCarryTheArmAreLeft) {
  const auto left = [](const std::string& location) {
    return read_program(WrittenIn::kawasaki_as, ".PROGRAM t()\n LMOVE q\n.END\n.TRANS\nq " + location + "\n.END\n", "p",
                        wrist_arm())
        .targets.at(0)
        .not_sent_to;
  };
  EXPECT_THAT(left("1 2 3 4 5 6 700"), HasSubstr("an external axis, JT7, may carry the arm"));
  EXPECT_THAT(left("1 2 3 4 5 6 0 -8.5"), HasSubstr("JT8"));
  EXPECT_THAT(left("1 2 3 4 5 6 0 0.000"), IsEmpty());
  EXPECT_THAT(left("1 2 3 4 5 6"), IsEmpty());
}

}  // namespace
}  // namespace demecal

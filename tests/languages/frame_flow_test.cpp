// Tools and frames that hold at a motion, whatever way the program takes there: through branches, loops, jumps and
// routines that it calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace demecal

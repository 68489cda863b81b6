// Which tool of set_tcp() holds at a motion of URScript, whatever way the program takes there, and which variables are
// believed.
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

/// Of every motion in the order of the text: the tool's z in hundreds of mm as a word, "unset", or why it is unknown.
std::vector<std::string> ur_tools(const std::string& text) {
  std::vector<std::string> found;
  for (const Target& target : read_program(WrittenIn::urscript, text, "p", wrist_arm()).targets) {
    const StatedFrames& frames = target.frames;
    found.push_back(!frames.unknown_tool.empty() ? frames.unknown_tool
                    : !frames.tool               ? "unset"
                                                 : std::to_string(std::lround(10.0 * frames.tool->translation().z())));
  }
  return found;
}

std::string tcp(int number) {
  return "set_tcp(p[0,0,0." + std::to_string(number) + ",0,0,0])\n";
}

const std::string kLineTo = "movel(p[0.1,0.2,0.3,0,0,0])\n";
const char* const kToolsPath = "the tool of set_tcp depends on the path that the program takes here";

TEST(UrScriptFlow, FollowsFunctionsThatSetTheTool) {
  EXPECT_THAT(ur_tools("def m():\n def f():\n" + tcp(2) + " end\n" + tcp(1) + kLineTo + "f()\n" + kLineTo + "end\n"),
              ::testing::ElementsAre("1", "2"));
  EXPECT_THAT(ur_tools("def f():\n" + tcp(2) + "end\ndef m():\n" + kLineTo + tcp(1) + kLineTo + "x = f() + 1\n" +
                       kLineTo + "end\n"),
              ::testing::ElementsAre("unset", "1", "2"));
  EXPECT_THAT(
      ur_tools("def g():\n" + tcp(3) + " return 1\nend\ndef f():\n return g()\nend\n" + tcp(1) + "f()\n" + kLineTo),
      ::testing::ElementsAre("3"));
}

TEST(UrScriptFlow, BeginsFunctionsWithWhatTheirCallersHold) {
  const std::string go = " def go():\n" + kLineTo + " end\n";
  EXPECT_THAT(ur_tools("def m():\n" + go + tcp(1) + "go()\n" + kLineTo + "end\n"), ::testing::ElementsAre("1", "1"));
  EXPECT_THAT(ur_tools("def m():\n" + go + tcp(1) + "go()\n" + tcp(2) + "go()\nend\n"),
              ::testing::ElementsAre(kToolsPath));
  EXPECT_THAT(ur_tools("def a():\n" + tcp(1) + "end\ndef b():\n" + kLineTo + "end\n"),
              ::testing::ElementsAre(HasSubstr("is set in another routine")));
}

TEST(UrScriptFlow, DoesNotBelieveOneOfTwoPaths) {
  EXPECT_THAT(ur_tools(tcp(1) + "if x:\n" + tcp(2) + "end\n" + kLineTo), ::testing::ElementsAre(kToolsPath));
  EXPECT_THAT(ur_tools(tcp(1) + "if x:\n" + tcp(2) + "elif y:\n" + tcp(2) + "else:\n" + tcp(2) + "end\n" + kLineTo),
              ::testing::ElementsAre("2"));
  EXPECT_THAT(ur_tools(tcp(1) + "while x:\n" + kLineTo + tcp(2) + kLineTo + "end\n"),
              ::testing::ElementsAre(kToolsPath, "2"));
  EXPECT_THAT(ur_tools(tcp(1) + "while x:\n" + kLineTo + "if y:\n" + tcp(2) + "continue\nend\n" + tcp(1) + "end\n"),
              ::testing::ElementsAre(kToolsPath));
  EXPECT_THAT(ur_tools(tcp(1) + "while x:\nif y:\n" + tcp(2) + "break\nend\nend\n" + kLineTo),
              ::testing::ElementsAre(kToolsPath));
  EXPECT_THAT(ur_tools("def f():\nif x:\nreturn 1\nend\n" + tcp(2) + "end\n" + tcp(1) + "f()\n" + kLineTo),
              ::testing::ElementsAre(kToolsPath));
}

TEST(UrScriptFlow, TakesWhatConditionsAndArgumentsCallBeforeWhatFollows) {
  const std::string sets = "def f():\n" + tcp(2) + "return True\nend\n";
  EXPECT_THAT(ur_tools(sets + tcp(1) + "if f():\nsleep(1)\nelse:\n" + kLineTo + "end\n"), ::testing::ElementsAre("2"));
  EXPECT_THAT(ur_tools(sets + tcp(1) + "if x:\nsleep(1)\nelif f():\nsleep(1)\nelse:\n" + kLineTo + "end\n" + kLineTo),
              ::testing::ElementsAre("2", kToolsPath));
  EXPECT_THAT(ur_tools(sets + tcp(1) + "while f():\n" + tcp(3) + "end\n" + kLineTo), ::testing::ElementsAre("2"));
  EXPECT_THAT(ur_tools(sets + tcp(1) + "movel(p[0.1,0.2,0.3,0,0,0], v=f())\n"), ::testing::ElementsAre("2"));
  EXPECT_THAT(ur_tools(sets + "def g():\nreturn (1 +\n f())\nend\n" + tcp(1) + "g()\n" + kLineTo),
              ::testing::ElementsAre("2"));
}

TEST(UrScriptFlow, MeansTheFunctionOfItsOwnScope) {
  const auto part = [](const char* name, int tool) {
    return std::string("def ") + name + "():\n def grip():\n" + tcp(tool) + " end\n grip()\n" + kLineTo + "end\n";
  };
  EXPECT_THAT(ur_tools(part("a", 1) + part("b", 2)), ::testing::ElementsAre("1", "2"));
  const std::string twice = "def grip():\n" + tcp(1) + "end\ndef grip():\n" + tcp(2) + "end\n";
  EXPECT_THAT(ur_tools(twice + "grip()\n" + kLineTo), ::testing::ElementsAre(kToolsPath));
}

TEST(UrScriptFlow, BelievesNoVariableThatMayBeAnything) {
  const std::string tool = "t=p[0,0,0.1,0,0,0]\n", computed = "the tool of set_tcp is computed when the program runs";
  EXPECT_THAT(ur_tools(tool + "set_tcp(t)\n" + kLineTo), ::testing::ElementsAre("1"));
  EXPECT_THAT(ur_tools(tool + "t[2]=0.3\nset_tcp(t)\n" + kLineTo), ::testing::ElementsAre(computed));
  EXPECT_THAT(ur_tools("t=p[0,0,0.1,0,0,0]+o\nset_tcp(t)\n" + kLineTo), ::testing::ElementsAre(computed));
  EXPECT_THAT(ur_tools(tool + "def use(t):\nset_tcp(t)\n" + kLineTo + "end\nuse(p[0,0,0.3,0,0,0])\n"),
              ::testing::ElementsAre(computed));
  EXPECT_THAT(ur_tools("s=struct(t=p[0,0,0.1,0,0,0])\nset_tcp(t)\n" + kLineTo), ::testing::ElementsAre(computed));
  EXPECT_THAT(
      ur_tools(tcp(1) + "movej(get_inverse_kin(p[0.1,0.2,0.3,0,0,0], [0,0,0,0,0,0], 1e-9, 1e-9, p[0,0,0.2,0,0,0]))\n"),
      ::testing::ElementsAre("2"));
  EXPECT_THAT(ur_tools(tcp(1) + "movej(get_inverse_kin(tcp=p[0,0,0.3,0,0,0], x=p[0.1,0.2,0.3,0,0,0]))\n"),
              ::testing::ElementsAre("3"));
}

TEST(UrScriptFlow, TakesNoNumbersThatAreNotTheWholePlace) {
  const auto targets = [](const std::string& text) {
    return read_program(WrittenIn::urscript, text, "p", wrist_arm()).targets;
  };
  for (const char* text :
       {"movel(p[0.1,0.2,0.3,0,0,0]+o)\n", "q=[0,1,1,0,1,0]*d\nmovej(q)\n",
        "def go(q):\nmovej(q)\nend\nq=[0,1,1,0,1,0]\ngo(q)\n", "movel(pose)\ncamera(pose=p[0.1,0.2,0.3,0,0,0])\n"})
    EXPECT_THAT(targets(text), IsEmpty()) << text;
  const auto displaced = targets("track_conveyor_linear(p,1)\n" + kLineTo);
  ASSERT_THAT(displaced, SizeIs(1));
  EXPECT_THAT(displaced[0].not_sent_to, HasSubstr("track_conveyor_linear"));
}

TEST(UrScriptFlow, KnowsNoToolWhereAThreadSetsIt) {
  const std::string thread = "thread t():\n" + tcp(2) + "end\n";
  EXPECT_THAT(ur_tools(thread + tcp(1) + "h = run t()\n" + kLineTo), ::testing::ElementsAre(HasSubstr("at any time")));
  EXPECT_THAT(ur_tools("def f():\n" + tcp(2) + "end\nthread t():\nf()\nend\n" + tcp(1) + "run t()\n" + kLineTo),
              ::testing::ElementsAre(HasSubstr("at any time")));
  EXPECT_THAT(ur_tools("thread t():\nsleep(1)\nend\n" + tcp(1) + "run t()\n" + kLineTo), ::testing::ElementsAre("1"));
}

TEST(UrScriptFlow, SaysWhichFunctionsItCannotSee) {
  const auto remarks = [](const std::string& text) {
    return read_program(WrittenIn::urscript, text, "p", wrist_arm()).remarks;
  };
  EXPECT_THAT(remarks(tcp(1) + "sleep(1)\n" + kLineTo), IsEmpty());
  const auto said = remarks(tcp(1) + "gripper_open(3)\n" + kLineTo);
  ASSERT_THAT(said, SizeIs(1));
  EXPECT_THAT(said[0].sentence, HasSubstr("gripper_open() is not in the files given"));
  EXPECT_THAT(remarks(tcp(1) + "if attach(2) and not (get_x() > norm(v)):\nstop()\nend\n" + kLineTo), SizeIs(1));
  EXPECT_THAT(remarks(tcp(1) + "x = sin(get_x()) + rpc.attach(3)\n" + kLineTo), IsEmpty());
  EXPECT_THAT(remarks("gripper_open(3)\n" + tcp(1) + kLineTo), IsEmpty());
}

}  // namespace
}  // namespace demecal

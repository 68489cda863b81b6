// Which of the numbers that a name is given several times a motion goes to, and that being given numbers is no motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The lines (from 1) of the motions to each target that is a pose, the first motion first.
std::vector<std::vector<std::size_t>> lines_of_motions(WrittenIn language, const std::string& text) {
  const auto line = [&](std::size_t at) {
    return static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
  };
  std::vector<std::vector<std::size_t>> found;
  for (const Target& target : read_program(language, text, "p", wrist_arm()).targets) {
    if (!target.is_pose()) continue;
    found.push_back({line(target.order)});
    for (const std::size_t further : target.further_motions) found.back().push_back(line(further));
  }
  return found;
}

const std::string kKrlPose = "{X 1,Y 2,Z 3,A 4,B 5,C 6,S 2,T 2}\n", kAsPose = " = TRANS(1,2,3,4,5,6)\n",
                  kUrPose = "=p[0.1,0.2,0.3,0,0,1]\n";

TEST(GivenNumbers, AreThoseLastBeforeTheMotion) {
  EXPECT_THAT(lines_of_motions(WrittenIn::urscript,
                               "def m():\na" + kUrPose + "movel(a)\na" + kUrPose + "movel(a)\nmovel(a)\nend\n"),
              ElementsAre(ElementsAre(3u), ElementsAre(5u, 6u)));
  EXPECT_THAT(lines_of_motions(WrittenIn::krl, "DEF m()\nXA=" + kKrlPose + "LIN XA\nXA=" + kKrlPose + "LIN XA\nEND\n"),
              ElementsAre(ElementsAre(3u), ElementsAre(5u)));
  EXPECT_THAT(lines_of_motions(WrittenIn::kawasaki_as, ".PROGRAM m()\n POINT a" + kAsPose + " LMOVE a\n POINT a" +
                                                           kAsPose + " LMOVE a\n.END\n"),
              ElementsAre(ElementsAre(3u), ElementsAre(5u)));
}

TEST(GivenNumbers, MayBeAnyWhereTheWayIsNotStraight) {
  for (const char* const turn : {"if x:\nend\n", "go()\n", "while x:\nend\n"})
    EXPECT_THAT(lines_of_motions(WrittenIn::urscript,
                                 "def go():\nend\ndef m():\na" + kUrPose + "a" + kUrPose + turn + "movel(a)\nend\n"),
                ElementsAre(ElementsAre(::testing::_), ElementsAre(::testing::_)))
        << turn;
  EXPECT_THAT(lines_of_motions(WrittenIn::krl,
                               "DEF m()\nXA=" + kKrlPose + "IF x THEN\nXA=" + kKrlPose + "ENDIF\nLIN XA\nEND\n"),
              ElementsAre(ElementsAre(6u), ElementsAre(6u)));
}

/// How many motions go to each target that is a pose.
std::vector<std::size_t> motions_to_each(WrittenIn language, const std::string& text) {
  std::vector<std::size_t> counts;
  for (const auto& lines : lines_of_motions(language, text)) counts.push_back(lines.size());
  return counts;
}

TEST(GivenNumbers, MayBeAnyBehindEveryTurnOfTheLanguage) {
  const auto any = [](WrittenIn language, const std::string& text, const std::string& line_of_motion) {
    const std::size_t line =
        static_cast<std::size_t>(
            std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(line_of_motion)), '\n')) +
        1;
    const Program program = read_program(language, text, "p", wrist_arm());
    EXPECT_THAT(lines_of_motions(language, text), ElementsAre(ElementsAre(line), ElementsAre(line))) << text;
    // It goes to one of the two, and behind it where the arm stands is not told.
    EXPECT_THAT(program.joints_lost_at, Contains(text.find(line_of_motion))) << text;
  };
  for (const std::string turn : {"SWITCH x\nCASE 1\n@DEFAULT\nENDSWITCH\n", "FOR i=1 TO 2\n@ENDFOR\n",
                                 "LOOP\nIF x THEN\nEXIT\nENDIF\n@ENDLOOP\n", "WHILE x\n@ENDWHILE\n",
                                 "IF x THEN\nGOTO n\nENDIF\n@n:\n", "IF x THEN\nELSE\n@ENDIF\n"})
    any(WrittenIn::krl,
        "DEF m()\nXA=" + kKrlPose + std::string(turn).replace(turn.find('@'), 1, "XA=" + kKrlPose) + "LIN XA\nEND\n",
        "LIN");
  any(WrittenIn::krl,
      "DEF m()\nINTERRUPT DECL 1 WHEN $IN[1] DO s()\nXA=" + kKrlPose + "LIN XA\nEND\nDEF s()\nXA=" + kKrlPose + "END\n",
      "LIN");
  for (const std::string turn :
       {"if x:\n@elif y:\nend\n", "while x:\n@end\n", "while x:\nif y:\ncontinue\nend\n@end\n", "go()\n@go()\n"})
    any(WrittenIn::urscript,
        "def go():\nend\ndef m():\na" + kUrPose + std::string(turn).replace(turn.find('@'), 1, "a" + kUrPose) +
            "movel(a)\nend\n",
        "movel");
  any(WrittenIn::urscript, "def m():\nthread t():\na" + kUrPose + "end\nrun t()\na" + kUrPose + "movel(a)\nend\n",
      "movel");
  for (const std::string turn : {"CASE x OF\nVALUE 1:\n@ANY :\nEND\n", "FOR i = 1 TO 2\n@END\n", "DO\n@UNTIL x\n",
                                 "WHILE x DO\n@END\n", "IF x GOTO 10\n@10 TYPE 1\n", "IF x THEN\n@END\n", "@CALL s\n"})
    any(WrittenIn::kawasaki_as,
        ".PROGRAM m()\nPOINT a" + kAsPose + std::string(turn).replace(turn.find('@'), 1, "POINT a" + kAsPose) +
            "LMOVE a\n.END\n.PROGRAM s()\n.END\n",
        "LMOVE");
  for (const std::string reaction : {"ONI 1001 CALL s", "ON 1001 CALL s", "PCEXECUTE 1: s"})
    any(WrittenIn::kawasaki_as,
        ".PROGRAM m()\n" + reaction + "\nPOINT a" + kAsPose + "LMOVE a\n.END\n.PROGRAM s()\nPOINT a" + kAsPose +
            ".END\n",
        "LMOVE");
}

TEST(GivenNumbers, AreTheLastBeforeTheMotionWhereTheWayTurnsElsewhere) {
  EXPECT_THAT(motions_to_each(WrittenIn::krl, "DEF m()\nIF x THEN\nGOTO n\nENDIF\nXA=" + kKrlPose +
                                                  "LIN XA\nXA=" + kKrlPose + "LIN XA\nLIN XA\nn:\nEND\n"),
              ElementsAre(1u, 2u));
  EXPECT_THAT(motions_to_each(WrittenIn::urscript, "def m():\nif x:\na" + kUrPose + "movel(a)\nelse:\na" + kUrPose +
                                                       "movel(a)\nmovel(a)\nend\nend\n"),
              ElementsAre(1u, 2u));
}

TEST(GivenNumbers, OfAnArrayOfKrlAreThoseOfTheElement) {
  const std::string given = "DEF m()\nXA[1]=" + kKrlPose + "XA[2]=" + kKrlPose;
  EXPECT_THAT(lines_of_motions(WrittenIn::krl, given + "LIN XA[1]\nPTP XA[ 2 ] C_PTP\nEND\n"),
              ElementsAre(ElementsAre(4u), ElementsAre(5u)));
  EXPECT_THAT(lines_of_motions(WrittenIn::krl, given + "LIN XA[n]\nLIN XA[2]\nEND\n"),
              ElementsAre(ElementsAre(4u), ElementsAre(4u, 5u)));
  EXPECT_THAT(lines_of_motions(WrittenIn::krl, given + "XA[n]=" + kKrlPose + "LIN XA[1]\nEND\n"),
              ElementsAre(ElementsAre(5u), ElementsAre(3u), ElementsAre(5u)));
}

TEST(GivenNumbers, AreNoMotionByThemselves) {
  const auto lost = [](WrittenIn language, const std::string& text) {
    const Program program = read_program(language, text, "p", wrist_arm());
    for (const Target& target : program.targets) {
      if (target.is_pose()) {
        EXPECT_THAT(program.joints_lost_at, Contains(target.order)) << text;
      }
    }
  };
  lost(WrittenIn::krl, "DEF m()\nPTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}\nXA=" + kKrlPose + "END\n");
  lost(WrittenIn::kawasaki_as, ".PROGRAM m()\n JMOVE #PPOINT(1,2,3,4,5,6)\n POINT a" + kAsPose + ".END\n");
  const Program moved = read_program(WrittenIn::krl, "DEF m()\nXA=" + kKrlPose + "PTP XA\nEND\n", "p", wrist_arm());
  EXPECT_THAT(moved.joints_lost_at, IsEmpty());
}

}  // namespace
}  // namespace demecal

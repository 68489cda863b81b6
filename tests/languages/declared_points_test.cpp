// Points that are declared in one line and given their numbers in another, or with names in place of numbers; and what
// looks like a call and is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Program krl_program(const std::string& lines) {
  return read_program(WrittenIn::krl, "DEF m()\n" + lines + "END\n", "p", wrist_arm());
}

std::string all_said(const Program& program) {
  std::string said;
  for (const std::vector<Remark>* remarks : {&program.uncorrected, &program.remarks})
    for (const Remark& remark : *remarks)
      said += std::to_string(remark.place.line) + ": " + remark.name + ": " + remark.sentence + '\n';
  return said;
}

TEST(DeclaredPoints, OfKrlNeedStateNeitherSNorT) {
  const std::string numbers = "{X 1,Y 2,Z 3,A 4,B 5,C 6}\n";
  for (const char* type : {"POS", "E6POS", "GLOBAL E6POS"}) {
    const Program program = krl_program(std::string("DECL ") + type + " P5, P6[3]\nP5=" + numbers +
                                        "P6[2] = " + numbers + "LIN P5 C_DIS\nLIN P6[2]\n");
    EXPECT_THAT(names(program), ElementsAre("P5", "P6[2]")) << type;
    EXPECT_THAT(all_said(program), IsEmpty()) << type;
    ASSERT_EQ(program.targets.size(), 2U);
    EXPECT_EQ(program.targets.front().motion, Motion::line);
  }
  for (const char* declared : {"DECL FRAME P5\n", "", "DECL POS P5\nDECL FRAME P5\n"}) {
    const Program program = krl_program(declared + ("P5=" + numbers) + "LIN P5\n");
    EXPECT_THAT(names(program), IsEmpty()) << declared;
    EXPECT_THAT(all_said(program),
                HasSubstr("'P5', which is no point that this program gives as numbers and declares"));
  }
  EXPECT_THAT(all_said(krl_program("DECL POS P5\nP5={X x,Y 2,Z 3,A 4,B 5,C 6}\nLIN P5\n")),
              HasSubstr("3: P5: 'x' is no number"));
}

TEST(DeclaredPoints, OfKrlAreFollowedWhereTheyAreGivenNumbersTwice) {
  const Program program =
      krl_program("DECL POS P5\nP5={X 1,Y 2,Z 3,A 4,B 5,C 6}\nLIN P5\nP5={X 7,Y 2,Z 3,A 4,B 5,C 6}\nLIN P5\nP5.Z=9\n");
  EXPECT_THAT(names(program), ElementsAre("P5", "P5"));
  for (const Target& target : program.targets)
    EXPECT_THAT(target.not_sent_to, HasSubstr("line 7 changes it when the program runs"));
}

TEST(DeclaredPoints, OfRapidWithNamesInPlaceOfNumbersAreLeftAlone) {
  const std::string rest = ",[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n";
  const auto rapid = [&](const std::string& first) {
    return read_program(WrittenIn::rapid,
                        "MODULE M\nCONST robtarget p1:=" + first + "CONST robtarget p2:=[[1,2,3]" + rest +
                            "PROC main()\nMoveL p1,v9,fine,tool0;\nMoveL p2,v9,fine,tool0;\nENDPROC\nENDMODULE\n",
                        "p", wrist_arm());
  };
  for (const std::string& first : {"[[x,2,3]" + rest, "[[400+0.5,2,3]" + rest, "[pA" + rest,
                                   std::string("[[1,2,3],[0,1,0,0],[0,0,0,0],eNo];\n")}) {
    const Program program = rapid(first);
    EXPECT_THAT(names(program), ElementsAre("p2")) << first;
    EXPECT_THAT(all_said(program), HasSubstr("2: p1: '")) << first;
    EXPECT_THAT(all_said(program), HasSubstr("5: ")) << "the motion to it goes to what is not told";
  }
  EXPECT_THROW(rapid("[[1,2]" + rest), InputError);
  EXPECT_THROW(rapid("[[1,2,3..4]" + rest), InputError);
  const Program joints = read_program(WrittenIn::rapid,
                                      "MODULE M\nCONST jointtarget j1:=[[10,20,jx,1,60,30],[9E9,9E9,9E9,9E9,9E9,9E9]];"
                                      "\nPROC main()\nMoveAbsJ j1,v9,fine,tool0;\nENDPROC\nENDMODULE\n",
                                      "p", wrist_arm());
  EXPECT_THAT(all_said(joints), HasSubstr("2: j1: 'jx' is no number"));
}

TEST(Calls, AreNotSeenInReturnOfKrl) {
  const Program program = krl_program(
      "$BASE={X 0,Y 0,Z 9,A 0,B 0,C 0}\nx=f()\nLIN {X 1,Y 2,Z 3,A 4,B 5,C 6}\nEND\nDEFFCT INT f()\nIF y THEN\nRETURN "
      "(0)\n"
      "ENDIF\nRETURN(1)\nENDFCT\nDEF n()\n");
  EXPECT_THAT(all_said(program), Not(HasSubstr("RETURN")));
}

}  // namespace
}  // namespace demecal

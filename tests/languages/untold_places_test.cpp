// Motions to places that no number of the program tells are reported, each in its line, and end what is known of the
// joints before the next.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// What is said in this line (from 1): "" where nothing is, else all sentences.
std::string said_in_line(const Program& program, std::size_t line) {
  std::string said;
  for (const std::vector<Remark>* remarks : {&program.uncorrected, &program.remarks}) {
    for (const Remark& remark : *remarks) {
      if (remark.place.line == line) said += remark.name + ": " + remark.sentence + '\n';
    }
  }
  return said;
}

/// Whether what is known of the joints ends in this line of the text.
bool ends_in_line(const Program& program, const std::string& text, std::size_t line) {
  return std::ranges::any_of(program.unknown_motions, [&](std::size_t at) {
    const std::string_view before = std::string_view(text).substr(0, at);
    return static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1 == line;
  });
}

/// Expects that the line of `text` is reported so, and that what is known of the joints ends there.
void expect_untold(WrittenIn language, const std::string& text, std::size_t line, const std::string& sentence) {
  SCOPED_TRACE(text);
  const Program program = read_program(language, text, "p", wrist_arm());
  EXPECT_THAT(said_in_line(program, line), HasSubstr(sentence));
  EXPECT_TRUE(ends_in_line(program, text, line));
}

const std::string kKrl =
    "DEF t()\nDECL E6POS XP1={X 1,Y 2,Z 3,A 4,B 5,C 6}\nDECL E6POS XAR[2]\nXAR[1]={X 1,Y 2,Z 3,A 4,B 5,C 6,S 2,T 2}\n";

TEST(UntoldPlaces, OfKrlAreReported) {
  for (const char* motion : {"PTP XHOME", "LIN XP5 C_DIS", "SPTP XP5 WITH $VEL_AXIS[1]=20", "CIRC XP1, XP5, CA 90",
                             "SPLINE\nSPL XP5", "lin xp5"})
    expect_untold(WrittenIn::krl, kKrl + motion + "\nEND\n", std::string_view(motion).starts_with("SPLINE") ? 6 : 5,
                  "which is no point that this program gives as numbers");
  expect_untold(WrittenIn::krl, kKrl + "PTP XHOME\n", 5, "XHOME: ");
  expect_untold(WrittenIn::krl, kKrl + "PTP XHOME\nLIN XHOME\n", 6, "'XHOME'");
  for (const char* motion : {"LIN XP1:XP5", "LIN XP1 : XAR[1]", "PTP XP5:XP1", "LIN $POS_ACT:XP5", "PTP INVERSE(XP1)"})
    expect_untold(WrittenIn::krl, kKrl + motion + "\n", 5, "is computed when the program runs");
  for (const char* motion :
       {"LIN {X 5}", "PTP {A1 x,A2 1,A3 1,A4 1,A5 1,A6 1}", "LIN {FRAME: X 1,Y 2,Z 3,A 4,B 5,C 6}"})
    expect_untold(WrittenIn::krl, kKrl + motion + "\n", 5, "left as it is");
}

TEST(UntoldPlaces, OfKrlAreNotSeenWhereEveryPlaceIsTold) {
  for (const char* motion : {"PTP XP1", "LIN XP1 C_DIS", "CIRC XP1, XP1, CA 90", "PTP XAR[1]", "PTP XAR[n]",
                             "LIN {X 1,Y 2,Z 3,A 4,B 5,C 6}", "WAIT FOR mode==#LIN", "PTP $AXIS_ACT", "; LIN XP7"}) {
    const std::string text = kKrl + motion + "\n";
    EXPECT_THAT(said_in_line(read_program(WrittenIn::krl, text, "p", wrist_arm()), 5), IsEmpty()) << motion;
  }
}

TEST(UntoldPlaces, AuxiliaryPointsOfCirclesOfKrlAreReportedAlone) {
  const std::string text = kKrl + "CIRC XP5, XP1\n";
  const Program program = read_program(WrittenIn::krl, text, "p", wrist_arm());
  EXPECT_THAT(said_in_line(program, 5), HasSubstr("'XP5', which is no point"));
  EXPECT_FALSE(ends_in_line(program, text, 5)) << "where the arm comes to is told";
}

TEST(UntoldPlaces, OfRelativeMotionsOfKrlHaveTheCorrectionOfThePlaceBefore) {
  const auto said = [](const std::string& motions, std::size_t line) {
    const std::string text = kKrl + motions;
    const Program program = read_program(WrittenIn::krl, text, "p", wrist_arm());
    EXPECT_TRUE(ends_in_line(program, text, line)) << motions;
    return said_in_line(program, line);
  };
  EXPECT_THAT(said("LIN XP1\nLIN_REL {Z 90}\n", 6), IsEmpty());
  EXPECT_THAT(said("LIN XP1\nLIN_REL {X 300,Z -400} #TOOL\n", 6), HasSubstr("500 mm"));
  EXPECT_THAT(said("LIN XP1\nLIN_REL {Z 90}\nLIN_REL {Z 90}\n", 7), HasSubstr("180 mm"));
  EXPECT_THAT(said("LIN XP1\nLIN_REL {Z 90}\nLIN XP1\nSLIN_REL {Z 90}\n", 8), IsEmpty());
  EXPECT_THAT(said("PTP_REL {A1 10}\n", 5), HasSubstr("not known"));
  EXPECT_THAT(said("LIN_REL XP1\n", 5), HasSubstr("not known"));
}

}  // namespace
}  // namespace demecal

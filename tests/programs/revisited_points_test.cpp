// Points that a program moves to again: the arm comes from there to the next, and where it comes to the point itself
// from another side, a correction that depends on that is said to be that of the first motion alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "named_motions.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string variable(const std::string& name, double first) {
  return name + " = [" + std::to_string(first) + ",-1.0,1.2,0.35,0.9,0.1]\n";
}

const std::string kVariables = variable("a", 0.1) + variable("b", 0.3) + variable("c", 0.5) + variable("z", 0.0);

CorrectedProgram corrected_of(const std::string& motions) {
  const CommandModel model = lost_motion_model();
  std::string text = kVariables;
  for (const char name : motions) text += std::string("movej(") + name + ")\n";
  return correct_program(text, read_program(WrittenIn::urscript, text, "p", model.nominal.chain), model, {});
}

double approach_of(const std::string& motions, const std::string& name) {
  const CorrectedProgram corrected = corrected_of(motions);
  for (std::size_t i = 0; i < corrected.targets.size(); ++i) {
    if (corrected.program.targets[i].name == name) return corrected.targets[i].stop.approach[0];
  }
  return 9.0;
}

std::string said_of(const std::string& motions, const std::string& name) {
  std::string said;
  for (const Remark& warning : corrected_of(motions).warnings) {
    if (warning.name == name) said += warning.sentence + '\n';
  }
  return said;
}

TEST(RevisitedPoints, AreWhereTheArmComesFrom) {
  EXPECT_EQ(approach_of("acb", "b"), -1.0);
  EXPECT_EQ(approach_of("acab", "b"), 1.0) << "it was at a again";
}

TEST(RevisitedPoints, AreSaidWhereTheSideOfArrivalMatters) {
  EXPECT_THAT(said_of("zabc", "b"), IsEmpty());
  EXPECT_THAT(said_of("zabab", "b"), IsEmpty()) << "from one side both times";
  EXPECT_THAT(said_of("zabcb", "b"), HasSubstr("line 9 comes to it from another side"));
  EXPECT_THAT(said_of("zabcb", "b"), HasSubstr("mm"));
}

}  // namespace
}  // namespace demecal

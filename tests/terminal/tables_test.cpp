// The tables of studies and comparisons say what was run, and fit a terminal.
#include "terminal/report_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../studies/made_up_study.hpp"
#include "made_up_comparison.hpp"
#include "screen_reading.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Comparison, HasALineForEveryMethodThatFitsATerminal) {
  const std::string text = comparison_table(two_methods());
  EXPECT_THAT(text, HasSubstr("30 poses fitted, 20 of validation, 0 of acceptance"));
  EXPECT_THAT(text, HasSubstr("5.2500"));
  EXPECT_THAT(text, HasSubstr("no positions"));
  for (const std::string& line : screen_lines(text)) EXPECT_LE(letters_of(line), 100u) << line;
}

TEST(StudyTable, SaysWhatTheBracketsHold) {
  EXPECT_THAT(study_table(made_up_study(8)), HasSubstr("order statistics"));
  EXPECT_THAT(study_table(made_up_study(8)), Not(HasSubstr("least and the largest")));
  EXPECT_THAT(study_table(made_up_study(5)), HasSubstr("least and the largest"));
  EXPECT_THAT(study_table(made_up_study(5)), Not(HasSubstr("order statistics")));
  Study broken_off = made_up_study(6);
  broken_off.runs.pop_back();
  broken_off.interrupted = true;
  EXPECT_THAT(study_table(broken_off), HasSubstr("order statistics"));
  EXPECT_THAT(study_table(broken_off), HasSubstr("least and the largest"));
  EXPECT_THAT(study_table(broken_off), HasSubstr("11 of 12 runs (interrupted)"));
}

TEST(StudyTable, HasACellInALineAndColumnsOfWhatWasMeasured) {
  Study study = made_up_study(6);
  EXPECT_THAT(study_table(study), Not(HasSubstr("accept")));
  for (const auto& cell : study.cells) EXPECT_THAT(study_table(study), HasSubstr("  " + cell[1] + "  "));
  for (StudyRun& run : study.runs) run.accept_mm = 0.5;
  EXPECT_THAT(study_table(study), HasSubstr("0.5000 [0.5000, 0.5000]"));
  EXPECT_THAT(study_table(study), Not(HasSubstr("calibration mm")));
  for (StudyRun& run : study.runs) run.validation_mm = run.accept_mm = std::nullopt;
  EXPECT_THAT(study_table(study), HasSubstr("calibration mm"));
}

TEST(StudyTable, CanBeOfNoRun) {
  Study study = made_up_study(6);
  study.runs.clear();
  EXPECT_THAT(study_table(study), HasSubstr("0 of 12 runs"));
}

TEST(BlocksTable, HasTheFirstBlocksAndSaysHowManyMoreThereAre) {
  Study study = made_up_study(2);
  EXPECT_THAT(blocks_table(study, 5), HasSubstr("No expression of two functions or more stands"));
  for (const char* form : {"SIN(2 * theta)", "COS(theta)", "theta * theta"}) {
    study.blocks.push_back({block_form(parse(form)), 3, 4, 5, 0.625});
  }
  const std::string text = blocks_table(study, 2);
  EXPECT_THAT(text, HasSubstr("SIN(c * theta)"));
  EXPECT_THAT(text, Not(HasSubstr("theta * theta")));
  EXPECT_THAT(text, HasSubstr("1 more"));
}

}  // namespace
}  // namespace demecal

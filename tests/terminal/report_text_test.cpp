// What a terminal shows of a report.
#include "terminal/report_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_report.hpp"
#include "page_reading.hpp"
#include "report/figures.hpp"
#include "screen_reading.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Terminal, ShowsEveryStageOfEverySetThatHasPoses) {
  const Report report = made_up_report();
  const std::string text = to_terminal(report);
  for (const ErrorBySet* const stage : {&report.nominal, &report.registered, &report.declared, &report.before}) {
    for (const SetErrors& figures : {stage->calibration, stage->validation}) {
      for (const std::optional<double>& value : {figures.mean_mm, figures.rms_mm, figures.p95_mm, figures.max_mm}) {
        EXPECT_THAT(text, HasSubstr(" " + rounded(*value, 3)));
      }
    }
  }
  EXPECT_THAT(text, HasSubstr("calibration poses"));
  EXPECT_THAT(text, HasSubstr("validation poses"));
  EXPECT_THAT(text, Not(HasSubstr("accept poses")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(Terminal, HasARowForEveryJointAndNamesWhatWasNoticed) {
  const Report report = made_up_report();
  const std::string text = to_terminal(report);
  for (const JointEntry& joint : report.joints) {
    EXPECT_THAT(text, HasSubstr("\n  " + std::to_string(joint.joint) + "  "));
    EXPECT_THAT(text, HasSubstr(joint.short_form));
    EXPECT_THAT(unwrapped(text), HasSubstr(limit_sentence(joint)));
  }
  EXPECT_THAT(unwrapped(text), HasSubstr("this correction is held back."));
  EXPECT_THAT(unwrapped(text), HasSubstr("above its limit of"));
  for (const std::string& pose : report.poses.outliers) EXPECT_THAT(text, HasSubstr(pose));
  for (const std::string& pose : report.poses.near_singular) EXPECT_THAT(text, HasSubstr(pose));
  EXPECT_THAT(
      unwrapped(text),
      HasSubstr("Of the 4 corrections in the model 1 is a formula as it evolved; 1 is an evolved formula with smooth "
                "terms added; 2 are sums of smooth terms, fitted to the poses, in the place of evolved ones. With all "
                "as they "
                "evolved the mean error of validation poses would be"));
  EXPECT_THAT(text, HasSubstr("noise floor from repeats: 0.051 mm per axis"));
}

TEST(Terminal, ShowsHowFarJointsAreCorrectedThatHadNoTargets) {
  Report report = made_up_report();
  for (JointEntry& joint : report.joints) joint.mean_abs_error_rad = {};
  const std::string text = to_terminal(report);
  EXPECT_THAT(text, Not(HasSubstr("error before")));
  EXPECT_THAT(text, HasSubstr("up to 0.53  " + report.joints.front().short_form));
}

TEST(Terminal, ShowsTheErrorWithoutSuspectedOutliers) {
  Report report = made_up_report();
  EXPECT_THAT(to_terminal(report), Not(HasSubstr("Without suspected outliers")));
  report.pose_errors = {{"P1", "", "validation", {}, 0.3, {}, {}}, {"P2", "", "validation", {}, 4.0, {}, {"outlier"}}};
  EXPECT_THAT(to_terminal(report),
              HasSubstr("Without suspected outliers the rms error is 0.300 mm instead of 2.836 mm"));
}

TEST(Terminal, DefinesSharedFunctionsAndShowsWhoCallsThem) {
  EXPECT_THAT(to_terminal(made_up_report()), Not(HasSubstr("share")));
  Report report = made_up_sharing_report();
  const std::string text = to_terminal(report);
  EXPECT_THAT(text, HasSubstr("F1(c1, c2, a1) = c1 * SIN(a1 + c2); joints 1, 3"));
  EXPECT_THAT(text, HasSubstr("F2(a1) = TANH(ATAN(a1)); no correction calls it"));
  EXPECT_THAT(text, HasSubstr("joint 1: F1(0.00042, 0.7, theta) + 0.00011 * COS(4.1 * theta)"));
  EXPECT_THAT(text, HasSubstr("joint 3: F1(0.00061, 1.4, 1.02 * theta)"));
  report.shared_functions->clear();
  EXPECT_THAT(to_terminal(report), HasSubstr("they share no function"));
}

TEST(Terminal, IsAtMostAHundredColumnsWide) {
  RandomStream random{451};
  for (int trial = 0; trial < 100; ++trial) {
    Report report = made_up_report();
    const auto name = [&random] {
      std::string text;
      for (std::size_t i = random.index(140); i > 0; --i) text += random.chance(0.1) ? " " : "ü";
      return text;
    };
    report.shared_functions = {{name(), {1, 2}}};
    for (JointEntry& joint : report.joints) joint.note = joint.with_functions = name();
    report.unidentified = {name() + name() + name(), name()};
    report.poses.outliers = {name(), name(), name()};
    for (const std::string& line : screen_lines(to_terminal(report))) EXPECT_LE(letters_of(line), 100u) << line;
  }
}

TEST(Terminal, KeepsEveryWordThatFitsOnALine) {
  Report report = made_up_report();
  std::string sentence;
  for (int word = 0; word < 60; ++word) sentence += "word" + std::to_string(word) + " ";
  report.unidentified = {sentence};
  std::istringstream words(to_terminal(report));
  int next = 0;
  for (std::string word; words >> word;) next += word == "word" + std::to_string(next) ? 1 : 0;
  EXPECT_EQ(next, 60);
}

TEST(Terminal, ShowsTenFindingsWhereAReportHasTheOthersAndElseAll) {
  DataCheckEntry check;
  for (int i = 1; i <= 12; ++i) {
    check.findings.emplace_back();
    check.findings.back().kind = "outlier";
    check.findings.back().sentence = "finding " + std::to_string(i) + " is here";
  }
  const std::string ten = to_terminal(check, ShownFindings::ten), all = to_terminal(check, ShownFindings::all);
  EXPECT_THAT(ten, HasSubstr("finding 10 is here"));
  EXPECT_THAT(ten, Not(HasSubstr("finding 11 is here")));
  EXPECT_THAT(ten, HasSubstr("2 more in report.json"));
  for (int i = 1; i <= 12; ++i) EXPECT_THAT(all, HasSubstr("finding " + std::to_string(i) + " is here"));
  EXPECT_THAT(all, Not(HasSubstr("report.json")));
}

TEST(Terminal, ShowsOneStageWithItsSets) {
  const ErrorBySet errors = made_up_report().after;
  const std::string text = to_terminal(Evaluation{errors, {}, {}, {}, {}});
  EXPECT_EQ(screen_lines(text).size(), 3u);
  EXPECT_THAT(text, HasSubstr(rounded(*errors.validation.p95_mm, 3)));
  EXPECT_THAT(text, Not(HasSubstr("accept")));
}

TEST(Terminal, SaysOfAnEvaluationWhyRadiiAreWider) {
  Evaluation evaluation{made_up_report().after, {}, {}, {}, {}};
  EXPECT_THAT(to_terminal(evaluation), Not(HasSubstr("NOTE")));
  evaluation.widened_by = {"1 of the 9 measurements lie outside: payload at 20 kg, measured 0 .. 5 kg."};
  EXPECT_THAT(to_terminal(evaluation), HasSubstr("NOTE: 1 of the 9 measurements lie outside: payload at 20 kg"));
}

TEST(Terminal, SaysOfPosesThatTouchHowFarOffTheToolMayBeAnywhere) {
  const ErrorBySet errors = made_up_report().after;
  Evaluation evaluation{errors, {}, {}, {}, {}};
  evaluation.workspace_error = WorkspaceEntry{0.25, 0.5, true};
  EXPECT_THAT(to_terminal(evaluation), HasSubstr("off by 0.250 mm (rms)"));
  evaluation.of_one_contact = true;
  EXPECT_THAT(to_terminal(evaluation), Not(HasSubstr("off by 0.250 mm (rms)")));
  EXPECT_THAT(to_terminal(evaluation), HasSubstr("All calibration poses touch one contact"));
}

TEST(Terminal, ShowsTheWorstOfManyKnownLengths) {
  Evaluation evaluation{made_up_report().after, {}, {}, {}, {}};
  for (int i = 0; i < 40; ++i)
    evaluation.length_errors.push_back({{"A" + std::to_string(i), "B"}, "accept", 100.0, 0.01, 0.5, 1e-3 * i});
  const std::string text = to_terminal(evaluation);
  EXPECT_THAT(text, HasSubstr("A39 to B"));
  EXPECT_THAT(text, HasSubstr("A28 to B"));
  EXPECT_THAT(text, Not(HasSubstr("A27 to B")));
  EXPECT_THAT(text, HasSubstr("and 28 more, off by 0.027 mm at most"));
}

}  // namespace
}  // namespace demecal

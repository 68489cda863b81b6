// What a terminal shows of the closed loop.
#include "terminal/report_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "made_up_loop.hpp"
#include "page_reading.hpp"
#include "screen_reading.hpp"
#include "terminal/text.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string shown(const LoopOutcome& loop) {
  return loop_to_terminal(made_up_looped_report(loop));
}

/// The words of a text whose lines may be broken anywhere.
std::string unbroken(const std::string& text) {
  std::istringstream stream(text);
  std::string words;
  for (std::string word; stream >> word;) words += (words.empty() ? "" : " ") + word;
  return words;
}

TEST(LoopTerminal, HasALineForEveryEffectAddedWithItsFigures) {
  const LoopOutcome loop = made_up_loop(5);
  const std::string text = shown(loop);
  for (const Round& round : loop.rounds) {
    if (round.verdict != Verdict::added) continue;
    const std::string errors = rounded(round.validation_before_mm, 3) + " -> " + rounded(round.validation_after_mm, 3);
    const std::vector<std::string> lines = screen_lines(text);
    const auto is_its = [&](const std::string& line) {
      return line.starts_with("    " + std::to_string(round.number) + "  " + round.effect.kind) &&
             line.find("rad ") != std::string::npos && line.find(" 0.002 ") != std::string::npos &&
             line.ends_with(" " + errors);
    };
    EXPECT_EQ(std::ranges::count_if(lines, is_its), 1) << text;
    EXPECT_THAT(text, HasSubstr(round.diagnosis));
  }
  EXPECT_THAT(text, HasSubstr("0.412 mrad"));
}

TEST(LoopTerminal, EndsTheCausesWithWhatNoneExplains) {
  Report report = made_up_looped_report(made_up_loop(1));
  EXPECT_THAT(unbroken(loop_to_terminal(report)), Not(HasSubstr("Not explained")));
  report.unexplained = UnexplainedEntry{.error_mm = 0.26, .left_mm = 0.3, .noise_mm = 0.15, .advice = "Measure more."};
  const std::string text = unbroken(loop_to_terminal(report));
  EXPECT_THAT(text, HasSubstr("of which noise makes 0.150 mm. Measure more."));
  EXPECT_LT(text.find("causes, by the rise"), text.find("Not explained: 0.260 mm"));
  EXPECT_LT(text.find("Not explained"), text.find("effect added"));
  report.causes.clear();
  EXPECT_THAT(unbroken(loop_to_terminal(report)), HasSubstr("Not explained: 0.260 mm"));
}

TEST(LoopTerminal, NamesRivalsAndTheMeasurementThatWouldSplitThem) {
  const std::string text = unbroken(shown(made_up_loop(5)));
  EXPECT_THAT(text, HasSubstr("cannot be distinguished with these poses from: hysteresis, joint 2 (cosine 0.93)"));
  EXPECT_THAT(
      text, HasSubstr("measure next: 14 poses from both sides, with and without a payload, would tell the two apart."));
  LoopOutcome many = made_up_loop(1);
  many.rounds[0].rivals.assign(7, many.rounds[0].rivals[0]);
  EXPECT_THAT(unbroken(shown(many)), HasSubstr("; 4 more"));
}

TEST(LoopTerminal, NamesTheClassOfAnEffectThatThesePosesCannotTellFromAnother) {
  LoopOutcome loop = made_up_loop(1);
  Round& round = loop.rounds[0];
  round.effect = {.kind = "sensor_scale", .joint = -1, .values = {-4.25e-4}};
  round.rivals = {{{.kind = "geometry", .joint = 2}, 0.999, 0.3}, {{.kind = "drift", .joint = -1}, 0.94, 2.0}};
  const std::string text = unbroken(shown(loop));
  EXPECT_THAT(text, HasSubstr("1 link geometry of joint 3 or another -425 ppm"));
  EXPECT_THAT(text, HasSubstr("Link geometry of joint 3 or instrument scale: these poses cannot tell. The model has it "
                              "as sensor_scale. If that is right: " +
                              round.diagnosis));
  EXPECT_THAT(text, HasSubstr("cannot be distinguished with these poses from: drift (cosine 0.94)"));
}

TEST(LoopTerminal, SaysWhatTheDataHoldThatNoRealArmHas) {
  LoopOutcome loop = made_up_loop(5);
  loop.rounds.back().verdict = Verdict::rejected;
  loop.rounds.back().implausible = true;
  loop.rounds.back().reason = "the data show a unit coupling";
  const std::string name = loop.rounds.back().effect.kind;
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr("refused: " + name));
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr(": the data show a unit coupling"));
  EXPECT_THAT(shown(loop), Not(HasSubstr("tried last")));
}

TEST(LoopTerminal, GathersManyHarmonicsByJoint) {
  EXPECT_THAT(shown(made_up_loop(12)), Not(HasSubstr("12 gear harmonics")));
  const LoopOutcome loop = made_up_loop(27);
  const std::string text = shown(loop);
  EXPECT_THAT(text, HasSubstr("27 gear harmonics"));
  EXPECT_THAT(text, HasSubstr("joint 1: 9 harmonics, 11 to 35 cycles per turn, largest "));
  EXPECT_THAT(text, HasSubstr("joint 3: 9 harmonics, 13 to 37 cycles per turn, largest "));
  EXPECT_THAT(text, Not(HasSubstr("(ratio 11)")));
  EXPECT_THAT(text, HasSubstr(rounded(loop.rounds[1].validation_before_mm, 3) + " -> " +
                              rounded(loop.rounds[27].validation_after_mm, 3)));
  const std::string causes = text.substr(0, text.find("effect added"));
  EXPECT_THAT(unbroken(causes), HasSubstr("What to do: as of 2."));
  EXPECT_LT(screen_lines(causes).size(), 15u);
  EXPECT_LT(screen_lines(text.substr(causes.size())).size(), 30u);
}

TEST(LoopTerminal, SaysWhatTheCausesCostBeforeItSaysWhatWasAdded) {
  const std::string text = unbroken(shown(made_up_loop(5)));
  const std::size_t dearest = text.find("1. lost motion of joint 2: 0.417 mm of the error (95 %: 0.468 to 0.572)");
  ASSERT_NE(dearest, std::string::npos) << text;
  EXPECT_LT(dearest, text.find("2. gears of joint 1: "));
  EXPECT_LT(text.find("2. gears of joint 1: "), text.find("effect added"));
  EXPECT_THAT(text, HasSubstr("Left on validation poses (rms, mm) with the model's 4 causes 0.311; with fewer (to "
                              "first order): none 0.620, the best 1 "));
  EXPECT_THAT(text, HasSubstr("Approach targets from the side they were measured from"));
}

TEST(LoopTerminal, SaysWhichOtherCauseACauseCannotBeToldFrom) {
  LoopOutcome loop = made_up_loop(0);
  const Effect geometry{.kind = "geometry", .joint = 2, .settings = {}},
      own{.kind = "hysteresis", .joint = 1, .settings = {}};
  loop.rounds.front().rivals = {{geometry, 0.995, 0.5}, {own, 0.99, 0.7}};
  EXPECT_THAT(unbroken(shown(loop)),
              HasSubstr("1. lost motion of joint 2 or geometry of the link of joint 3 (these poses cannot tell): "));
}

TEST(LoopTerminal, LeavesOutWhatManyHarmonicsDidWhereOthersWereAddedBetweenThem) {
  LoopOutcome loop = made_up_loop(27);
  loop.rounds[9].effect = made_up_backlash();
  const std::vector<std::string> lines = screen_lines(shown(loop));
  const auto line = std::ranges::find_if(
      lines, [](const std::string& one) { return one.find("26 gear harmonics") != std::string::npos; });
  ASSERT_NE(line, lines.end());
  EXPECT_THAT(*line, Not(HasSubstr("->")));
}

TEST(LoopTerminal, SaysWhatWasTriedLastAndWhyItStopped) {
  const std::string text = unbroken(shown(made_up_loop(5)));
  EXPECT_THAT(text, HasSubstr("tried last, not added: gain, joint 4, p 0.31: The bound of its gain"));
  EXPECT_THAT(text, HasSubstr("because no further effect improved the validation poses"));
  EXPECT_THAT(text, HasSubstr("the effects explain 87.3 %"));
  EXPECT_THAT(text, HasSubstr("taken back: gear_harmonic (ratio 77), joint 5"));
}

TEST(LoopTerminal, SaysBelowWhatTheMissingEffectsAre) {
  LoopOutcome loop = made_up_loop(5);
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr("no other backlash: below 8 arcsec (joint 1) to 48 arcsec (joint 6)"));
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr("no sensor_scale: whole arm below 25 ppm"));
  loop.rounds.clear();
  loop.not_found = {{{.kind = "backlash", .joint = 1, .settings = {}, .form = "approach"}, 3.9e-5, "rad"}};
  EXPECT_THAT(shown(loop), HasSubstr("no backlash: joint 2 below 8 arcsec\n"));
  loop.not_found[0].testable = false;
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr("not testable with these data: backlash of joint 2 (only implausibly"));
  EXPECT_THAT(shown(loop), Not(HasSubstr("arcsec")));
  loop.not_found.assign(3, {{.kind = "gain", .joint = 0, .settings = {}}, std::nan(""), "1"});
  EXPECT_THAT(shown(loop), HasSubstr("3 more effects not found"));
}

TEST(LoopTerminal, SaysWhatTheDataCannotShowAndHowTheControlsFared) {
  LoopOutcome loop = made_up_loop(5);
  const std::string text = unbroken(shown(loop));
  EXPECT_THAT(text, HasSubstr("not testable with these data: thermal_offset, thermal_length (no temperature column); "
                              "drift (no time column)"));
  EXPECT_THAT(text, HasSubstr("none of 2 decoys won; the best was backlash of joint 2 by shuffled approach signs"));
  loop.decoys[1].won = true;
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr("WON by what cannot be true: a gear ratio no gear has"));
}

TEST(LoopTerminal, SaysFirstThatNoEffectIsSureWhereAControlFaredAsNoneShould) {
  const auto begins_with_doubt = [](const LoopOutcome& loop) {
    return unbroken(shown(loop))
        .starts_with("None of the effects is sure: a gear ratio no gear has, which cannot exist");
  };
  LoopOutcome right = made_up_loop(5);
  right.decoys[1].p_left = 0.051;
  EXPECT_FALSE(begins_with_doubt(right));
  LoopOutcome rare = right, won = right;
  rare.decoys[1].p_left = 0.05;
  won.decoys[1].won = true;
  EXPECT_TRUE(begins_with_doubt(rare));
  EXPECT_TRUE(begins_with_doubt(won));
  std::erase_if(rare.rounds, [](const Round& round) { return round.verdict == Verdict::added; });
  EXPECT_FALSE(begins_with_doubt(rare));
}

TEST(LoopTerminal, SaysWhereNoiseIsTakenToBeIndependent) {
  LoopOutcome loop = made_up_loop(5);
  EXPECT_THAT(unbroken(shown(loop)), Not(HasSubstr("taken to be independent")));
  loop.noise_estimated = false;
  EXPECT_THAT(unbroken(shown(loop)), HasSubstr("taken to be independent from pose to pose"));
}

TEST(LoopTerminal, IsEmptyWhereTheLoopDidNotRun) {
  EXPECT_THAT(shown({}), IsEmpty());
  EXPECT_FALSE(Report{}.added_any());
}

TEST(LoopTerminal, SaysThatNothingWasAdded) {
  LoopOutcome loop;
  loop.stopped = StopReason::no_structure;
  EXPECT_THAT(shown(loop), HasSubstr("added no effect"));
  EXPECT_THAT(shown(loop), HasSubstr("shows no more structure"));
  EXPECT_FALSE(made_up_looped_report(loop).added_any());
}

TEST(LoopTerminal, StandsInTheReportWithItsStage) {
  const Report report = made_up_looped_report();
  const std::string text = to_terminal(report);
  EXPECT_THAT(text, HasSubstr("with the effects found"));
  EXPECT_THAT(text, HasSubstr(" " + rounded(*report.after.validation.p95_mm, 3)));
  EXPECT_THAT(text, HasSubstr(loop_to_terminal(report)));
  EXPECT_THAT(to_terminal(made_up_report()), Not(HasSubstr("with the effects found")));
}

TEST(LoopTerminal, IsAtMostAHundredColumnsWide) {
  RandomStream random{835};
  const auto name = [&random] {
    std::string text;
    for (std::size_t i = random.index(160); i > 0; --i) text += random.chance(0.1) ? " " : "ü";
    return text;
  };
  for (int trial = 0; trial < 60; ++trial) {
    LoopOutcome loop = made_up_loop(trial);
    for (Round& round : loop.rounds) {
      round.diagnosis = name();
      round.reason = name();
      round.effect.form = name();
      round.next_measurement = NextMeasurement{name(), 100};
    }
    for (UntestableKind& each : loop.untestable) each.reason = name();
    for (Decoy& decoy : loop.decoys) decoy.name = name();
    for (NotFound& missing : loop.not_found) missing.unit = name();
    for (const std::string& line : screen_lines(shown(loop))) EXPECT_LE(letters_of(line), kTerminalColumns) << line;
  }
}

TEST(TerminalText, FillsUpAndCutsToItsColumns) {
  for (const std::string text : {"", "a", "grün", "ein sehr langes Wort µµµµµ"}) {
    for (const std::size_t columns : {6u, 9u, 40u}) {
      EXPECT_EQ(display_width(left_aligned(text, columns)), columns);
      EXPECT_EQ(display_width(right_aligned(text, columns)), columns);
    }
  }
  EXPECT_EQ(right_aligned("ü", 3), "  ü");
  EXPECT_EQ(truncated("äöüäöü", 5), "äö...");
}

}  // namespace
}  // namespace demecal

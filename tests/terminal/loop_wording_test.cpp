// How a terminal words names, sizes and limits of effects, and causes that do harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "made_up_loop.hpp"
#include "screen_reading.hpp"
#include "terminal/report_text.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(LoopTerminal, CutsNoUnitOff) {
  Report report = made_up_looped_report(made_up_loop(1));
  RoundEntry& round = *std::ranges::find_if(report.rounds, &RoundEntry::added);
  for (const char* const name : {"backlash", "eccentricity of the gear or encoder of the ramified joint"}) {
    round.effect.kind = name;
    round.effect.amplitude = -1.17e-5;
    round.effect.unit = "rad/Nm";
    EXPECT_THAT(loop_to_terminal(report), HasSubstr(" -0.0117 mrad/Nm "));
  }
}

TEST(LoopTerminal, TellsRivalsApartThatAreOfOtherMasses) {
  Report report = made_up_looped_report(made_up_loop(1));
  RoundEntry& round = *std::ranges::find_if(report.rounds, &RoundEntry::added);
  const auto bending = [](std::vector<NamedNumber> parameters) {
    EffectEntry effect;
    effect.kind = "link_bending";
    effect.joint = 1;
    effect.form = "moments";
    effect.parameters = std::move(parameters);
    return effect;
  };
  round.members.clear();
  round.effect = bending({{"keep_6_mx", 1.0}, {"moment_6_mx_rad", 2e-3}});
  round.rivals = {
      {bending({{"keep_1_mx", 1.0}, {"keep_1_mz", 1.0}, {"keep_2_mx", 1.0}, {"keep_3_my", 1.0}}), 0.99, 3.0}};
  report.dropped = {bending({{"keep_6_mx", 1.0}}), bending({{"keep_2_mz", 1.0}, {"gravity_turn", 2.0}}),
                    bending({{"keep_2_mz", 1.0}, {"keep_5_mz", 1.0}})};
  const std::string text = unwrapped(loop_to_terminal(report));
  EXPECT_THAT(text, HasSubstr("from: link_bending (moments of links 1 to 3), joint 1 (cosine 0.99)"));
  EXPECT_THAT(text,
              HasSubstr("link_bending (moments of link 6 along x), joint 1; link_bending (moments of link 2 along z, "
                        "by a mount that leans the other way), joint 1; link_bending (moments of links 2 and 5), "
                        "joint 1"));
  EXPECT_THAT(text, Not(HasSubstr("_mx")));
}

TEST(LoopTerminal, SaysWhereACauseDoesHarmAndWhyItStays) {
  Report report = made_up_looped_report(made_up_loop(1));
  ASSERT_GE(report.causes.size(), 2U);
  report.causes[1].without_mm = 1.661;
  report.causes[1].with_mm = 1.689;
  report.causes[1].interval_mm = {0.0, 0.333};
  report.front = {{0, 2.359, {}, false}, {1, 1.661, {}, false}, {2, 1.689, {}, true}};
  const std::string text = unwrapped(loop_to_terminal(report));
  EXPECT_THAT(
      text,
      HasSubstr(
          ": none of the error on these poses, 1.661 mm without it and 1.689 mm with it (95 %: up to 0.333 mm of it)"));
  EXPECT_THAT(text, HasSubstr("the best 1 1.661. That fewer leave less here is no reason to leave one out"));
  report.front[1].validation_rms_mm = 1.7;
  EXPECT_THAT(unwrapped(loop_to_terminal(report)), Not(HasSubstr("That fewer")));
  report.front = {{0, 2.0, {}, false}, {1, 1.0, {}, true}, {2, 0.9, {}, false}};
  EXPECT_THAT(unwrapped(loop_to_terminal(report)), HasSubstr("with the model's 1 cause 1.000"));
}

TEST(LoopTerminal, StatesTheLimitsOfAKindInOneUnit) {
  Report report = made_up_looped_report(made_up_loop(1));
  EffectEntry compliance;
  compliance.kind = "compliance";
  compliance.form = "moments";
  compliance.joint = 2;
  report.not_found = {{compliance, 6.9e-3, "rad", ""}, {compliance, 47e-3, "rad", ""}};
  report.not_found[1].effect.joint = 6;
  EXPECT_THAT(
      unwrapped(loop_to_terminal(report)),
      HasSubstr("below 6.9 mrad (joint 2, moments) to 47 mrad (joint 6, moments); moments: with the whole lever of "
                "the weight, of which these poses have a part"));
}

}  // namespace
}  // namespace demecal

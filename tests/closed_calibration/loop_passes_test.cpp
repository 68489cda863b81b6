// Passes of the closed loop are told as one, and tell of the model that is left.
#include "closed_calibration/loop_passes.hpp"

#include <gtest/gtest.h>

#include "calibration/erring_arm.hpp"

namespace demecal {
namespace {

Round added(int number, int group, const Effect& effect) {
  Round round;
  round.number = number;
  round.group = group;
  round.verdict = Verdict::added;
  round.effect = effect;
  return round;
}

Effect backlash(int joint, double width_rad) {
  return {.kind = "backlash", .joint = joint, .values = {width_rad}};
}

Robot described() {
  Robot robot;
  robot.chain = puma();
  return robot;
}

TEST(LoopPasses, AreNumberedThrough) {
  LoopOutcome first, second;
  first.rounds = {added(1, 1, backlash(0, 1e-3)), added(2, 2, backlash(1, 1e-3))};
  second.rounds = {added(1, 1, backlash(2, 1e-3)), added(2, 1, backlash(3, 1e-3))};
  const LoopOutcome both = joined(first, second);
  ASSERT_EQ(both.rounds.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(both.rounds[static_cast<std::size_t>(i)].number, i + 1);
  EXPECT_EQ(both.rounds[2].group, 3);
  EXPECT_EQ(both.rounds[3].effect.joint, 3);
}

TEST(LoopPasses, TheLastOneSaysWhyItStoppedAndTheFirstWhatItFound) {
  LoopOutcome first, second;
  first.stopped = StopReason::no_gain;
  first.lack_of_fit_p = 0.001;
  first.explained_share = 0.5;
  second.stopped = StopReason::no_structure;
  second.lack_of_fit_p = 0.4;
  second.explained_share = 0.5;
  const LoopOutcome both = joined(first, second);
  EXPECT_EQ(both.stopped, StopReason::no_structure);
  EXPECT_EQ(both.lack_of_fit_p, 0.001);
  EXPECT_NEAR(*both.explained_share, 0.75, 1e-15);
}

TEST(LoopPasses, ADecoyKeepsItsBestGainAndItsVictory) {
  LoopOutcome first, second;
  first.decoys = {{"a", 3.0, true}, {"b", 1.0, false}};
  second.decoys = {{"a", 2.0, false}, {"b", 4.0, false}};
  const std::vector<Decoy> both = joined(first, second).decoys;
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].best_gain_nats, 3.0);
  EXPECT_TRUE(both[0].won);
  EXPECT_EQ(both[1].best_gain_nats, 4.0);
  EXPECT_FALSE(both[1].won);
}

TEST(LoopPasses, TellTheValuesOfTheModelAndWhatItDoesWithout) {
  LoopOutcome outcome;
  outcome.rounds = {added(1, 1, backlash(0, 1e-3)), added(2, 1, backlash(1, 1e-3))};
  CorrectedRobot model = true_puma({"", "", "", "", "", ""});
  model.effects = {backlash(1, 2.5e-3)};
  update_rounds(outcome, model, described());
  EXPECT_EQ(outcome.rounds[0].verdict, Verdict::rejected);
  EXPECT_FALSE(outcome.rounds[0].reason.empty());
  EXPECT_EQ(outcome.rounds[1].verdict, Verdict::added);
  EXPECT_EQ(outcome.rounds[1].effect.values, std::vector<double>{2.5e-3});
  EXPECT_NE(outcome.rounds[1].diagnosis.find("1.25"), std::string::npos) << outcome.rounds[1].diagnosis;
  EXPECT_TRUE(added_any(outcome));
  model.effects.clear();
  update_rounds(outcome, model, described());
  EXPECT_FALSE(added_any(outcome));
}

}  // namespace
}  // namespace demecal

// The closed loop on simulated arms: what was wrong is named, nothing is found where nothing is, and it knows when to
// stop.
#include "diagnosis/loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/catalogue.hpp"
#include "simulated_arm.hpp"

namespace demecal {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

LoopResult run_on(const Scenario& scenario, const DataSet& data) {
  const LoopResult result = run_loop(data, kZeroed, quick());
  EXPECT_GT(over_floor(result.before.robot, data), 1.3) << "the error must show";
  EXPECT_LT(over_floor(result.model.robot, data), 1.2);
  EXPECT_EQ(result.model.robot.effects.size(), added(result.outcome).size());
  EXPECT_EQ(scenario.robot.chain.size(), result.model.robot.chain.size());
  return result;
}

TEST(ClosedLoop, NamesBacklash) {
  Scenario scenario = perfect_scenario(parallel_arm(), 1);
  scenario.backlash = {{1, 5e-4}};
  const DataSet data = simulate(scenario);
  const LoopResult result = run_on(scenario, data);
  const Effect found = only(result);
  EXPECT_EQ(found.kind, "backlash");
  EXPECT_EQ(found.form, "approach");
  EXPECT_EQ(found.joint, 1);
  EXPECT_NEAR(found.value(0), 5e-4, 4 * found.standard_errors.at(0));
  const Round& round = result.outcome.rounds.front();
  EXPECT_LE(round.p_family, 0.05);
  EXPECT_LE(round.p_structure, 0.05);
  EXPECT_GT(round.gain_nats, 5.0);
  EXPECT_GT(round.confirmed, 0.5);
  EXPECT_GT(round.confirmed_lower, 0.0);
  EXPECT_GE(round.sign_stability, 0.95);
  EXPECT_LT(round.validation_after_mm, round.validation_before_mm);
  EXPECT_LT(round.interval.at(0)[0], 5e-4);
  EXPECT_GT(round.interval.at(0)[1], 5e-4);
  EXPECT_THAT(round.diagnosis, ::testing::HasSubstr("oint 2"));
  EXPECT_EQ(result.outcome.stopped, StopReason::no_structure);
  EXPECT_GT(result.outcome.p_structure_left, 0.05);
  EXPECT_EQ(result.outcome.rounds.back().group, 2);
  EXPECT_EQ(result.outcome.rounds.back().p_structure, result.outcome.p_structure_left);
}

TEST(ClosedLoop, NamesCompliance) {
  Scenario scenario = perfect_scenario(parallel_arm(), 2);
  scenario.compliance = {{2, 1.5e-5}};
  const DataSet data = simulate(scenario);
  const Effect found = only(run_on(scenario, data));
  EXPECT_EQ(found.kind, "compliance");
  EXPECT_EQ(found.form, "masses");
  EXPECT_EQ(found.joint, 2);
  EXPECT_NEAR(found.value(0), 1.5e-5, 4 * found.standard_errors.at(0));
}

TEST(ClosedLoop, NamesAGearHarmonic) {
  Scenario scenario = perfect_scenario(parallel_arm(), 3);
  scenario.gear_harmonics = {{.joint = 0, .ratio = 9, .cosine_rad = 2e-4, .sine_rad = -1.5e-4}};
  const DataSet data = simulate(scenario);
  const Effect found = only(run_on(scenario, data));
  EXPECT_EQ(found.kind, "gear_harmonic");
  EXPECT_EQ(found.joint, 0);
  EXPECT_EQ(found.setting("ratio"), 9);
  EXPECT_NEAR(found.value(0), 2e-4, 4 * found.standard_errors.at(0));
  EXPECT_NEAR(found.value(1), -1.5e-4, 4 * found.standard_errors.at(1));
}

TEST(ClosedLoop, NamesCoupling) {
  Scenario scenario = perfect_scenario(parallel_arm(), 4);
  scenario.couplings = {{.joint = 2, .from = 1, .per_rad = 3e-4}};
  const DataSet data = simulate(scenario);
  const Effect found = only(run_on(scenario, data));
  EXPECT_EQ(found.kind, "coupling");
  EXPECT_EQ(found.form, "linear");
  EXPECT_EQ(found.joint, 2);
  EXPECT_EQ(found.setting("from"), 2);
  EXPECT_NEAR(found.value(0), 3e-4, 4 * found.standard_errors.at(0));
}

TEST(ClosedLoop, NamesTwoEffectsAtOnce) {
  Scenario scenario = perfect_scenario(parallel_arm(), 5);
  scenario.backlash = {{2, 6e-4}};
  scenario.thermal_offsets = {{.joint = 1, .rad_per_kelvin = 6e-5}};
  const DataSet data = simulate(scenario);
  const std::vector<Effect> effects = added(run_on(scenario, data).outcome);
  ASSERT_EQ(effects.size(), 2u);
  const auto is = [](const char* kind, int joint) {
    return [=](const Effect& effect) { return effect.kind == kind && effect.joint == joint; };
  };
  EXPECT_TRUE(std::ranges::any_of(effects, is("backlash", 2)));
  EXPECT_TRUE(std::ranges::any_of(effects, is("thermal_offset", 1)));
}

TEST(ClosedLoop, KeepsSmoothJointErrorsAndBacklashApart) {
  Scenario scenario = perfect_scenario(parallel_arm(), 7);
  for (int joint = 0; joint < 6; ++joint) {
    scenario.joint_errors.push_back({joint, parse("0.0008*SIN(theta+" + std::to_string(joint) + ")")});
  }
  scenario.backlash = {{1, 5e-4}};
  const DataSet data = simulate(scenario);
  const LoopResult result = run_loop(data, {.registration = true, .joint_corrections = true}, quick());
  const Effect found = only(result);
  EXPECT_EQ(found.kind, "backlash");
  EXPECT_EQ(found.joint, 1);
  EXPECT_LT(over_floor(result.model.robot, data), 1.35);  // 84 terms of 60 poses leave some
}

/// The least error on the validation poses with so many causes at most.
double validation_rms_mm(const LoopResult& result, std::size_t causes) {
  double least = HUGE_VAL;
  for (const ExplanationFront::Point& point : result.front.points)
    if (point.causes <= causes) least = std::min(least, point.validation_rms_mm);
  return least;
}

TEST(ClosedLoop, WithEvolutionOffersNoWorseModelOfAnyNumberOfCauses) {
  // Of two causes evolution finds sets here that are shorter and that the validation poses like less.
  Scenario scenario = perfect_scenario(parallel_arm(), 51);
  scenario.poses = {200, 60, 40};
  for (int joint = 0; joint < 6; ++joint)
    scenario.joint_errors.push_back({joint, parse("0.0008*SIN(theta*theta+" + std::to_string(joint) + ")")});
  scenario.backlash = {{1, 5e-4}, {2, 3e-4}};
  const DataSet data = simulate(scenario);
  LoopOptions options = quick();
  for (const EffectLaw* law : catalogue())  // with jumps among them eight causes are chosen
    if (!law->is_last_resort()) options.kinds.emplace_back(law->kind());
  const LoopResult with = run_loop(data, kZeroed, options);
  options.explanations.variations = 0;
  const LoopResult without = run_loop(data, kZeroed, options);
  ASSERT_GT(without.front.points.size(), 3U);
  const std::size_t chosen = with.front.points[with.front.chosen].causes;
  ASSERT_NE(chosen, 2U);  // what is chosen was judged and fitted anew since
  for (const ExplanationFront::Point& point : without.front.points) {
    if (point.causes == chosen) continue;
    EXPECT_LE(validation_rms_mm(with, point.causes), 1.0001 * validation_rms_mm(without, point.causes))
        << point.causes << " causes";
  }
}

TEST(ClosedLoop, AddsNothingToAModelThatLacksNothing) {
  int with_additions = 0;
  for (std::uint64_t seed = 11; seed < 21; ++seed) {
    const DataSet data = simulate(perfect_scenario(parallel_arm(), seed));
    const LoopResult result = run_loop(data, kZeroed, quick());
    with_additions += !added(result.outcome).empty();
    EXPECT_LT(over_floor(result.model.robot, data), 1.3);
  }
  EXPECT_LE(with_additions, 1);
}

TEST(ClosedLoop, StatesWhatItCouldHaveFound) {
  const DataSet data = simulate(perfect_scenario(parallel_arm(), 22));
  const LoopOutcome outcome = run_loop(data, kZeroed, quick()).outcome;
  ASSERT_THAT(added(outcome), IsEmpty());
  std::size_t backlash = 0;
  for (const NotFound& each : outcome.not_found) {
    if (each.effect.kind != "backlash") continue;
    ++backlash;
    EXPECT_GT(each.smallest_detectable, 1e-5);
    EXPECT_LT(each.smallest_detectable, 5e-3);
    EXPECT_EQ(each.unit, "rad");
  }
  EXPECT_EQ(backlash, 6u);
  EXPECT_THAT(outcome.untestable, IsEmpty());
  EXPECT_EQ(outcome.decoys.size(), 18u);
  for (const Decoy& decoy : outcome.decoys) EXPECT_FALSE(decoy.won);
  EXPECT_EQ(outcome.null_draws, 99);
  EXPECT_GT(outcome.candidates, 100);
}

Scenario with_backlash_and_gear(std::uint64_t seed) {
  Scenario scenario = perfect_scenario(parallel_arm(), seed);
  scenario.backlash = {{1, 8e-4}};
  scenario.gear_harmonics = {{.joint = 2, .ratio = 5, .cosine_rad = 2e-4, .sine_rad = 2e-4}};
  return scenario;
}

TEST(ClosedLoop, GivesTheSameBitsAgain) {
  const DataSet data = simulate(with_backlash_and_gear(23));
  const LoopResult first = run_loop(data, kZeroed, quick()), second = run_loop(data, kZeroed, quick());
  ASSERT_EQ(first.outcome.rounds.size(), second.outcome.rounds.size());
  for (std::size_t i = 0; i < first.outcome.rounds.size(); ++i) {
    EXPECT_EQ(first.outcome.rounds[i].effect.values, second.outcome.rounds[i].effect.values);
    EXPECT_EQ(first.outcome.rounds[i].interval, second.outcome.rounds[i].interval);
    EXPECT_EQ(first.outcome.rounds[i].p_family, second.outcome.rounds[i].p_family);
    EXPECT_EQ(first.outcome.rounds[i].confirmed_lower, second.outcome.rounds[i].confirmed_lower);
  }
  EXPECT_EQ(first.outcome.p_structure_left, second.outcome.p_structure_left);
  const Stop stop(data.poses[0]);
  EXPECT_EQ(first.model.robot.predict(stop, "").matrix(), second.model.robot.predict(stop, "").matrix());
}

TEST(ClosedLoop, AddsNoMoreThanItMay) {
  const DataSet data = simulate(with_backlash_and_gear(24));
  LoopOptions options = quick();
  options.max_effects = 1;
  const LoopResult one = run_loop(data, kZeroed, options);
  EXPECT_EQ(one.model.robot.effects.size(), 1u);
  EXPECT_EQ(one.outcome.stopped, StopReason::max_effects);
  EXPECT_LE(one.outcome.p_structure_left, 0.05);  // the other is still there
  options.max_effects = 0;
  const LoopResult none = run_loop(data, kZeroed, options);
  EXPECT_THAT(none.model.robot.effects, IsEmpty());
  EXPECT_THAT(none.outcome.rounds, IsEmpty());
  EXPECT_EQ(none.outcome.stopped, StopReason::max_effects);
}

TEST(ClosedLoop, SaysWhatIsLeftAlsoWhereItMayAddNoMore) {
  Scenario scenario = perfect_scenario(parallel_arm(), 28);
  scenario.backlash = {{1, 5e-4}};
  LoopOptions options = quick();
  options.max_effects = 1;
  const LoopOutcome outcome = run_loop(simulate(scenario), kZeroed, options).outcome;
  EXPECT_EQ(outcome.stopped, StopReason::max_effects);
  EXPECT_LE(outcome.rounds.at(0).p_structure, 0.05);
  EXPECT_GT(outcome.p_structure_left, 0.05);
}

TEST(ClosedLoop, StopsWhereTheWatcherSaysSo) {
  const DataSet data = simulate(with_backlash_and_gear(25));
  std::vector<int> seen;
  const LoopResult result = run_loop(data, kZeroed, quick(), [&](const Round& round) {
    seen.push_back(round.number);
    return false;
  });
  EXPECT_THAT(seen, ::testing::ElementsAre(1));
  EXPECT_EQ(result.outcome.rounds.size(), 1u);
}

TEST(ClosedLoop, StopsWhereADecoyWins) {
  Scenario scenario = perfect_scenario(parallel_arm(), 26);
  LoopOptions options = quick();
  const double impossible = 1.7320508 * options.highest_ratio;
  scenario.gear_harmonics = {{.joint = 1, .ratio = impossible, .cosine_rad = 3e-4, .sine_rad = 3e-4}};
  const DataSet data = simulate(scenario);
  const LoopResult result = run_loop(data, kZeroed, options);
  EXPECT_EQ(result.outcome.stopped, StopReason::decoy);
  EXPECT_THAT(result.model.robot.effects, IsEmpty());
  EXPECT_EQ(std::ranges::count_if(result.outcome.decoys, [](const Decoy& decoy) { return decoy.won; }), 1);
  EXPECT_EQ(result.outcome.rounds.back().verdict, Verdict::rejected);
  options.decoys = false;
  EXPECT_NE(run_loop(data, kZeroed, options).outcome.stopped, StopReason::decoy);
}

TEST(Rivals, NeverHoldTheEffectItselfInAnotherForm) {
  std::size_t rivals = 0;
  for (const std::uint64_t seed : {81, 82}) {
    Scenario scenario = perfect_scenario(parallel_arm(), seed);
    scenario.compliance = {{1, 2e-5}};
    scenario.couplings = {{.joint = 2, .from = 1, .per_rad = 4e-4}};
    const DataSet data = simulate(scenario);
    for (const Round& round : run_loop(data, kZeroed, quick()).outcome.rounds) {
      rivals += round.rivals.size();
      for (const Rival& rival : round.rivals) {
        const Effect &own = round.effect, &other = rival.effect;
        EXPECT_FALSE(own.kind == other.kind && own.joint == other.joint && own.settings == other.settings)
            << own.kind << " of joint " << own.joint + 1;
      }
    }
  }
  EXPECT_GT(rivals, 0u);
}

}  // namespace
}  // namespace demecal

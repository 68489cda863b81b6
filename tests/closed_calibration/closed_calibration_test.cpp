// The closed loop around a calibration finds what the job does not declare, and nothing where nothing is missing.
#include "closed_calibration/closed_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/island_evolution.hpp"
#include "closed_calibration/loop_passes.hpp"
#include "lacking_arm.hpp"

namespace demecal {
namespace {

constexpr double kWidth_rad = 6e-4;

/// No evolution: what the islands would find is what the test gives them.
ClosedCalibration closed_for(const DataSet& data, const Job& job,
                             const EvolverFunction::Function& evolve = nothing_evolved) {
  const Preparation preparation = prepare(data, job);
  const Calibration first = conclude(data, job, preparation, nothing_evolved(preparation.training).joints);
  EvolverFunction evolver(evolve);
  return close_calibration(data, job, preparation, first, evolver, {});
}

double accept_like_rms(const CorrectedRobot& robot, const DataSet& data) {
  return error_figures(robot, data, poses_of(data, PoseSet::validation)).rms_mm;
}

const Effect* found_backlash(const CorrectedRobot& robot) {
  const auto found = std::ranges::find_if(
      robot.effects, [](const Effect& effect) { return effect.kind == "backlash" && effect.joint == 1; });
  return found == robot.effects.end() ? nullptr : &*found;
}

TEST(ClosedCalibration, FindsUndeclaredBacklashAndItsSize) {
  const DataSet data = lacking_arm(kWidth_rad, 1);
  const ClosedCalibration closed = closed_for(data, looping_job());
  const Effect* backlash = found_backlash(closed.calibration.robot);
  ASSERT_NE(backlash, nullptr);
  ASSERT_EQ(backlash->standard_errors.size(), 1U);
  EXPECT_NEAR(backlash->values[0], kWidth_rad, 5.0 * backlash->standard_errors[0]);
  EXPECT_TRUE(closed.before.effects.empty());
  EXPECT_LT(accept_like_rms(closed.calibration.robot, data), 0.7 * accept_like_rms(closed.before, data));
}

TEST(ClosedCalibration, TellsEveryEffectOfTheModelInARound) {
  const ClosedCalibration closed = closed_for(lacking_arm(kWidth_rad, 2), looping_job());
  std::size_t told = 0;
  for (const Round& round : closed.loop.rounds) told += round.verdict == Verdict::added ? 1 : 0;
  EXPECT_EQ(told, closed.calibration.robot.effects.size());
}

TEST(ClosedCalibration, LeavesAnArmThatLacksNothingAsItIs) {
  int additions = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ClosedCalibration closed = closed_for(lacking_arm(0.0, seed), looping_job());
    additions += static_cast<int>(closed.calibration.robot.effects.size());
    if (!closed.calibration.robot.effects.empty()) continue;
    EXPECT_EQ(closed.before.chain.joints[1].d_m, closed.calibration.robot.chain.joints[1].d_m);
    EXPECT_TRUE(closed.before.sensor_from_base.isApprox(closed.calibration.robot.sensor_from_base, 0.0));
    EXPECT_NE(closed.loop.stopped, StopReason::not_run);
  }
  EXPECT_LE(additions, 1);
}

TEST(ClosedCalibration, EvolvesAnewBesideTheEffects) {
  const DataSet data = lacking_arm(kWidth_rad, 3);
  int evolutions = 0;
  const auto evolve = [&](const std::vector<JointTraining>& training, const EvolutionTerms&) {
    ++evolutions;
    EvolvedJoints evolved = nothing_evolved(training);
    for (JointCandidates& joint : evolved.joints) {
      const char* text = joint.training.joint == 0 ? "0.0008*SIN(theta)" : "0.0006*COS(theta)";
      const Tree scale = constant_tree(1.0 / joint.training.scale_rad);
      if (joint.training.joint == 0 || joint.training.joint == 2)
        joint.front.push_back({apply(Primitive::multiply, scale, parse(text)), 0.0});
    }
    return evolved;
  };
  const ClosedCalibration closed = closed_for(data, looping_job(), evolve);
  EXPECT_GE(evolutions, 1);
  EXPECT_NE(found_backlash(closed.calibration.robot), nullptr);
  EXPECT_LE(accept_like_rms(closed.calibration.robot, data),
            accept_like_rms(closed_for(data, looping_job()).calibration.robot, data));
}

TEST(ClosedCalibration, KeepsTheLoopsModelWhereEvolutionIsCutOff) {
  const DataSet data = lacking_arm(kWidth_rad, 4);
  const ClosedCalibration closed = closed_for(data, looping_job(), [](const auto&, const EvolutionTerms&) {
    return EvolvedJoints{{}, false};
  });
  EXPECT_NE(found_backlash(closed.calibration.robot), nullptr);
}

TEST(ClosedCalibration, StopsWhenToldToAndKeepsWhatItHas) {
  const DataSet data = lacking_arm(kWidth_rad, 5);
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  const Calibration first = conclude(data, job, preparation, nothing_evolved(preparation.training).joints);
  int told = 0, evolutions = 0;
  EvolverFunction evolver([&](const auto& training, const EvolutionTerms&) {
    ++evolutions;
    return nothing_evolved(training);
  });
  const ClosedCalibration closed =
      close_calibration(data, job, preparation, first, evolver, [&](const Round&) { return ++told < 1; });
  EXPECT_EQ(told, 1);
  EXPECT_EQ(evolutions, 0);
  EXPECT_EQ(closed.loop.rounds.size(), 1U);
}

/// Evolves nothing, and counts the loops that begin without corrections.
class LoopCounter final : public Evolver {
 public:
  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms&) override {
    return nothing_evolved(trainings);
  }
  void announce_loop_without_corrections() override { ++loops; }
  int loops = 0;
};

/// Joint 2 errs by a wave of forty per turn, most of which a square wave takes in that was evolved before the loop.
TEST(ClosedCalibration, BeginsWithoutWhatWasEvolvedWhereThatStandsInTheWayOfTheCause) {
  DataSet data = measure(true_puma({"", "0.0006*SIN(40*theta)", "", "", "", ""}), 150, 5e-5, 7, false);
  Job job = looping_job();
  job.closed_loop.candidates = {"gear_harmonic"};
  const Preparation preparation = prepare(data, job);
  const Calibration nothing = conclude(data, job, preparation, nothing_evolved(preparation.training).joints);
  Calibration square = nothing;
  square.robot.corrections[1] = JointCorrection(parse("0.0005*SIGN(SIN(40*theta))"), {}, {-M_PI, M_PI});
  LoopCounter counter;
  const ClosedCalibration bare = close_calibration(data, job, preparation, nothing, counter, {});
  ASSERT_EQ(counter.loops, 0);
  const ClosedCalibration closed = close_calibration(data, job, preparation, square, counter, {});
  EXPECT_EQ(counter.loops, 1);
  EXPECT_LE(accept_like_rms(closed.calibration.robot, data), accept_like_rms(bare.calibration.robot, data));
  ASSERT_EQ(closed.calibration.robot.effects.size(), 1U);
  EXPECT_TRUE(closed.calibration.robot.effects[0].same_law_as(
      {.kind = "gear_harmonic", .joint = 1, .settings = {{"ratio", 40.0}}}));
}

}  // namespace
}  // namespace demecal

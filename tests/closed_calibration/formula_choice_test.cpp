// Which of two models describes the poses better, and what becomes of the other's rounds.
#include "closed_calibration/loop_passes.hpp"

#include <gtest/gtest.h>

#include "calibration/formula_arm.hpp"

namespace demecal {
namespace {

Effect formula_of_joint_3(const char* text, double value) {
  Effect effect{.kind = "symbolic", .joint = 2, .values = {value}};
  effect.formula = parse(text, symbolic_variables(puma()));
  return effect;
}

CorrectedRobot robot_with(const std::vector<Effect>& effects) {
  CorrectedRobot robot = true_puma({"0.0008*SIN(theta)", "", "0.0006*COS(theta)", "", "", ""});
  robot.described.chain = robot.chain;
  robot.effects = effects;
  return robot;
}

const Effect kProduct = formula_of_joint_3("SIN(q1) * SIN(q4)", 8e-4);
const std::vector<Effect> kSum{formula_of_joint_3("COS(q1 - q4)", 4e-4), formula_of_joint_3("COS(q1 + q4)", -4e-4)};

std::vector<Candidate> priced(double product_nats, double term_nats) {
  return {{.effect = kProduct, .naming_cost_nats = product_nats},
          {.effect = kSum[0], .naming_cost_nats = term_nats},
          {.effect = kSum[1], .naming_cost_nats = term_nats}};
}

TEST(FormulaChoice, OfEqualModelsTheShorterDescriptionIsTheBetter) {
  const DataSet data = formula_arm("0.0008 * SIN(q1) * SIN(q4)", 60, 1);
  const CorrectedRobot one = robot_with({kProduct}), two = robot_with(kSum);
  EXPECT_TRUE(describes_better(one, two, data, priced(20.0, 13.0)));
  EXPECT_FALSE(describes_better(two, one, data, priced(20.0, 13.0)));
  EXPECT_FALSE(describes_better(one, two, data, priced(40.0, 13.0)));
}

TEST(FormulaChoice, AShorterDescriptionThatFailsOnTheValidationPosesIsNotBetter) {
  DataSet data = formula_arm("0.0008 * SIN(q1) * SIN(q4)", 60, 2);
  const CorrectedRobot one = robot_with({kProduct}), none = robot_with({});
  EXPECT_TRUE(describes_better(one, none, data, priced(20.0, 13.0)));
  for (MeasuredPose& pose : data.poses) {
    if (pose.set == PoseSet::validation) pose.position_m = none.predict(Stop(pose), "").translation();
  }
  EXPECT_FALSE(describes_better(one, none, data, priced(20.0, 13.0)));
}

TEST(FormulaChoice, AsksForFormulasWhereTheLoopEndedAndSomethingIsLeftOrUnnamed) {
  LoopOutcome loop;
  loop.stopped = StopReason::no_gain;
  loop.p_structure_left = 0.5;
  ClosedLoopOptions options;
  EXPECT_FALSE(needs_formula_search(loop, robot_with({}), options));
  EXPECT_TRUE(needs_formula_search(loop, robot_with({kProduct}), options));
  loop.p_structure_left = 0.01;
  EXPECT_TRUE(needs_formula_search(loop, robot_with({}), options));
  options.candidates = {"backlash"};
  EXPECT_FALSE(needs_formula_search(loop, robot_with({}), options));
  options.candidates = {"backlash", "symbolic"};
  EXPECT_TRUE(needs_formula_search(loop, robot_with({}), options));
  loop.stopped = StopReason::decoy;
  EXPECT_FALSE(needs_formula_search(loop, robot_with({}), options));
}

TEST(FormulaChoice, NotesWhatAnUnkeptPassAddedAsRejected) {
  LoopOutcome outcome, pass;
  outcome.rounds.resize(2);
  outcome.rounds[1].group = 3;
  for (const Effect& effect : {kProduct, kSum[0]}) {
    pass.rounds.emplace_back();
    pass.rounds.back().verdict = Verdict::added;
    pass.rounds.back().effect = effect;
  }
  append_rejected_rounds(pass, robot_with({kSum[0]}), outcome);
  ASSERT_EQ(outcome.rounds.size(), 3U);
  EXPECT_TRUE(outcome.rounds[2].effect.same_law_as(kProduct));
  EXPECT_EQ(outcome.rounds[2].verdict, Verdict::rejected);
  EXPECT_FALSE(outcome.rounds[2].reason.empty());
  EXPECT_EQ(outcome.rounds[2].number, 3);
  EXPECT_EQ(outcome.rounds[2].group, 4);
}

TEST(FormulaChoice, WithoutFormulasLeavesNamedEffects) {
  const Effect backlash{.kind = "backlash", .joint = 1, .values = {1e-4}};
  const CorrectedRobot bare = without_formulas(robot_with({kProduct, backlash, kSum[0]}));
  ASSERT_EQ(bare.effects.size(), 1U);
  EXPECT_EQ(bare.effects[0].kind, "backlash");
}

}  // namespace
}  // namespace demecal

// The closed loop on simulated arms that err as no effect of the catalogue does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulated_arm.hpp"

namespace demecal {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

/// What the model's effects add to a joint, about its axis.
double motion_of(const CorrectedRobot& model, const Visit& visit, Eigen::Index joint) {
  Stop stop(visit.commanded);
  stop.approach = visit.approach;
  return (model.actual_joints(stop) - model.corrected_joints(stop.joints))[joint];
}

TEST(ClosedLoop, RecoversAFormulaThatIsInNoCatalogue) {
  Scenario scenario = perfect_scenario(parallel_arm(), 6);
  Tree formula = parse("0.0004*SIN(q2+2*q3)", symbolic_variables(6));
  scenario.symbolic = {{.joint = 2, .formula = formula}};
  const DataSet data = simulate(scenario);
  LoopOptions options = quick();
  options.formulas = true;
  const LoopResult result = run_loop(data, kZeroed, options);
  EXPECT_LT(over_floor(result.model.robot, data), 1.15);
  EXPECT_GT(over_floor(result.before.robot, data), 1.5);
  RandomStream stream{91, 1};
  Eigen::VectorXd found(300), truth(300);
  for (Eigen::Index i = 0; i < 300; ++i) {
    Visit visit{.commanded = 0.8 * random_joints(stream, scenario.robot.chain), .approach = ApproachSigns::Zero(6)};
    found[i] = motion_of(result.model.robot, visit, 2);
    truth[i] = 4e-4 * std::sin(visit.commanded[1] + 2 * visit.commanded[2]);
  }
  found.array() -= found.mean();
  truth.array() -= truth.mean();
  EXPECT_GT(found.dot(truth) / (found.norm() * truth.norm()), 0.98);
}

TEST(ClosedLoop, FindsThePhaseOfAWave) {
  Scenario scenario = perfect_scenario(parallel_arm(), 28);
  scenario.symbolic = {{.joint = 2, .formula = parse("0.0004*COS(q2-q5+0.7)", symbolic_variables(6))}};
  LoopOptions options = quick();
  options.formulas = true;
  const Effect found = only(run_loop(simulate(scenario), kZeroed, options));
  EXPECT_EQ(found.form, "wave");
  EXPECT_EQ(found.joint, 2);
  EXPECT_EQ(found.formula, parse("q2-q5", symbolic_variables(6)));
  EXPECT_NEAR(found.value(0), 4e-4 * std::cos(0.7), 5e-5);
  EXPECT_NEAR(found.value(1), -4e-4 * std::sin(0.7), 5e-5);
}

TEST(ClosedLoop, HoldsEvolvedFormulasAgainstWhatTheSameSearchFindsInNoise) {
  Scenario scenario = perfect_scenario(parallel_arm(), 27);
  const Tree formula = parse("q1*q4*q2", symbolic_variables(6));
  scenario.symbolic = {{.joint = 1, .formula = apply(Primitive::multiply, constant_tree(3e-4), formula)}};
  const DataSet data = simulate(scenario);
  LoopOptions options = quick();
  options.evolved = {{.effect = {.kind = "symbolic", .joint = 1}, .evolved = true}};
  options.evolved[0].effect.formula = formula;
  options.evolved_null_gains = {0.0, 1.0, 2.0};
  const LoopOutcome rare = run_loop(data, kZeroed, options).outcome;
  ASSERT_FALSE(rare.rounds.empty());
  EXPECT_EQ(rare.rounds[0].null_draws, 3);
  EXPECT_DOUBLE_EQ(rare.rounds[0].p_family, 0.25);
  EXPECT_EQ(rare.rounds[0].verdict, Verdict::rejected);  // 3 searches cannot show 5 %
  options.evolved_null_gains.assign(19, 1.0);
  EXPECT_EQ(run_loop(data, kZeroed, options).outcome.rounds[0].verdict, Verdict::added);
  options.evolved_null_gains.back() = 1e6;
  EXPECT_DOUBLE_EQ(run_loop(data, kZeroed, options).outcome.rounds[0].p_family, 0.1);
}

TEST(ClosedLoop, TriesFormulasThatEvolutionFound) {
  Scenario scenario = perfect_scenario(parallel_arm(), 27);
  const Tree formula = parse("q1*q4*q2", symbolic_variables(6));
  Tree truth = apply(Primitive::multiply, constant_tree(3e-4), formula);
  scenario.symbolic = {{.joint = 1, .formula = truth}};
  const DataSet data = simulate(scenario);
  LoopOptions options = quick();
  options.evolved = {{.effect = {.kind = "symbolic", .joint = 1}}, {.effect = {.kind = "symbolic", .joint = 1}}};
  options.evolved[0].effect.formula = formula;
  options.evolved[1].effect.formula = parse("q1*q5", symbolic_variables(6));
  const Effect found = only(run_loop(data, kZeroed, options));
  EXPECT_EQ(found.kind, "symbolic");
  EXPECT_NEAR(found.value(0), 3e-4, 2e-5);
  EXPECT_THAT(found.ranges, Not(IsEmpty()));
}

}  // namespace
}  // namespace demecal

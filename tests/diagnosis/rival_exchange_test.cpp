// Of rivals that the fitted poses do not tell apart, all poses that may choose tell the true one.
#include "diagnosis/rival_exchange.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulated_arm.hpp"

namespace demecal {
namespace {

constexpr DeclaredModel kZeroedAndPlaced{.registration = true, .tool = true, .joint_offset = true};

Effect wave(double ratio) {
  return {.kind = "gear_harmonic", .joint = 1, .settings = {{"ratio", ratio}}, .values = {0.0, 0.0}};
}

/// Joint 2 errs nine times per turn. Fitted are poses over a few degrees of it, which hardly tell 9 from 9.4.
DataSet rippling_arm() {
  Scenario scenario = perfect_scenario(parallel_arm(), 12);
  scenario.poses = {300, 0, 0};
  scenario.joint_ranges[1] = {-1.5, 1.5};
  scenario.joint_errors.push_back({1, parse("0.0004*SIN(9*theta)")});
  return simulate(scenario);
}

DiagnosisProblem of_few_degrees(const DataSet& data, bool validated) {
  DiagnosisProblem problem{data, kZeroedAndPlaced, {}, {}};
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    const bool is_near = std::abs(data.poses[i].joints[1]) < 0.4;
    if (is_near) problem.fitted.push_back(i);
    if (!is_near && validated) problem.validation.push_back(i);
  }
  return problem;
}

/// What is left of a model with the first effect where the second is its rival.
std::vector<std::size_t> left_of(const DiagnosisProblem& problem, const Effect& first, const Effect& second) {
  const Fit start = fit_declared(problem.data, problem.fitted, problem.declared, nominal_robot(problem.data));
  DiagnosedModel model = diagnosed_model(problem, start);
  model.robot.effects = {first};
  model = refined(problem, model, 4);
  const std::vector<PricedEffect> effects{{first, 2.0}, {second, 2.0}};
  const SetModels models(problem, model, effects);
  const auto rivals = rivals_beside(FittedSet(models.problem(), {0}), 0, effects);
  EXPECT_EQ(rivals.size(), 1U);
  return with_better_rivals(problem, models, effects, {0});
}

TEST(RivalExchange, TakesTheOneThatAllPosesDescribeMoreShortly) {
  const DataSet data = rippling_arm();
  const DiagnosisProblem problem = of_few_degrees(data, true);
  EXPECT_EQ(left_of(problem, wave(9.4), wave(9.0)), std::vector<std::size_t>{1});
  EXPECT_EQ(left_of(problem, wave(9.0), wave(9.4)), std::vector<std::size_t>{0});
}

TEST(RivalExchange, TakesNoneWhereNoOtherPosesTell) {
  const DataSet data = rippling_arm();
  const DiagnosisProblem problem = of_few_degrees(data, false);
  EXPECT_EQ(left_of(problem, wave(9.4), wave(9.0)), std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace demecal

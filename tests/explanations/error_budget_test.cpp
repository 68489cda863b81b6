// What causes cost: the model without some of them is what a fit without them gives, and the dear ones are known.
#include "explanations/error_budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "diagnosis/simulated_arm.hpp"
#include "effects/catalogue.hpp"

namespace demecal {
namespace {

Effect effect(const std::string& kind, int joint) {
  return {.kind = kind, .joint = joint, .settings = {}};
}

TEST(Causes, AreWhatAnEngineerCountsAsOne) {
  CorrectedRobot robot;
  robot.effects = {effect("gear_harmonic", 1), effect("backlash", 1),       effect("gear_harmonic", 1),
                   effect("compliance", 1),    effect("hysteresis", 1),     effect("link_bending", 2),
                   effect("gear_harmonic", 2), effect("thermal_offset", 0), effect("thermal_length", 3)};
  const std::vector<ErrorCause> causes = causes_of(robot);
  std::vector<std::string> names;
  std::vector<std::size_t> effects;
  for (const ErrorCause& cause : causes) {
    names.push_back(to_string(cause));
    effects.insert(effects.end(), cause.effects.begin(), cause.effects.end());
  }
  EXPECT_THAT(names,
              testing::ElementsAre("gears of joint 2", "lost motion of joint 2", "elasticity of the arm under gravity",
                                   "gears of joint 3", "temperature of the arm"));
  EXPECT_THAT(causes.at(0).effects, testing::ElementsAre(0, 2));
  EXPECT_THAT(effects, testing::UnorderedElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(Causes, HaveAWordAndAnAdviceForEveryKindOfTheCatalogue) {
  std::set<std::string> words;
  for (const EffectLaw* law : catalogue()) {
    CorrectedRobot robot;
    robot.effects = {{.kind = std::string(law->kind()), .joint = 0}};
    const ErrorCause cause{.group = cause_of(law->kind()).group, .joint = 0, .effects = {0}};
    words.insert(std::string(to_string(cause.group)));
    EXPECT_FALSE(to_string(cause).empty()) << law->kind();
    EXPECT_TRUE(advice_on(cause, robot).ends_with('.')) << law->kind();
  }
  EXPECT_EQ(words.size(), 12U);
}

TEST(Causes, AreAdvisedOnInNoSentenceTwice) {
  CorrectedRobot robot;
  robot.effects = {effect("gear_harmonic", 1), effect("gain", 1), effect("eccentricity", 1), effect("coupling", 1)};
  for (Effect& one : robot.effects) one.values = {1.0, 1.0};
  robot.effects[0].settings = {{"ratio", 2.0}};
  robot.effects[3].settings = {{"from", 2.0}};
  const std::string advice = advice_on(causes_of(robot).front(), robot);
  const std::string first = advice.substr(0, advice.find(". ") + 1);
  EXPECT_EQ(advice.find(first, first.size()), std::string::npos) << advice;
}

/// An arm whose joint 2 has lost motion, and whose joint 3 gives way a little: found, and judged.
class TwoCauses : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Scenario scenario = perfect_scenario(parallel_arm(), 5);
    scenario.backlash = {{1, 1e-3}};
    scenario.compliance = {{2, 1.5e-5}};
    data_ = std::make_unique<DataSet>(simulate(scenario));
    problem_ = std::make_unique<DiagnosisProblem>(DiagnosisProblem{
        *data_, kZeroed, poses_of(*data_, PoseSet::calibration), poses_of(*data_, PoseSet::validation)});
    model_ = run_loop(*data_, kZeroed, quick()).model;
  }
  static void TearDownTestSuite() {
    problem_.reset();
    data_.reset();
  }
  void SetUp() override { ASSERT_EQ(model_.robot.effects.size(), 2U); }

  static ErrorBudget budgeted() {
    return error_budget(*problem_, model_, pruned_front(*problem_, model_), problem_->fitted, model_,
                        RandomStream{1, 2});
  }

  static std::unique_ptr<DataSet> data_;
  static std::unique_ptr<DiagnosisProblem> problem_;
  static DiagnosedModel model_;
};

std::unique_ptr<DataSet> TwoCauses::data_;
std::unique_ptr<DiagnosisProblem> TwoCauses::problem_;
DiagnosedModel TwoCauses::model_;

/// Models with the effects of a model, at no price.
SetModels models_about(const DiagnosisProblem& problem, const DiagnosedModel& model) {
  std::vector<PricedEffect> effects;
  for (const Effect& one : model.robot.effects) effects.push_back({one, 0.0});
  return {problem, model, effects};
}

TEST_F(TwoCauses, OffersWhatASetIsWithoutTheCauseThatIsMissedLeast) {
  const SetModels models = models_about(*problem_, model_);
  const std::vector<PricedEffect> effects{{model_.robot.effects[0], 0.0}, {model_.robot.effects[1], 0.0}};
  const auto front_of_sets = [&](const std::vector<EffectSet>& sets) {
    return judged_front(*problem_, model_, models, effects, sets);
  };
  const ExplanationFront told = front_of_sets({{{}, 0}, {{0}, 1}, {{1}, 1}, {{0, 1}, 2}});
  for (const std::size_t single : {std::size_t{0}, std::size_t{1}}) {
    const ExplanationFront found = front_of_sets({{{}, 0}, {{single}, 1}, {{0, 1}, 2}});
    ASSERT_EQ(found.points.size(), 3U);
    EXPECT_EQ(found.points[1].set, told.points[1].set);
    EXPECT_EQ(found.points[1].validation_rms_mm, told.points[1].validation_rms_mm);
  }
}

TEST_F(TwoCauses, AModelWithoutAnEffectIsWhatAFitWithoutItGives) {
  const SetModels models = models_about(*problem_, model_);
  for (const std::size_t gone : {std::size_t{0}, std::size_t{1}}) {
    DiagnosedModel again = model_;
    again.noise_estimated = false;  // else nearly all poses are far out by the scatter about the whole model
    again.noise = {};
    again.robot.effects.erase(again.robot.effects.begin() + static_cast<std::ptrdiff_t>(gone));
    again = refined(*problem_, again, 12);
    const CorrectedRobot reduced = models.with({1 - gone}).robot;
    ASSERT_EQ(reduced.effects.size(), 1U);
    EXPECT_EQ(reduced.effects[0].kind, again.robot.effects[0].kind);
    for (const std::size_t pose : problem_->validation) {
      const double cost_mm = 1e3 * tool_error_m(again.robot, *data_, data_->poses[pose]);
      EXPECT_NEAR(1e3 * tool_error_m(reduced, *data_, data_->poses[pose]), cost_mm, 0.1 * cost_mm + 0.02);
    }
  }
}

TEST_F(TwoCauses, AModelWithAllItsEffectsIsItself) {
  const SetModels models = models_about(*problem_, model_);
  EXPECT_THAT(models.held(), testing::ElementsAre(0, 1));
  const CorrectedRobot same = models.with({0, 1}).robot;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < same.effects[i].values.size(); ++k)
      EXPECT_NEAR(same.effects[i].values[k], model_.robot.effects[i].values[k],
                  0.01 * std::abs(model_.robot.effects[i].values[k]));
}

TEST_F(TwoCauses, WhatSetsLeaveFallsWithEveryEffect) {
  const SetModels models = models_about(*problem_, model_);
  const FittedSet both(models.problem(), {0, 1});
  for (const std::size_t one : {std::size_t{0}, std::size_t{1}}) {
    const FittedSet alone(models.problem(), {one});
    EXPECT_LT(alone.squares(), models.problem().squares);
    EXPECT_LT(both.squares(), alone.squares());
    EXPECT_NEAR(both.squares() + both.rise_without(1 - one), alone.squares(), 1e-6 * alone.squares());
  }
}

TEST_F(TwoCauses, AModelThatErrsLessIsChosenOverItsParts) {
  const SetModels models = models_about(*problem_, model_);
  const ExplanationFront front = judged_front(*problem_, model_, models, {}, prunings(models.problem(), models.held()));
  EXPECT_EQ(front.points.size(), 3U);
  EXPECT_EQ(front.best, 2U);
  EXPECT_EQ(front.chosen, 2U);
  EXPECT_TRUE(does_as_well(*problem_, model_, models.with({})));
  EXPECT_FALSE(does_as_well(*problem_, models.with({}), model_));
}

TEST_F(TwoCauses, OfSetsOfAsManyCausesTheOneThatErrsLeastStandsForThem) {
  const SetModels models = models_about(*problem_, model_);
  std::vector<EffectSet> sets(3);
  sets[0] = {.effects = {}, .causes = 0};
  std::vector<double> left_mm;
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
    sets[1] = {.effects = {first}, .causes = 1};
    sets[2] = {.effects = {1 - first}, .causes = 1};
    const ExplanationFront front = judged_front(*problem_, model_, models, {}, sets);
    ASSERT_EQ(front.points.size(), 2U);
    left_mm.push_back(front.points[1].validation_rms_mm);
    for (const std::size_t only : {first, 1 - first}) {
      sets[1] = {.effects = {only}, .causes = 1};
      const auto alone = judged_front(*problem_, model_, models, {}, {sets[0], sets[1]});
      EXPECT_LE(front.points[1].validation_rms_mm, alone.points[1].validation_rms_mm);
    }
  }
  EXPECT_EQ(left_mm[0], left_mm[1]);
}

/// The front of a model with one small effect, which its arm has.
ExplanationFront front_of_small_backlash(std::uint64_t seed, bool has_effect) {
  Scenario scenario = perfect_scenario(parallel_arm(), seed);
  scenario.backlash = {{1, 5e-5}};
  const DataSet data = simulate(scenario);
  const DiagnosisProblem problem{data, kZeroed, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  DiagnosedModel model = diagnosed_model(problem, fit_declared(data, problem.fitted, kZeroed, nominal_robot(data)));
  model.robot.effects = {effect("backlash", 1)};
  model.robot.effects[0].values = {5e-5};
  model = refined(problem, model, 5);
  const SetModels models = models_about(problem, model);
  if (!has_effect) model.robot.effects.clear();
  return judged_front(problem, model, models, {}, prunings(models.problem(), models.held()));
}

TEST(Choice, KeepsASmallCauseThatTheLoopHasTestedWhereTheValidationPosesAgree) {
  int small = 0, kept = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const ExplanationFront front = front_of_small_backlash(seed, true);
    ASSERT_EQ(front.points.size(), 2U);
    const double without_mm = front.points[0].validation_rms_mm, with_mm = front.points[1].validation_rms_mm;
    EXPECT_EQ(front.chosen, with_mm < without_mm ? 1U : 0U) << seed;
    if (with_mm >= without_mm || without_mm > 1.02 * with_mm) continue;
    ++small;
    kept += front_of_small_backlash(seed, false).chosen == 1 ? 1 : 0;  // of a model that the loop gave no cause
  }
  EXPECT_GE(small, 3);
  EXPECT_LT(kept, small);
}

TEST_F(TwoCauses, CostWhatTheyAreWorthAndTheDearerStandsFirst) {
  const ErrorBudget budget = budgeted();
  ASSERT_EQ(budget.causes.size(), 2U);
  EXPECT_GE(budget.causes[0].without_mm, budget.causes[1].without_mm);
  for (const CauseCost& cost : budget.causes) {
    EXPECT_GT(cost.without_mm, cost.with_mm);
    EXPECT_GT(cost.share, 0.0);
    EXPECT_LT(cost.share, 1.0);
    const double worth_mm = std::sqrt(cost.without_mm * cost.without_mm - cost.with_mm * cost.with_mm);
    EXPECT_LT(cost.interval_mm[0], worth_mm);
    EXPECT_GT(cost.interval_mm[1], worth_mm);
  }
}

TEST_F(TwoCauses, FrontGoesFromNoneToAllAndEveryCauseHelps) {
  const ErrorBudget budget = budgeted();
  ASSERT_EQ(budget.front.size(), 3U);
  for (std::size_t number = 0; number < budget.front.size(); ++number) {
    const FrontPoint& point = budget.front[number];
    EXPECT_EQ(point.causes, number);
    EXPECT_EQ(point.chosen, number == 2);
    ASSERT_TRUE(point.accept_rms_mm.has_value());
    if (number > 0) {
      EXPECT_LT(point.validation_rms_mm, budget.front[number - 1].validation_rms_mm);
      EXPECT_LT(*point.accept_rms_mm, *budget.front[number - 1].accept_rms_mm);
    }
  }
  const double present_mm = error_figures(model_.robot, *data_, poses_of(*data_, PoseSet::accept)).rms_mm;
  EXPECT_NEAR(*budget.front.back().accept_rms_mm, present_mm, 1e-3);
}

TEST_F(TwoCauses, TheModelErrsTheSameWhereverItStandsAndOfFewerCausesTheBestKnownIsTold) {
  ExplanationFront front = pruned_front(*problem_, model_);
  ASSERT_EQ(front.points.size(), 3U);
  front.points[1].set = {1 - front.points[1].set.at(0)};  // as if the search had come by the worse one alone
  const ErrorBudget budget = error_budget(*problem_, model_, front, problem_->fitted, model_, RandomStream{1, 2});
  const double own_mm = error_figures(model_.robot, *data_, problem_->validation).rms_mm;
  EXPECT_NEAR(budget.front[2].validation_rms_mm, own_mm, 1e-9);
  for (const CauseCost& cost : budget.causes) EXPECT_NEAR(cost.with_mm, own_mm, 1e-9);
  EXPECT_NEAR(budget.front[1].validation_rms_mm, budget.causes[1].without_mm, 1e-9);
  const double accept_mm = *budget.front[1].accept_rms_mm;
  EXPECT_NEAR(accept_mm, *budgeted().front[1].accept_rms_mm, 1e-9);
}

TEST_F(TwoCauses, OneGrossErrorChangesNoCost) {
  const ErrorBudget before = budgeted();
  DataSet spoilt = *data_;
  spoilt.poses[problem_->validation.front()].position_m->x() += 2.0;
  const DiagnosisProblem problem{spoilt, kZeroed, problem_->fitted, problem_->validation};
  const ErrorBudget after =
      error_budget(problem, model_, pruned_front(problem, model_), problem_->fitted, model_, RandomStream{1, 2});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(after.causes[i].without_mm, before.causes[i].without_mm, 0.1 * before.causes[i].without_mm);
}

TEST(ErrorBudget, OfAModelWithoutEffectsIsEmpty) {
  const DataSet data = simulate(perfect_scenario(parallel_arm(), 6));
  const DiagnosisProblem problem{data, kZeroed, poses_of(data, PoseSet::calibration), {}};
  const DiagnosedModel model =
      diagnosed_model(problem, fit_declared(data, problem.fitted, kZeroed, nominal_robot(data)));
  const ErrorBudget budget = error_budget(problem, model, {}, problem.fitted, model, RandomStream{1});
  EXPECT_TRUE(budget.causes.empty());
  EXPECT_TRUE(budget.front.empty());
}

}  // namespace
}  // namespace demecal

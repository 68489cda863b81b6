// An island of explanations is a function of what it was given: another goes on from its state to the bit, and what it
// learns from comes through the wire's plain numbers unchanged.
#include "effect_sets/set_island.hpp"

#include <gtest/gtest.h>

#include "deceptive.hpp"
#include "effect_sets/set_training.hpp"

namespace demecal {
namespace {

const SetSearch kSearch{.known = {1, 2, 7}, .search = {.variations = 400}, .stream = 12345};

/// What a neighbour would send: the best of an island of other random numbers after so many epochs.
Population sent_after(const ExplanationProblem& problem, std::uint32_t epochs) {
  SetIsland neighbour(problem, kSearch, {0, 3});
  while (neighbour.state().epoch < epochs) neighbour.run_epoch({});
  return neighbour.emigrants();
}

TEST(SetIsland, GoesOnFromAnyStateToTheBit) {
  const ExplanationProblem problem = deceptive(21);
  for (std::uint32_t handed_over = 1; handed_over < kSetEpochs; ++handed_over) {
    const SetSearch from_nothing{.known = {}, .search = {.variations = 400}, .stream = 12345};
    SetIsland whole(problem, from_nothing, {0, 1}), second(problem, from_nothing, {0, 1});
    while (!whole.finished()) {
      if (whole.state().epoch == handed_over) second.restore(whole.state());
      const Population immigrants = whole.state().epoch == 0 ? Population{} : sent_after(problem, whole.state().epoch);
      if (whole.state().epoch >= handed_over) second.run_epoch(immigrants);
      whole.run_epoch(immigrants);
    }
    EXPECT_EQ(whole.state(), second.state()) << "from epoch " << handed_over;
    EXPECT_GT(whole.state().migrants_taken, 0U);
    EXPECT_EQ(whole.state().evaluations, 100U);
  }
}

TEST(SetIsland, OfOtherRandomNumbersFindsOtherSets) {
  const ExplanationProblem problem = deceptive(22);
  SetIsland one(problem, kSearch, {0, 1}), other(problem, kSearch, {0, 2});
  one.run_epoch({});
  other.run_epoch({});
  EXPECT_NE(one.state().population, other.state().population);
}

TEST(SetIsland, SendsTheBestOfEveryNumberOfCauses) {
  const ExplanationProblem problem = deceptive(23);
  SetIsland island(problem, kSearch, {0, 0});
  while (!island.finished()) island.run_epoch({});
  std::size_t before = 0;
  for (const Individual& sent : island.emigrants()) {
    const FittedSet set = fitted_set(problem, sent);
    EXPECT_TRUE(before == 0 || set.causes().size() > before);
    before = set.causes().size();
    EXPECT_NEAR(sent.fitness, std::exp(set.description_nats() / problem.rows), 1e-12);
  }
  EXPECT_LT(island.figures().best, 1.0);
  EXPECT_LE(island.figures().best, island.figures().median);
}

TEST(SetTraining, IsTheProblemToTheBit) {
  ExplanationProblem problem = deceptive(24);
  problem.spans = {{0, 2}, {2, 0}, {2, 3}};
  for (Eigen::Index i = 5; i < 40; ++i) problem.spans.push_back({i, 1});
  problem.cause.resize(problem.spans.size());
  problem.naming_costs_nats.resize(problem.spans.size());
  const SetTraining training = set_training(problem, kSearch);
  const ExplanationProblem again = problem_of(training);
  EXPECT_EQ(again.gram, problem.gram);
  EXPECT_EQ(again.moment, problem.moment);
  EXPECT_EQ(set_training(again, search_of(training)), training);
  ASSERT_EQ(again.spans.size(), problem.spans.size());
  for (std::size_t i = 0; i < problem.spans.size(); ++i) {
    EXPECT_EQ(again.spans[i].first, problem.spans[i].first);
    EXPECT_EQ(again.spans[i].count, problem.spans[i].count);
  }
}

}  // namespace
}  // namespace demecal

// The search over sets of effects: it is never worse than what it begins with, and finds pairs that no step of adding
// one after another does.
#include "explanations/explanation_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../effect_sets/deceptive.hpp"

namespace demecal {
namespace {

/// What adding the best effect each time ends with.
std::vector<std::size_t> added_one_by_one(const ExplanationProblem& problem) {
  FittedSet set(problem);
  for (;;) {
    FittedSet best = set;
    for (std::size_t i = 0; i < problem.spans.size(); ++i) {
      if (set.holds(i)) continue;
      FittedSet more = set;
      more.add(i);
      if (more.description_nats() < best.description_nats()) best = more;
    }
    if (best.effects().size() == set.effects().size()) return set.effects();
    set = best;
  }
}

TEST(ExplanationSearch, FindsPairsThatAddingOneByOneDoesNot) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ExplanationProblem problem = deceptive(seed);
    const std::vector<std::size_t> greedy = added_one_by_one(problem);
    const auto front = search_explanations(problem, set_search(greedy, {.variations = 500}, RandomStream{seed}));
    const auto best = std::ranges::min_element(front, {}, &EffectSet::description_nats);
    const double greedy_nats = FittedSet(problem, greedy).description_nats();
    EXPECT_LE(best->description_nats, greedy_nats + 1e-9);
    EXPECT_THAT(best->effects, testing::ElementsAre(1, 2, 7));
    better += best->description_nats < greedy_nats - 1.0;
  }
  EXPECT_GT(better, 0) << "adding one by one found all of them: the test shows nothing";
}

TEST(ExplanationSearch, GoesByNumberOfCausesAndNeverBeyondWhatItMay) {
  const ExplanationProblem problem = deceptive(8);
  const auto front = search_explanations(
      problem, set_search({1, 2, 7}, {.variations = 300, .most_causes = 4, .most_effects = 6}, RandomStream{1}));
  for (std::size_t i = 0; i < front.size(); ++i) {
    EXPECT_EQ(front[i].causes, i);
    EXPECT_LE(front[i].causes, 4U);
    EXPECT_LE(front[i].effects.size(), 6U);
    EXPECT_TRUE(std::ranges::is_sorted(front[i].effects));
    EXPECT_NEAR(front[i].description_nats, FittedSet(problem, front[i].effects).description_nats(), 1e-9);
  }
}

TEST(ExplanationSearch, GivesTheSameSetsForTheSameSeed) {
  const ExplanationProblem problem = deceptive(9);
  const auto one = search_explanations(problem, set_search({}, {.variations = 200}, RandomStream{7}));
  const auto other = search_explanations(problem, set_search({}, {.variations = 200}, RandomStream{7}));
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].effects, other[i].effects);
    EXPECT_EQ(one[i].description_nats, other[i].description_nats);
  }
}

TEST(ExplanationSearch, WithoutVariationsLeavesOneCauseOutAfterAnother) {
  const ExplanationProblem problem = deceptive(10);
  const auto front = prunings(problem, {1, 2, 7});
  ASSERT_EQ(front.size(), 4U);
  EXPECT_TRUE(front[0].effects.empty());
  EXPECT_THAT(front[3].effects, testing::ElementsAre(1, 2, 7));
  for (std::size_t i = 0; i + 1 < front.size(); ++i)
    EXPECT_TRUE(std::ranges::includes(front[i + 1].effects, front[i].effects));
}

TEST(ExplanationSearch, FindsNothingInNoise) {
  RandomStream random{11};
  Eigen::MatrixXd columns(kRows, 300);
  for (Eigen::Index i = 0; i < columns.cols(); ++i) columns.col(i) = drawn(random);
  ExplanationProblem problem = made_of(columns, 14.0 * drawn(random), 30);
  for (double& cost : problem.naming_costs_nats) cost = std::log(300.0) + 2.0;
  for (const EffectSet& set : search_explanations(problem, set_search({}, {.variations = 500}, RandomStream{1})))
    EXPECT_GE(set.description_nats, -1.0) << set.causes << " causes";
}

}  // namespace
}  // namespace demecal

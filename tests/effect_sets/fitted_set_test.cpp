// A set of effects: its arithmetic is that of least squares, however it came about.
#include "effect_sets/fitted_set.hpp"
#include "decompositions/decompositions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "deceptive.hpp"

namespace demecal {
namespace {

/// The same columns as effects of one to three, and one of none.
ExplanationProblem of_several_columns(ExplanationProblem problem) {
  problem.spans.clear();
  for (Eigen::Index first = 0, count = 1; first + count <= problem.moment.size(); first += count, count = count % 3 + 1)
    problem.spans.push_back({first, count});
  problem.spans.insert(problem.spans.begin() + 2, {problem.spans[2].first, 0});
  problem.naming_costs_nats.resize(problem.spans.size());
  problem.cause.resize(problem.spans.size());
  return problem;
}

TEST(FittedSet, IsLeastSquaresHoweverItCameAbout) {
  const ExplanationProblem problem = deceptive(3);
  RandomStream random{4};
  FittedSet set(problem);
  for (int step = 0; step < 200; ++step) {
    const std::size_t effect = random.index(problem.spans.size());
    if (set.effects().size() > 12 || (random.chance(0.4) && !set.effects().empty())) {
      set.remove(random.index(set.effects().size()));
    } else if (!set.holds(effect)) {
      set.add(effect);
    }
    const std::vector<std::size_t>& held = set.effects();
    const std::vector<Eigen::Index> at(held.begin(), held.end());
    const Eigen::VectorXd solution = PivotedCholesky(problem.gram(at, at)).solve(problem.moment(at).eval());
    EXPECT_NEAR(set.squares(), problem.squares - solution.dot(problem.moment(at)), 1e-6 * problem.squares);
    ASSERT_EQ(set.columns(), solution.size());
    if (solution.size() == 0) continue;
    EXPECT_LT((set.coefficients() - solution).norm(), 1e-6 * (1.0 + solution.norm()));
    for (std::size_t i = 0; i < held.size(); ++i)
      EXPECT_NEAR(set.moments_left()[static_cast<Eigen::Index>(held[i])], 0.0, 1e-6);
  }
}

TEST(FittedSet, OfEffectsAtOnceIsThatOfOneAfterAnother) {
  const ExplanationProblem problem = deceptive(7);
  const std::vector<std::size_t> effects{9, 2, 14, 5, 11};
  FittedSet grown(problem);
  for (const std::size_t effect : effects) grown.add(effect);
  const FittedSet set(problem, effects);
  EXPECT_EQ(set.effects(), effects);
  EXPECT_NEAR(set.description_nats(), grown.description_nats(), 1e-9 * std::abs(grown.description_nats()));
  EXPECT_LT((set.coefficients() - grown.coefficients()).norm(), 1e-9 * grown.coefficients().norm());
  EXPECT_LT((set.moments_left() - grown.moments_left()).norm(), 1e-9 * problem.moment.norm());
}

TEST(FittedSet, OfEffectsOfSeveralColumnsIsThatOfAllAtOnce) {
  const ExplanationProblem problem = of_several_columns(deceptive(8));
  ASSERT_GT(problem.spans.size(), 5U);
  RandomStream random{9};
  FittedSet set(problem);
  for (int step = 0; step < 100; ++step) {
    const std::size_t effect = random.index(problem.spans.size());
    if (set.holds(effect)) {
      set.remove(static_cast<std::size_t>(std::ranges::find(set.effects(), effect) - set.effects().begin()));
    } else {
      set.add(effect);
    }
    const FittedSet afresh(problem, set.effects());
    EXPECT_NEAR(set.description_nats(), afresh.description_nats(), 1e-6);
    ASSERT_EQ(set.columns(), afresh.columns());
    EXPECT_LT((set.coefficients() - afresh.coefficients()).norm(), 1e-6 * (1.0 + afresh.coefficients().norm()));
    for (std::size_t place = 0; place < set.effects().size(); ++place)
      EXPECT_NEAR(set.rise_without(place), afresh.rise_without(place), 1e-6 * (1.0 + afresh.rise_without(place)));
  }
}

TEST(FittedSet, TakesAnEffectThatShortensTheDescriptionAndNoOther) {
  for (const ExplanationProblem& problem : {deceptive(5), of_several_columns(deceptive(5))}) {
    int taken = 0, refused = 0;
    for (std::size_t effect = 2; effect < problem.spans.size(); ++effect) {
      FittedSet set(problem, {0, 1}), more = set;
      more.add(effect);
      const bool shorter = more.description_nats() < set.description_nats();
      EXPECT_EQ(set.add_if_shorter(effect), shorter) << effect;
      EXPECT_EQ(set.holds(effect), shorter);
      (shorter ? taken : refused) += 1;
    }
    EXPECT_GT(taken, 0);
    EXPECT_GT(refused, 0);
  }
}

TEST(FittedSet, TellsTheMomentsOfSomeColumnsAsThoseOfAll) {
  const ExplanationProblem problem = deceptive(7);
  const FittedSet set(problem, {9, 2, 14});
  const Eigen::VectorXd all = set.moments_left(), some = set.moments_left({{1, 3}, {8, 2}});
  EXPECT_EQ(some.segment(1, 3), all.segment(1, 3));
  EXPECT_EQ(some.segment(8, 2), all.segment(8, 2));
}

TEST(FittedSet, IsShortestWithoutWhatIsOfLeastWorth) {
  const ExplanationProblem problem = deceptive(5);
  std::vector<std::size_t> effects(problem.spans.size());
  std::iota(effects.begin(), effects.end(), 0U);
  FittedSet set(problem, effects);
  ASSERT_TRUE(set.least_worth());
  while (const auto least = set.least_worth()) {
    for (std::size_t place = 0; place < set.effects().size(); ++place)
      EXPECT_LE(set.gain_without(place), set.gain_without(*least));
    EXPECT_GT(set.gain_without(*least), 0.0);
    set.remove(*least);
  }
  ASSERT_FALSE(set.effects().empty());
  for (std::size_t place = 0; place < set.effects().size(); ++place) EXPECT_LE(set.gain_without(place), 0.0);
}

TEST(FittedSet, GainsOfLeavingOutAreDifferencesOfDescriptions) {
  const ExplanationProblem problem = deceptive(5);
  const FittedSet set(problem, {1, 2, 7, 11});
  for (std::size_t place = 0; place < 4; ++place) {
    FittedSet less = set;
    less.remove(place);
    EXPECT_NEAR(set.gain_without(place), set.description_nats() - less.description_nats(), 1e-6);
  }
}

TEST(FittedSet, AlikeIsWhatAnotherEffectInThePlaceWouldGive) {
  const ExplanationProblem problem = deceptive(6);
  const FittedSet set(problem, {1, 7});
  for (const Alike& other : set.alike(0)) {
    const FittedSet exchanged(problem, {other.effect, 7});
    EXPECT_NEAR(other.nats_behind, exchanged.description_nats() - set.description_nats(), 1e-6);
    EXPECT_GE(other.cosine, 0.0);
    EXPECT_LE(other.cosine, 1.0);
  }
}

}  // namespace
}  // namespace demecal

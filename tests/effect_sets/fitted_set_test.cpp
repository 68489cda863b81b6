// A set of effects: its arithmetic is that of least squares, however it came about.
#include "effect_sets/fitted_set.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <vector>

#include "deceptive.hpp"

namespace demecal {
namespace {

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
    const Eigen::VectorXd solution = problem.gram(at, at).ldlt().solve(problem.moment(at).eval());
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

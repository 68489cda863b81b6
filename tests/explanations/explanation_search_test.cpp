// The search over sets of effects: its arithmetic is that of least squares, it is never worse than what it begins with,
// and it finds pairs that no step of adding one after another does.
#include "explanations/explanation_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace demecal {
namespace {

constexpr Eigen::Index kRows = 200;

Eigen::VectorXd drawn(RandomStream& random) {
  Eigen::VectorXd column(kRows);
  for (double& value : column) value = random.normal();
  return column.normalized();
}

/// Effects of one column each, `causes` of them one after another.
ExplanationProblem problem_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residual, std::size_t causes) {
  ExplanationProblem problem;
  problem.gram = columns.transpose() * columns;
  problem.moment = columns.transpose() * residual;
  problem.squares = residual.squaredNorm();
  problem.rows = problem.freedom = static_cast<double>(kRows);
  problem.poses = problem.rows / 3.0;
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    problem.spans.push_back({i, 1});
    problem.naming_costs_nats.push_back(2.0);
    problem.cause.push_back(static_cast<std::size_t>(i) % causes);
  }
  return problem;
}

/// Forty effects, three of which make the residual. Number 0 lies between 1 and 2, which cancel but for a little.
ExplanationProblem deceptive(std::uint64_t seed) {
  RandomStream random{seed, 1};
  Eigen::MatrixXd columns(kRows, 40);
  for (Eigen::Index i = 0; i < columns.cols(); ++i) columns.col(i) = drawn(random);
  columns.col(0) = (columns.col(1) + columns.col(2) + 0.25 * columns.col(0)).normalized();
  const Eigen::VectorXd residual =
      45.0 * columns.col(1) + 25.0 * columns.col(2) + 12.0 * columns.col(7) + 12.0 * drawn(random);
  return problem_of(columns, residual, 10);
}

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

TEST(ExplanationSearch, FindsPairsThatAddingOneByOneDoesNot) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ExplanationProblem problem = deceptive(seed);
    const std::vector<std::size_t> greedy = added_one_by_one(problem);
    const auto front = search_explanations(problem, greedy, {.variations = 500}, RandomStream{seed});
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
  const auto front = search_explanations(problem, {1, 2, 7}, {.variations = 300, .most_causes = 4, .most_effects = 6},
                                         RandomStream{1});
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
  const auto one = search_explanations(problem, {}, {.variations = 200}, RandomStream{7});
  const auto other = search_explanations(problem, {}, {.variations = 200}, RandomStream{7});
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
  ExplanationProblem problem = problem_of(columns, 14.0 * drawn(random), 30);
  for (double& cost : problem.naming_costs_nats) cost = std::log(300.0) + 2.0;
  for (const EffectSet& set : search_explanations(problem, {}, {.variations = 500}, RandomStream{1}))
    EXPECT_GE(set.description_nats, -1.0) << set.causes << " causes";
}

}  // namespace
}  // namespace demecal

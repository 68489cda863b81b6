// The simplex: it keeps its budget, never ends above where it began, and crosses jumps.
#include "fitness/constant_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(SimplexSearch, KeepsItsBudgetAndNeverEndsAboveItsBeginning) {
  RandomStream random{61};
  SimplexSearch search;
  for (int i = 0; i < 200; ++i) {
    const std::size_t unknowns = 1 + random.index(6);
    const int budget = static_cast<int>(random.index(40));
    std::vector<double> point(unknowns);
    for (double& coordinate : point) coordinate = random.real(-2.0, 2.0);
    int calls = 0;
    const auto function = [&](std::span<const double> at) {
      ++calls;
      double sum = 0.0;
      for (const double coordinate : at) sum += std::abs(std::sin(3.0 * coordinate)) + (coordinate > 0.3 ? 1.0 : 0.0);
      return calls % 7 == 0 ? NAN : sum;
    };
    const double before = function(point);
    calls = 0;
    const double after = search(function, point, before, budget);
    EXPECT_LE(calls, budget);
    EXPECT_FALSE(after > before);
  }
}

TEST(SimplexSearch, ReturnsTheValueOfItsPoint) {
  RandomStream random{62};
  SimplexSearch search;
  const auto function = [](std::span<const double> at) { return std::abs(at[0] - 0.7) + std::abs(at[1] + at[0]); };
  for (int i = 0; i < 50; ++i) {
    std::vector<double> point{random.real(-2.0, 2.0), random.real(-2.0, 2.0)};
    const double value = search(function, point, function(point), 3 + i);
    EXPECT_EQ(value, function(point));
  }
}

TEST(SimplexSearch, FindsTheFootOfAValleyAndCrossesJumps) {
  SimplexSearch search;
  const auto valley = [](std::span<const double> at) {
    return 10.0 * std::pow(at[1] - at[0] * at[0], 2) + std::pow(1.0 - at[0], 2);
  };
  std::vector<double> point{-0.5, 1.5};
  EXPECT_LT(search(valley, point, valley(point), 300), 1e-8);
  const auto cliffs = [](std::span<const double> at) {
    return std::abs(at[0] - 2.0) + std::floor(3.0 * std::abs(at[0] - 2.0));
  };
  std::vector<double> place{0.0};
  EXPECT_LT(search(cliffs, place, cliffs(place), 100), 1e-9);
}

}  // namespace
}  // namespace demecal

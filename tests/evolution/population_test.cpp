// The front of length and fitness.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "evolution/population.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// A chain of sines: any length one likes; `mark` tells trees of equal length apart.
Individual of_length(std::size_t length, double fitness, double mark = 0.0) {
  Tree tree(length - 1, {Primitive::sine, 0, 0.0});
  tree.push_back({Primitive::constant, 0, mark});
  return {tree, fitness};
}

TEST(ParetoFront, HoldsExactlyWhatNothingAsShortBeats) {
  RandomStream random{11};
  for (int trial = 0; trial < 200; ++trial) {
    Population offered;
    ParetoFront front;
    for (int i = 0; i < 60; ++i) {
      // Few values, so that equal lengths and equal fitness occur.
      const auto fitness = static_cast<double>(random.index(30));
      offered.push_back(of_length(1 + random.index(20), fitness, i));
      front.offer(offered.back());
    }
    Population expected;
    for (std::size_t length = 1; length <= 20; ++length)
      for (double fitness = 0.0; fitness < 30.0; ++fitness) {
        const auto wanted = [&](const Individual& one) { return one.tree.size() == length && one.fitness == fitness; };
        const auto found = std::find_if(offered.begin(), offered.end(), wanted);
        if (found == offered.end()) continue;
        if (expected.empty() || fitness < expected.back().fitness) expected.push_back(*found);
        break;
      }
    ASSERT_TRUE(front.members() == expected) << "trial " << trial;
  }
}

TEST(ParetoFront, KeepsOutWhatIsNotFinite) {
  ParetoFront front;
  front.offer(of_length(3, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(front.members().empty());
}

TEST(ParetoFront, NeverGrowsBeyondItsMostNorLosesItsEnds) {
  RandomStream random{12};
  ParetoFront front;
  double best = 1e9;
  for (int i = 0; i < 3000; ++i) {
    const std::size_t length = 2 + random.index(200);
    const Individual one = of_length(length, 300.0 - static_cast<double>(length) + random.real());
    best = std::min(best, one.fitness);
    front.offer(one);
    ASSERT_LE(front.members().size(), ParetoFront::kMostMembers);
    ASSERT_EQ(front.members().back().fitness, best);
  }
  EXPECT_EQ(front.members().size(), ParetoFront::kMostMembers);
  EXPECT_EQ(front.members().front().tree.size(), 2u);
}

TEST(ParetoFront, GoesOnFromItsMembers) {
  RandomStream random{13};
  ParetoFront whole, first;
  for (int i = 0; i < 400; ++i) {
    const Individual one = of_length(1 + random.index(150), 200.0 * random.real(), i);
    whole.offer(one);
    if (i == 200) first = ParetoFront(Population(first.members()));
    first.offer(one);
  }
  EXPECT_TRUE(whole.members() == std::move(first).release());
}

}  // namespace
}  // namespace demecal

// Poses that stand for many: as many as asked for, evenly out of all, and of every target that was measured in turn.
#include "data/spread_poses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace demecal {
namespace {

TEST(SpreadPoses, AreDistinctAndAsManyAsAskedFor) {
  for (std::size_t size = 0; size < 130; ++size) {
    for (std::size_t count = 0; count < 140; ++count) {
      const std::vector<std::size_t> chosen = spread_indices(size, count);
      EXPECT_EQ(chosen.size(), std::min(size, count));
      EXPECT_EQ(std::set(chosen.begin(), chosen.end()).size(), chosen.size());
      EXPECT_TRUE(std::ranges::all_of(chosen, [size](std::size_t i) { return i < size; }));
    }
  }
}

TEST(SpreadPoses, LieEvenlyOverAll) {
  for (std::size_t size = 120; size < 1000; ++size) {
    for (const std::size_t count : {60u, 100u}) {
      const std::vector<std::size_t> chosen = spread_indices(size, count);
      ASSERT_TRUE(std::ranges::is_sorted(chosen));
      std::size_t gap = std::max(chosen.front(), size - chosen.back());
      for (std::size_t i = 1; i < chosen.size(); ++i) gap = std::max(gap, chosen[i] - chosen[i - 1]);
      EXPECT_LE(gap, 2 * size / count + 1) << count << " of " << size;
    }
  }
}

TEST(SpreadPoses, HoldEveryTargetMeasuredInTurn) {
  for (std::size_t size = 120; size < 1000; ++size) {
    for (const std::size_t count : {60u, 100u}) {
      for (std::size_t targets = 2; targets <= 6; ++targets) {
        std::vector<std::size_t> times(targets);
        for (const std::size_t i : spread_indices(size, count)) ++times[i % targets];
        EXPECT_GE(*std::ranges::min_element(times), count / targets / 3)
            << targets << " in turn, " << count << " of " << size;
      }
    }
  }
}

TEST(SpreadPoses, AreThoseNamed) {
  const std::vector<std::size_t> poses{3, 5, 8, 13, 21};
  EXPECT_EQ(spread_poses(poses, 9), poses);
  const std::vector<std::size_t> two = spread_poses(poses, 2);
  ASSERT_EQ(two.size(), 2u);
  for (const std::size_t pose : two) EXPECT_NE(std::ranges::find(poses, pose), poses.end());
}

}  // namespace
}  // namespace demecal

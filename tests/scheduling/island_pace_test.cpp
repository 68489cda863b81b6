// How long an island still takes, as its reports tell.
#include "scheduling/island_pace.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

using std::chrono::milliseconds;

constexpr IslandKey kIsland{2, 1};

IslandPace::Time at(int time_ms) {
  return IslandPace::Time{} + milliseconds(time_ms);
}

TEST(IslandPace, IsUnknownBeforeAnyReportOfGenerations) {
  IslandPace pace(200);
  EXPECT_EQ(pace.left(kIsland, at(0)), IslandPace::Time::duration::max());
  pace.assigned(kIsland, 50, at(0));
  pace.reached(kIsland, 50, at(10));
  EXPECT_EQ(pace.left(kIsland, at(20)), IslandPace::Time::duration::max());
}

TEST(IslandPace, CountsFromWhereTheWorkerBeganAndFromTheLastReport) {
  IslandPace pace(200);
  pace.assigned(kIsland, 100, at(1000));
  pace.reached(kIsland, 120, at(1100));  // 5 ms a generation, 80 left
  EXPECT_EQ(pace.left(kIsland, at(1100)), milliseconds(400));
  EXPECT_EQ(pace.left(kIsland, at(1400)), milliseconds(100));
  pace.reached(kIsland, 110, at(1450));  // late news change nothing
  EXPECT_EQ(pace.left(kIsland, at(1400)), milliseconds(100));
  pace.assigned(kIsland, 120, at(1500));
  EXPECT_EQ(pace.left(kIsland, at(1500)), IslandPace::Time::duration::max());
}

}  // namespace
}  // namespace demecal

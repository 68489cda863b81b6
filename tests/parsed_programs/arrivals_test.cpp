// Where the arm may come from to each motion, along made-up ways.
#include "parsed_programs/arrivals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Program moving_at(const std::vector<std::size_t>& motions) {
  Program program;
  for (const std::size_t motion : motions) {
    program.targets.emplace_back();
    program.targets.back().order = motion;
  }
  return program;
}

TEST(Arrivals, AreFromTheMotionBeforeWhereNoWayIsTold) {
  Program program = moving_at({10, 20, 30, 40});
  program.targets[0].further_motions = {35};
  program.joints_lost_at = {30};
  program.further = {{"b", 38}};
  const auto found = arrivals(program);
  EXPECT_THAT(found.at(10), IsEmpty());
  EXPECT_THAT(found.at(20), ElementsAre(10));
  EXPECT_THAT(found.at(30), ElementsAre(20)) << "of two points of one motion, the last may be unknown";
  EXPECT_THAT(found.at(35), IsEmpty());
  EXPECT_THAT(found.at(40), IsEmpty()) << "another file";
}

TEST(Arrivals, AreFromAllWays) {
  Program program = moving_at({10, 20, 30, 40});
  program.way = {{0, {1}}, {15, {2, 3}}, {18, {1}}, {28, {}}, {38, {}}};
  const auto found = arrivals(program);
  EXPECT_THAT(found.at(20), ElementsAre(10, 20)) << "a loop of one motion";
  EXPECT_THAT(found.at(30), ElementsAre(10, 20)) << "behind it, where it may be skipped";
  EXPECT_THAT(found.at(40), IsEmpty()) << "nothing leads there";
}

TEST(Arrivals, AreUnknownWhereOneOfTheWaysIs) {
  Program program = moving_at({10, 20, 30});
  program.way = {{0, {1, 2}}, {15, {2}}, {28, {}}};
  EXPECT_THAT(arrivals(program).at(30), ElementsAre(10, 20));
  program.joints_lost_at = {22};
  EXPECT_THAT(arrivals(program).at(30), IsEmpty());
  program.joints_lost_at = {12};
  EXPECT_THAT(arrivals(program).at(20), IsEmpty());
  EXPECT_THAT(arrivals(program).at(30), IsEmpty());
}

TEST(Arrivals, OfTooManyWaysAreUnknown) {
  for (const std::size_t ways : {16u, 17u}) {
    std::vector<std::size_t> motions;
    Program program;
    for (std::size_t i = 1; i <= ways + 1; ++i) motions.push_back(10 * i);
    program = moving_at(motions);
    program.way.push_back({0, {}});
    for (std::size_t i = 1; i <= ways; ++i) {
      program.way.push_back({10 * i, {ways + 1}});
      program.way.front().next.push_back(i);
    }
    program.way.push_back({10 * (ways + 1), {}});
    EXPECT_EQ(arrivals(program).at(motions.back()).size(), ways > 16 ? 0 : ways);
  }
}

}  // namespace
}  // namespace demecal

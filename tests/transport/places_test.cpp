// Places are as many as there are values at once.
#include "transport/places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace demecal {
namespace {

Checkpoint checkpoint(RunId run, std::uint32_t deme, std::uint32_t epoch) {
  Checkpoint made;
  made.run = run;
  made.island = {0, deme};
  made.state.epoch = epoch;
  return made;
}

Migrants migrants(RunId run, std::uint32_t epoch) {
  return {run, {0, 0}, epoch, {}, "worker"};
}

TEST(Places, AreKeptByWhatReplacesAValueAndSharedByNothingElse) {
  Places places;
  std::set<std::uint32_t> seen;
  for (const RunId run : {5, 9})
    for (std::uint32_t deme = 0; deme < 4; ++deme) {
      const std::uint32_t place = places.place_of(checkpoint(run, deme, 1));
      EXPECT_TRUE(seen.insert(place).second);
      EXPECT_EQ(places.place_of(checkpoint(run, deme, 2)), place);
    }
}

TEST(Places, OfMigrantsAreKeptForAsManyEpochsAsWaitForThoseWhoComeLate) {
  Places places;
  std::set<std::uint32_t> seen;
  for (std::uint32_t epoch = 1; epoch <= kMigrantEpochs; ++epoch) seen.insert(places.place_of(migrants(1, epoch)));
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kMigrantEpochs));
  for (std::uint32_t epoch = 1; epoch <= kMigrantEpochs; ++epoch)
    EXPECT_EQ(places.place_of(migrants(1, epoch + kMigrantEpochs)), places.place_of(migrants(1, epoch)));
}

TEST(Places, AreNoMoreThanThereAreValuesAtOnceHoweverManyRunsThereWere) {
  Places places;
  std::uint32_t largest = 0;
  for (RunId run = 1; run <= 50; ++run) {
    std::set<std::uint32_t> taken;
    for (std::uint32_t deme = 0; deme < 6; ++deme) taken.insert(places.place_of(checkpoint(run, deme, 1)));
    largest = std::max(largest, *taken.rbegin());
    const auto vacated = places.vacate(run - 1);
    EXPECT_EQ(vacated.size(), run == 1 ? 0u : 6u);
    for (const std::uint32_t place : vacated) EXPECT_FALSE(taken.contains(place));
  }
  EXPECT_EQ(largest, 11u);
}

}  // namespace
}  // namespace demecal

// Migrants that wait for a task to name their sender.
#include "hosting/migrants.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

Migrants from(const std::string& worker, RunId run, IslandKey island, std::uint32_t epoch) {
  return {run, island, epoch, {}, worker};
}

TEST(UnverifiedMigrants, GivesWhatOneSenderSentOfOneIslandInOrderAndOnce) {
  UnverifiedMigrants unverified;
  std::vector<Migrants> wanted;
  for (std::uint32_t epoch = 1; epoch <= 5; ++epoch) {
    wanted.push_back(from("a", 1, {0, 1}, epoch));
    for (const Migrants& one :
         {wanted.back(), from("b", 1, {0, 1}, epoch), from("a", 2, {0, 1}, epoch), from("a", 1, {0, 2}, epoch)})
      EXPECT_TRUE(unverified.put(one));
  }
  EXPECT_EQ(unverified.take("a", 1, {0, 1}), wanted);
  EXPECT_TRUE(unverified.take("a", 1, {0, 1}).empty());
  EXPECT_EQ(unverified.take("a", 1, {0, 2}).size(), 5U);
}

TEST(UnverifiedMigrants, AFloodPushesOutItsOwn) {
  UnverifiedMigrants unverified;
  unverified.put(from("honest", 1, {0, 0}, 1));
  std::size_t dropped = 0;
  for (std::uint32_t i = 0; i < 3 * UnverifiedMigrants::kMostOfOne; ++i)
    dropped += unverified.put(from("flood", 1, {0, 0}, i)) ? 0 : 1;
  EXPECT_EQ(dropped, 2 * UnverifiedMigrants::kMostOfOne);
  EXPECT_EQ(unverified.take("honest", 1, {0, 0}).size(), 1U);
}

TEST(UnverifiedMigrants, IsBoundedInSenders) {
  UnverifiedMigrants unverified;
  for (std::size_t i = 0; i < UnverifiedMigrants::kMostSenders; ++i)
    EXPECT_TRUE(unverified.put(from(std::to_string(i), 1, {0, 0}, 1)));
  EXPECT_FALSE(unverified.put(from("one more", 1, {0, 0}, 1)));
}

TEST(UnverifiedMigrants, ForgetsARunAndSaysWhoseItForgot) {
  UnverifiedMigrants unverified;
  for (const RunId run : {1, 1, 2}) unverified.put(from("a", run, {0, 0}, 1));
  unverified.put(from("b", 1, {0, 0}, 1));
  EXPECT_EQ(unverified.forget(1), (std::map<std::string, std::size_t>{{"a", 2}, {"b", 1}}));
  EXPECT_EQ(unverified.take("a", 2, {0, 0}).size(), 1U);
}

}  // namespace
}  // namespace demecal

// Migrants that wait for a task to name their sender.
#include "worker/unproven.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

Migrants from(const std::string& worker, RunId run, IslandKey island, std::uint32_t epoch) {
  return {run, island, epoch, {}, worker};
}

TEST(Unproven, GivesWhatOneSenderSentOfOneIslandInOrderAndOnce) {
  Unproven unproven;
  std::vector<Migrants> wanted;
  for (std::uint32_t epoch = 1; epoch <= 5; ++epoch) {
    wanted.push_back(from("a", 1, {0, 1}, epoch));
    for (const Migrants& one :
         {wanted.back(), from("b", 1, {0, 1}, epoch), from("a", 2, {0, 1}, epoch), from("a", 1, {0, 2}, epoch)})
      EXPECT_TRUE(unproven.put(one));
  }
  EXPECT_EQ(unproven.take("a", 1, {0, 1}), wanted);
  EXPECT_TRUE(unproven.take("a", 1, {0, 1}).empty());
  EXPECT_EQ(unproven.take("a", 1, {0, 2}).size(), 5U);
}

TEST(Unproven, AFloodPushesOutItsOwn) {
  Unproven unproven;
  unproven.put(from("honest", 1, {0, 0}, 1));
  std::size_t dropped = 0;
  for (std::uint32_t i = 0; i < 3 * Unproven::kMostOfOne; ++i)
    dropped += unproven.put(from("flood", 1, {0, 0}, i)) ? 0 : 1;
  EXPECT_EQ(dropped, 2 * Unproven::kMostOfOne);
  EXPECT_EQ(unproven.take("honest", 1, {0, 0}).size(), 1U);
}

TEST(Unproven, IsBoundedInSenders) {
  Unproven unproven;
  for (std::size_t i = 0; i < Unproven::kMostSenders; ++i)
    EXPECT_TRUE(unproven.put(from(std::to_string(i), 1, {0, 0}, 1)));
  EXPECT_FALSE(unproven.put(from("one more", 1, {0, 0}, 1)));
}

TEST(Unproven, ForgetsARunAndSaysWhoseItForgot) {
  Unproven unproven;
  for (const RunId run : {1, 1, 2}) unproven.put(from("a", run, {0, 0}, 1));
  unproven.put(from("b", 1, {0, 0}, 1));
  EXPECT_EQ(unproven.forget(1), (std::map<std::string, std::size_t>{{"a", 2}, {"b", 1}}));
  EXPECT_EQ(unproven.take("a", 2, {0, 0}).size(), 1U);
}

}  // namespace
}  // namespace demecal

// Messages of a flood, of others, and of nobody.
#include "transport/mailbox.hpp"

#include <gtest/gtest.h>

#include "protocol/message_bytes.hpp"
#include "protocol/messages.hpp"

namespace demecal {
namespace {

constexpr ParticipantId kFlood{1}, kHonest{2};
constexpr std::chrono::milliseconds kAtOnce{0};

Progress progress(std::uint32_t deme, std::uint32_t epoch) {
  Progress made;
  made.run = 1;
  made.island.deme = deme;
  made.epoch = epoch;
  return made;
}

TEST(Mailbox, GivesEachSourceItsTurnAndKeepsItsOrder) {
  Mailbox mailbox;
  for (std::uint32_t epoch = 0; epoch < 100; ++epoch) mailbox.put(kFlood, progress(0, epoch));
  for (std::uint32_t epoch = 0; epoch < 3; ++epoch) mailbox.put(kHonest, progress(1, epoch));
  std::vector<std::uint32_t> honest, flood;
  for (int i = 0; i < 6; ++i) {
    const auto one = std::get<Progress>(*mailbox.take(kAtOnce));
    (one.island.deme == 1 ? honest : flood).push_back(one.epoch);
  }
  EXPECT_EQ(honest, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(flood, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Mailbox, KeepsTheLastValueOfEveryKeyWhereASourceSendsMoreThanIsKept) {
  Mailbox mailbox(64);
  for (std::uint32_t epoch = 0; epoch < 1000; ++epoch)
    for (std::uint32_t deme = 0; deme < 20; ++deme) EXPECT_TRUE(mailbox.put(kHonest, progress(deme, epoch)));
  std::map<std::uint32_t, std::uint32_t> last;
  std::size_t count = 0;
  for (; auto message = mailbox.take(kAtOnce); ++count) {
    const auto& one = std::get<Progress>(*message);
    EXPECT_TRUE(!last.contains(one.island.deme) || last[one.island.deme] < one.epoch);
    last[one.island.deme] = one.epoch;
  }
  EXPECT_LE(count, 64U);
  ASSERT_EQ(last.size(), 20U);
  for (const auto& [deme, epoch] : last) EXPECT_EQ(epoch, 999U);
}

TEST(Mailbox, RefusesWhatHasNoEndAndTakesWhatOthersSend) {
  Mailbox mailbox(64);
  std::size_t refused = 0;
  for (std::uint32_t deme = 0; deme < 1000; ++deme) refused += mailbox.put(kFlood, progress(deme, 1)) ? 0 : 1;
  EXPECT_EQ(refused, 1000U - 64U);
  EXPECT_TRUE(mailbox.put(kHonest, progress(0, 1)));
}

TEST(Mailbox, IsBoundedInBytesToo) {
  Mailbox mailbox(1000, 100'000);
  Checkpoint large;
  large.run = 1;
  large.state.population.assign(100, {variable_tree(0), 0.5});
  std::size_t taken = 0;
  for (large.island.deme = 0; large.island.deme < 100; ++large.island.deme) taken += mailbox.put(kFlood, large) ? 1 : 0;
  EXPECT_GT(taken, 1U);
  EXPECT_LE(taken * weight_bytes(large), 100'000 + weight_bytes(large));
}

TEST(Mailbox, RefusesNothingMoreOnceItIsEmptied) {
  Mailbox mailbox(8);
  for (int round = 0; round < 5; ++round) {
    for (std::uint32_t deme = 0; deme < 8; ++deme) EXPECT_TRUE(mailbox.put(kFlood, progress(deme, 1)));
    EXPECT_FALSE(mailbox.put(kFlood, progress(8, 1)));
    while (mailbox.take(kAtOnce)) {
    }
  }
}

}  // namespace
}  // namespace demecal

// What is kept as bytes comes back to the bit, and bytes that are no message are told.
#include "transport/message_bytes.hpp"

#include <gtest/gtest.h>

#include "random_messages.hpp"

namespace demecal {
namespace {

constexpr int kRounds = 50;

template <class Plain>
void expect_round_trips(Plain (RandomMessages::*make)()) {
  RandomMessages random(23);
  for (int i = 0; i < kRounds; ++i) {
    const Plain message = (random.*make)();
    const std::string bytes = to_bytes(message);
    EXPECT_EQ(message_of<Plain>(bytes), message);
    EXPECT_EQ(to_bytes(message), bytes);
    EXPECT_FALSE(message_of<Plain>(std::string_view(bytes).substr(0, bytes.size() - 1)).has_value());
    EXPECT_FALSE(message_of<Plain>(bytes + "more").has_value());
  }
}

TEST(MessageBytes, OfWhatAJournalKeepsRoundTrip) {
  expect_round_trips(&RandomMessages::data);
  expect_round_trips(&RandomMessages::progress);
  expect_round_trips(&RandomMessages::checkpoint);
  expect_round_trips(&RandomMessages::outcome);
}

TEST(MessageBytes, AreTheSameOnEveryMachine) {
  Progress progress;
  progress.run = 0x0102030405060708;
  EXPECT_EQ(to_bytes(progress).substr(0, 8), "\x08\x07\x06\x05\x04\x03\x02\x01");
}

}  // namespace
}  // namespace demecal

// The faulty transport has the faults it is asked for, and no others.
#include "faulty_transport.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "transport/transport.hpp"

namespace demecal {
namespace {

constexpr std::uint32_t kMessages = 200;

struct Received {
  std::vector<std::uint32_t> progress_epochs;
  std::map<std::uint32_t, int> times_of_outcome;
};

/// What a coordinator receives of as many Progress and Outcome messages.
Received receive_with(Faults faults) {
  const auto exchange = make_exchange();
  FaultyTransport coordinator(join(exchange, Role::coordinator, "coordinator"), std::move(faults), 3);
  const auto worker = join(exchange, Role::worker, "worker");
  for (std::uint32_t i = 0; i < kMessages; ++i) {
    Progress progress;
    progress.epoch = i;
    worker->publish(progress);
    Outcome outcome;
    outcome.generations = i;
    worker->publish(outcome);
  }
  Received received;
  while (const auto message = coordinator.receive(std::chrono::milliseconds{0})) {
    if (const auto* progress = std::get_if<Progress>(&*message)) received.progress_epochs.push_back(progress->epoch);
    if (const auto* outcome = std::get_if<Outcome>(&*message)) ++received.times_of_outcome[outcome->generations];
  }
  return received;
}

TEST(FaultyTransport, WithoutFaultsIsSound) {
  const Received received = receive_with({});
  EXPECT_EQ(received.progress_epochs.size(), kMessages);
  EXPECT_TRUE(std::is_sorted(received.progress_epochs.begin(), received.progress_epochs.end()));
  EXPECT_EQ(received.times_of_outcome.size(), kMessages);
}

TEST(FaultyTransport, DropsOnlyWhatMayBeDropped) {
  const Received received = receive_with({.drop = 0.5});
  EXPECT_LT(received.progress_epochs.size(), kMessages);
  EXPECT_EQ(received.times_of_outcome.size(), kMessages);
}

TEST(FaultyTransport, DuplicatesWithoutLoss) {
  const Received received = receive_with({.duplicate = 0.5});
  EXPECT_EQ(received.times_of_outcome.size(), kMessages);
  EXPECT_TRUE(std::any_of(received.times_of_outcome.begin(), received.times_of_outcome.end(),
                          [](const auto& outcome) { return outcome.second > 1; }));
}

TEST(FaultyTransport, DelaysWithoutLoss) {
  const Received received = receive_with({.delay = 0.5});
  EXPECT_EQ(received.progress_epochs.size(), kMessages);
  EXPECT_FALSE(std::is_sorted(received.progress_epochs.begin(), received.progress_epochs.end()));
}

}  // namespace
}  // namespace demecal

// Workers' coming and going, told from their writers.
#include "transport/presence.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

constexpr WriterId kOne{1};
constexpr WriterId kTwo{2};

WorkerStatus status(const std::string& worker, bool leaving = false) {
  WorkerStatus result;
  result.worker = worker;
  result.leaving = leaving;
  return result;
}

class Presences : public ::testing::Test {
 protected:
  /// All that has been put until now.
  std::vector<Message> arrived() {
    std::vector<Message> all;
    while (auto message = mailbox.take(std::chrono::milliseconds{0})) all.push_back(*message);
    return all;
  }
  using Messages = std::vector<Message>;

  Mailbox mailbox;
  Presence presence{mailbox};
};

TEST_F(Presences, SilenceLosesTheWorkerOnce) {
  presence.heard(kOne, status("one"));
  presence.heard(kTwo, status("two"));
  presence.fell_silent(kOne);
  presence.fell_silent(kOne);
  presence.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), status("two"), WorkerLost{"one"}}));
}

TEST_F(Presences, DepartureWithoutSilenceLosesTheWorkerToo) {
  presence.heard(kOne, status("one"));
  presence.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), WorkerLost{"one"}}));
}

TEST_F(Presences, AWorkerThatLeavesIsNotLost) {
  presence.heard(kOne, status("one"));
  presence.heard(kOne, status("one", true));
  presence.fell_silent(kOne);
  presence.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), status("one", true)}));
}

TEST_F(Presences, ALostWorkerThatSpeaksAgainIsAnnouncedAgain) {
  presence.heard(kOne, status("one"));
  presence.spoke_again(kOne);
  presence.fell_silent(kOne);
  presence.spoke_again(kOne);
  presence.fell_silent(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), WorkerLost{"one"}, status("one"), WorkerLost{"one"}}));
}

TEST_F(Presences, ARepeatedStatusIsNewsOnlyOfALostWorker) {
  presence.heard(kOne, status("one"));
  presence.heard(kOne, status("one"));
  presence.fell_silent(kOne);
  presence.heard(kOne, status("one"));
  presence.heard(kOne, status("one"));
  presence.fell_silent(kOne);
  EXPECT_EQ(arrived(), (Messages{status("one"), WorkerLost{"one"}, status("one"), WorkerLost{"one"}}));
}

TEST_F(Presences, NewsOfACalibrationComeFromOneWriterWhileItIsThere) {
  Heralds heralds(mailbox);
  LoopNews news;
  news.calibration = 3;
  EXPECT_TRUE(heralds.heard(kOne, news));
  EXPECT_FALSE(heralds.heard(kTwo, news));
  heralds.departed(kTwo);
  heralds.departed(kOne);
  EXPECT_EQ(arrived(), (Messages{news, CalibrationLost{3}}));
  EXPECT_TRUE(heralds.heard(kTwo, news));
  EXPECT_EQ(arrived(), Messages{news});
}

TEST_F(Presences, WritersThatSaidNothingAreNobody) {
  presence.fell_silent(kOne);
  presence.spoke_again(kOne);
  presence.departed(kOne);
  EXPECT_TRUE(arrived().empty());
}

}  // namespace
}  // namespace demecal

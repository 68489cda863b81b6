// Names stand for participants.
#include "transport/participant_of.hpp"

#include <gtest/gtest.h>

#include <set>

namespace demecal {
namespace {

TEST(ParticipantOf, DiffersForNamesThatDifferLittle) {
  std::set<ParticipantId> seen;
  for (int process = 0; process < 300; ++process)
    for (const std::string host : {"a", "b", "host-1"})
      seen.insert(participant_of(host + "-" + std::to_string(process)));
  EXPECT_EQ(seen.size(), 900U);
}

TEST(RunOf, ShowsItsPublisherAndNoOther) {
  const ParticipantId one = participant_of("one"), two = participant_of("two");
  for (const std::uint16_t serial : {0, 1, 65535}) {
    const std::uint64_t run = run_of(one, serial);
    EXPECT_TRUE(shows_publisher(run));
    EXPECT_TRUE(may_publish(one, run));
    EXPECT_FALSE(may_publish(two, run));
  }
  EXPECT_NE(run_of(one, 1), run_of(one, 2));
  EXPECT_TRUE(may_publish(two, 5));
  EXPECT_FALSE(shows_publisher(5));
}

TEST(RunOf, TellsWhetherRunsHaveOnePublisher) {
  const ParticipantId one = participant_of("one"), two = participant_of("two");
  for (const std::uint16_t serial : {0, 1, 65535}) {
    EXPECT_TRUE(have_one_publisher(run_of(one, serial), run_of(one, 7)));
    EXPECT_FALSE(have_one_publisher(run_of(one, serial), run_of(two, serial)));
  }
  EXPECT_TRUE(have_one_publisher(5, 5));
  EXPECT_FALSE(have_one_publisher(5, 6));
  EXPECT_FALSE(have_one_publisher(run_of(one, 7), 7));
}

TEST(ParticipantOf, IsTheSameOnEveryHost) {
  EXPECT_EQ(text_of(participant_of("worker")), text_of(participant_of(std::string("wor") + "ker")));
  EXPECT_EQ(text_of(participant_of("worker")).substr(0, 6), "01.0f.");
  EXPECT_EQ(text_of(participant_of("worker")).size(), 35U);
}

}  // namespace
}  // namespace demecal

// Who may say what, and which values belong together.
#include "protocol/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_messages.hpp"

namespace demecal {
namespace {

constexpr Role kRoles[]{Role::coordinator, Role::worker, Role::reporter, Role::watcher};

TEST(Topics, EveryTopicIsWrittenByOneRoleAndReadByAnother) {
  for (const Topic topic : kTopics) {
    if (topic == Topic::progress) continue;
    EXPECT_EQ(std::ranges::count_if(kRoles, [&](Role role) { return writes(role, topic); }), 1);
    EXPECT_TRUE(std::ranges::any_of(kRoles, [&](Role role) { return reads(role, topic); }));
  }
}

TEST(Topics, ProgressIsWrittenByReportersToo) {
  EXPECT_TRUE(writes(Role::worker, Topic::progress));
  EXPECT_TRUE(writes(Role::reporter, Topic::progress));
}

TEST(Topics, ReportersReadNothingAndWatchersWriteNothing) {
  for (const Topic topic : kTopics) {
    EXPECT_FALSE(reads(Role::reporter, topic));
    EXPECT_FALSE(writes(Role::watcher, topic));
  }
}

TEST(Topics, NobodyWaitsForAWatcher) {
  for (const Topic topic : kTopics) {
    const bool acknowledges = reads(Role::watcher, topic) && reads_reliably(Role::watcher, topic);
    EXPECT_FALSE(acknowledges && is_awaited(topic));
    for (const Role role : {Role::coordinator, Role::worker}) EXPECT_TRUE(reads_reliably(role, topic));
  }
  EXPECT_FALSE(reads(Role::watcher, Topic::checkpoint));
}

TEST(Topics, OnlyMigrantsAreReadByTheRoleThatWritesThem) {
  for (const Topic topic : kTopics)
    for (const Role role : {Role::coordinator, Role::worker})
      EXPECT_EQ(writes(role, topic) && reads(role, topic), topic == Topic::migrants && role == Role::worker);
  EXPECT_FALSE(reads(Role::coordinator, Topic::migrants));
}

TEST(Topics, OnlyAControlThatIsNotRunningEndsItsRun) {
  EXPECT_EQ(ended_run(Control{4, Control::State::finished, ""}), 4u);
  EXPECT_EQ(ended_run(Control{4, Control::State::cancelled, ""}), 4u);
  EXPECT_EQ(ended_run(Control{4, Control::State::running, ""}), 0u);
  EXPECT_EQ(ended_run(RandomMessages(1).outcome()), 0u);
}

TEST(TopicsDeathTest, WatchersCannotPublish) {
  EXPECT_DEATH(check_may_publish(Role::watcher, "eye", key_of(Control{})), "check failed");
}

TEST(TopicsDeathTest, WorkersCannotPublishForOthers) {
  WorkerStatus status;
  status.worker = "two";
  check_may_publish(Role::worker, "two", key_of(status));
  EXPECT_DEATH(check_may_publish(Role::worker, "one", key_of(status)), "'one' publishes as 'two'");
}

TEST(TopicsDeathTest, LossesAreNotPublished) {
  EXPECT_DEATH(key_of(WorkerLost{"one"}), "never sent");
  EXPECT_DEATH(key_of(CalibrationLost{1}), "never sent");
}

}  // namespace
}  // namespace demecal

// Jobs of users: names, states, order and limits, whatever is asked in whatever order.
#include "serving/job_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;

const JobId kFirst{"ann", "first"}, kSecond{"ann", "second"}, kOther{"bob", "first"};

/// What kind of refusal `deed` meets; nothing where it is done.
template <typename Deed>
std::optional<Refusal::Kind> refused(const Deed& deed) {
  try {
    deed();
    return std::nullopt;
  } catch (const Refusal& refusal) {
    return refusal.kind();
  }
}

TEST(PlainName, IsNoPathNoHiddenFileAndNoOption) {
  for (const char* const name : {"a", "7", "JOB.yaml", "arm-3_march.v2", "a..b", "x."})
    EXPECT_TRUE(is_plain_name(name)) << name;
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("../x"), std::string("a/b"),
        std::string("/etc/passwd"), std::string(".hidden"), std::string("-rf"), std::string("a b"), std::string("a\\b"),
        std::string("a\0b", 3), std::string("a\nb"), std::string("\xc3\xa4"), std::string("a%2fb"), std::string("~"),
        std::string(65, 'a')}) {
    EXPECT_FALSE(is_plain_name(name)) << name;
  }
  EXPECT_TRUE(is_plain_name(std::string(64, 'a')));
}

TEST(JobQueue, RunsOneAtATimeInTheOrderOfAsking) {
  JobQueue queue({});
  for (const JobId& id : {kFirst, kSecond, kOther}) queue.add(id);
  EXPECT_EQ(queue.begin_next(1), std::nullopt);
  for (const JobId& id : {kSecond, kOther, kFirst}) queue.ask_to_run(id);
  EXPECT_EQ(queue.begin_next(10), kSecond);
  EXPECT_EQ(queue.begin_next(11), std::nullopt);
  EXPECT_EQ(queue.before(kOther), 1U);
  EXPECT_EQ(queue.before(kFirst), 2U);
  EXPECT_EQ(queue.before(kSecond), 0U);
  queue.end(0, 20);
  EXPECT_EQ(queue.record(kSecond).state, JobState::done);
  EXPECT_EQ(queue.record(kSecond).began_s, 10);
  EXPECT_EQ(queue.record(kSecond).ended_s, 20);
  EXPECT_EQ(queue.begin_next(21), kOther);
  queue.end(130, 22);
  EXPECT_EQ(queue.record(kOther).state, JobState::interrupted);
  EXPECT_EQ(queue.begin_next(23), kFirst);
  queue.end(12, 24);
  EXPECT_EQ(queue.record(kFirst).state, JobState::failed);
  EXPECT_EQ(queue.record(kFirst).exit_code, 12);
}

TEST(JobQueue, SaysWhatAJobsStateForbids) {
  JobQueue queue({});
  queue.add(kFirst);
  EXPECT_EQ(refused([&] { queue.add(kFirst); }), Refusal::Kind::conflict);
  EXPECT_EQ(refused([&] { queue.add({"ann", ".."}); }), Refusal::Kind::invalid);
  EXPECT_EQ(refused([&] { queue.ask_to_stop(kFirst); }), Refusal::Kind::conflict);
  EXPECT_EQ(refused([&] { queue.ask_to_run(kOther); }), Refusal::Kind::unknown);  // it is bob's, and there is none
  queue.ask_to_run(kFirst);
  for (int run = 0; run < 2; ++run) {  // waiting, then running
    EXPECT_EQ(refused([&] { queue.ask_to_run(kFirst); }), Refusal::Kind::conflict);
    EXPECT_EQ(refused([&] { queue.change_files(kFirst); }), Refusal::Kind::conflict);
    EXPECT_EQ(refused([&] { queue.remove(kFirst); }), Refusal::Kind::conflict);
    queue.begin_next(1);
  }
  EXPECT_TRUE(queue.ask_to_stop(kFirst));
  queue.end(130, 2);
  queue.ask_to_run(kFirst);
  EXPECT_FALSE(queue.ask_to_stop(kFirst));
  EXPECT_EQ(queue.begin_next(3), std::nullopt);
  queue.remove(kFirst);
  EXPECT_EQ(refused([&] { queue.record(kFirst); }), Refusal::Kind::unknown);
}

TEST(JobQueue, KeepsLimitsOfEachUserAndOfAll) {
  JobQueue queue({.jobs_each = 3, .waiting = 3, .waiting_each = 2});
  for (const char* const user : {"ann", "bob"}) {
    for (const char* const job : {"a", "b", "c"}) queue.add({user, job});
    EXPECT_EQ(refused([&] { queue.add({user, "d"}); }), Refusal::Kind::limit);
  }
  queue.ask_to_run({"ann", "a"});
  queue.ask_to_run({"ann", "b"});
  EXPECT_EQ(refused([&] { queue.ask_to_run({"ann", "c"}); }), Refusal::Kind::limit);
  EXPECT_EQ(queue.record({"ann", "c"}).state, JobState::ready);
  queue.ask_to_run({"bob", "a"});
  EXPECT_EQ(refused([&] { queue.ask_to_run({"bob", "b"}); }), Refusal::Kind::limit);
  queue.begin_next(1);
  queue.ask_to_run({"bob", "b"});
  queue.remove({"ann", "c"});
  queue.add({"ann", "d"});
  EXPECT_THAT(queue.jobs_of("ann"), ElementsAre("a", "b", "d"));
  EXPECT_THAT(queue.jobs_of("an"), ElementsAre());
}

TEST(JobQueue, IsConsistentWhateverIsAsked) {
  RandomStream random{7};
  JobQueue queue({.jobs_each = 4, .waiting = 5, .waiting_each = 3});
  std::optional<JobId> running;
  for (int i = 0; i < 20000; ++i) {
    const JobId id{"user" + std::to_string(random.index(3)), "job" + std::to_string(random.index(6))};
    switch (random.index(7)) {
      case 0:
        refused([&] { queue.add(id); });
        break;
      case 1:
        refused([&] { queue.remove(id); });
        break;
      case 2:
        refused([&] { queue.change_files(id); });
        break;
      case 3:
        refused([&] { queue.ask_to_run(id); });
        break;
      case 4:
        refused([&] { queue.ask_to_stop(id); });
        break;
      case 5:
        if (const auto begun = queue.begin_next(i)) {
          ASSERT_FALSE(running.has_value());
          running = begun;
        }
        break;
      default:
        if (running) queue.end(0, i);
        running.reset();
    }
    ASSERT_EQ(queue.running(), running);
    std::size_t waiting = 0, runs = 0;
    std::set<std::size_t> places;
    for (const char* const user : {"user0", "user1", "user2"}) {
      std::size_t theirs = 0;
      const std::vector<std::string> jobs = queue.jobs_of(user);
      ASSERT_LE(jobs.size(), 4U);
      for (const std::string& job : jobs) {
        const JobState state = queue.record({user, job}).state;
        runs += state == JobState::running ? 1 : 0;
        if (state != JobState::waiting) continue;
        ++theirs;
        ASSERT_TRUE(places.insert(queue.before({user, job})).second);
      }
      ASSERT_LE(theirs, 3U);
      waiting += theirs;
    }
    ASSERT_LE(waiting, 5U);
    ASSERT_EQ(runs, running ? 1U : 0U);
    if (waiting > 0) {
      ASSERT_EQ(*places.rbegin() - *places.begin() + 1, waiting);
    }
  }
}

TEST(JobRecord, ComesBackFromItsText) {
  RandomStream random{11};
  for (const JobState state : {JobState::ready, JobState::waiting, JobState::running, JobState::done, JobState::failed,
                               JobState::interrupted}) {
    const JobRecord record{state, static_cast<int>(random.index(256)),
                           static_cast<std::int64_t>(random.index(2000000000)),
                           static_cast<std::int64_t>(random.index(2000000000))};
    const JobRecord read = parse_record(record_text(record));
    const bool was_broken_off = state == JobState::waiting || state == JobState::running;
    EXPECT_EQ(read.state, was_broken_off ? JobState::interrupted : state);
    EXPECT_EQ(read.exit_code, record.exit_code);
    EXPECT_EQ(read.began_s, record.began_s);
    EXPECT_EQ(read.ended_s, record.ended_s);
  }
  for (const char* const text : {"", "{", "[]", "7", "{\"state\": 3}", "{\"state\": \"gone\"}", "{\"began_s\": \"x\"}"})
    EXPECT_EQ(parse_record(text).state, JobState::ready) << text;
}

}  // namespace
}  // namespace demecal

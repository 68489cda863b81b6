// Whatever befalls the processes of a calibration, its model is the same to the byte.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "disturbed_job.hpp"

namespace demecal {
namespace {

/// What came of one schedule.
struct Tried {
  Ended ended;
  std::string model;
  Disturbances happened;
};

/// All schedules, a few at a time, since what is disturbed mostly waits until that is noticed.
std::vector<Tried> try_schedules(const SmallJob& job, std::uint64_t count) {
  constexpr int kAtOnce = 4;
  std::vector<Tried> tried(count);
  std::atomic<std::uint64_t> next{0};
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < kAtOnce; ++thread) {
    threads.emplace_back([&, thread] {
      for (std::uint64_t seed = next++; seed < count; seed = next++) {
        const std::string out = "out" + std::to_string(seed);
        DisturbedJob disturbed(job, out, private_domain(1 + thread), seed);
        tried[seed] = {disturbed.run(), job.text(out + "/model.yaml"), disturbed.happened()};
      }
    });
  }
  threads.clear();
  return tried;
}

TEST(Faults, OfThirtyTwoSchedulesLeaveTheSameModel) {
  constexpr std::uint64_t kSchedules = 32;
  const SmallJob job(400);
  ASSERT_EQ(run("demecal", {"calibrate", job.job(), "--out", job.path("calm"), "--workers", "2", "--domain",
                            private_domain(), "--max-effects", "0"})
                .code,
            0);
  const std::string model = job.text("calm/model.yaml");
  ASSERT_FALSE(model.empty());
  Disturbances all;
  const std::vector<Tried> tried = try_schedules(job, kSchedules);
  for (std::uint64_t seed = 0; seed < kSchedules; ++seed) {
    EXPECT_EQ(tried[seed].ended.code, 0) << "schedule " << seed << ": " << tried[seed].ended.err;
    EXPECT_EQ(tried[seed].model, model) << "schedule " << seed;
    EXPECT_EQ(tried[seed].happened.crashed, 0) << "schedule " << seed;
    all += tried[seed].happened;
  }
  for (const int count : {all.killed, all.stopped, all.continued, all.left, all.joined, all.resumed}) {
    EXPECT_GT(count, 10);
  }
  RecordProperty("killed", all.killed);
  RecordProperty("stopped", all.stopped);
  RecordProperty("continued", all.continued);
  RecordProperty("joined", all.joined);
  RecordProperty("resumed", all.resumed);
}

}  // namespace
}  // namespace demecal

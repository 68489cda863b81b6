// What a worker publishes first: migrants that others wait for, then reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <thread>

#include "hosting/worker.hpp"
#include "scheduling/in_memory_run.hpp"

namespace demecal {
namespace {

/// Hands over what is to be received, and keeps what is published; an empty entry stands for each look for messages.
class ScriptedTransport final : public Transport {
 public:
  explicit ScriptedTransport(std::function<void(ScriptedTransport&, const Message&)> on_publish)
      : on_publish_(std::move(on_publish)) {}

  void publish(const Message& message) override {
    log.emplace_back(message);
    on_publish_(*this, message);
  }
  std::optional<Message> receive(std::chrono::milliseconds) override {
    if (to_receive.empty()) {
      log.emplace_back();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return std::nullopt;
    }
    Message next = to_receive.front();
    to_receive.pop_front();
    return next;
  }
  void wake() override {}
  void follow_migrants(std::uint32_t) override {}
  void offer_migrants(std::uint32_t) override {}
  void assert_alive() override {}
  bool flush(std::chrono::milliseconds) override { return true; }
  RunId new_run() override { return 1; }

  std::deque<Message> to_receive;
  std::vector<std::optional<Message>> log;

 private:
  std::function<void(ScriptedTransport&, const Message&)> on_publish_;
};

template <class Plain>
auto first_of(const std::vector<std::optional<Message>>& log) {
  return std::ranges::find_if(log, [](const auto& entry) { return entry && std::holds_alternative<Plain>(*entry); });
}

/// A worker with one island whose neighbours are with another worker, until `until` is published.
std::vector<std::optional<Message>> log_of_lone_island(const std::function<bool(const Message&)>& until,
                                                       bool neighbours_answer) {
  const CalibrationData data = small_run(17, Topology::ring, false);
  const IslandKey own = islands(data.archipelago).front();
  std::atomic<bool> stop{false};
  ScriptedTransport transport([&](ScriptedTransport& to, const Message& message) {
    if (until(message)) stop = true;
    const auto* migrants = std::get_if<Migrants>(&message);
    if (migrants == nullptr || !neighbours_answer) return;
    for (const IslandKey& source : sources(data.archipelago, own))
      to.to_receive.emplace_back(Migrants{data.run, source, migrants->epoch, migrants->individuals, "other"});
  });
  transport.to_receive.emplace_back(data);
  for (const IslandKey& island : islands(data.archipelago))
    transport.to_receive.emplace_back(IslandTask{.run = data.run,
                                                 .island = island,
                                                 .attempt = 1,
                                                 .worker = island == own ? "worker" : "other",
                                                 .start = {},
                                                 .recent = {}});
  WorkerOptions options;
  options.name = "worker";
  options.progress_interval = options.checkpoint_interval = std::chrono::milliseconds(0);
  Worker(transport, options).serve(stop);
  return transport.log;
}

TEST(Reports, WaitWhileAnIslandWaitsForMigrants) {
  const auto is_progress = [](const Message& message) { return std::holds_alternative<Progress>(message); };
  const auto log = log_of_lone_island(is_progress, false);
  const auto migrants = first_of<Migrants>(log), progress = first_of<Progress>(log);
  ASSERT_LT(migrants, progress);
  ASSERT_NE(progress, log.end());
  EXPECT_GT(std::count(migrants, progress, std::nullopt), 1);  // in the end they are published all the same
}

TEST(Reports, ArePublishedOnceTheIslandGoesOn) {
  const auto is_second = [](const Message& message) {
    const auto* migrants = std::get_if<Migrants>(&message);
    return migrants != nullptr && migrants->epoch == 2;
  };
  const auto log = log_of_lone_island(is_second, true);
  const auto first = first_of<Migrants>(log), progress = first_of<Progress>(log),
             checkpoint = first_of<Checkpoint>(log);
  ASSERT_NE(progress, log.end());
  ASSERT_NE(checkpoint, log.end());
  EXPECT_LT(first, progress);
  const auto last = std::ranges::find_if(log, [&](const auto& entry) { return entry && is_second(*entry); });
  EXPECT_LT(progress, last);
  EXPECT_LT(checkpoint, last);
}

TEST(Reports, AreAllPublishedBeforeTheWorkerLeaves) {
  const auto is_first = [](const Message& message) { return std::holds_alternative<Migrants>(message); };
  const auto log = log_of_lone_island(is_first, false);
  const auto leaving = std::ranges::find_if(log, [](const auto& entry) {
    const auto* status = entry ? std::get_if<WorkerStatus>(&*entry) : nullptr;
    return status != nullptr && status->leaving;
  });
  ASSERT_NE(leaving, log.end());
  EXPECT_LT(first_of<Progress>(log), leaving);
  EXPECT_LT(first_of<Checkpoint>(log), leaving);
}

}  // namespace
}  // namespace demecal

// The evolutions of a calibration come to their end whatever becomes of their runs, and are not run twice.
#include "scheduling/island_evolver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../config/temporary_folder.hpp"
#include "faulty_transport.hpp"
#include "forwarding_transport.hpp"
#include "in_memory_pool.hpp"
#include "scheduling/worker_pool.hpp"

namespace demecal {
namespace {

Job small_job() {
  Job job;
  job.seed = 8;
  job.gp.population_size = 20;
  job.gp.number_generations = 1500;
  job.islands = {.per_joint = 3, .topology = Topology::ring, .migration_interval = 1, .migrants = 2};
  return job;
}

bool same_candidates(const std::vector<JointCandidates>& a, const std::vector<JointCandidates>& b) {
  return std::ranges::equal(a, b,
                            [](const JointCandidates& x, const JointCandidates& y) { return x.front == y.front; });
}

/// How often a pool was asked for, and who made it.
struct Pools {
  int made = 0;
  MakeWorkerPool sound = [this]() -> std::unique_ptr<WorkerPool> {
    ++made;
    return std::make_unique<InMemoryWorkerPool>(2);
  };
};

std::vector<JointCandidates> evolve(const EvolverOptions& options, const MakeWorkerPool& make_pool) {
  const std::atomic<bool> interrupt{false};
  const Job job = small_job();
  IslandEvolver evolutions(job, make_pool, interrupt, options);
  auto candidates = evolutions.evolve(small_training(), {job.seed, job.gp.number_generations}).joints;
  EXPECT_EQ(evolutions.end(), RunEnd::finished);
  return candidates;
}

/// What a coordinator receives: no checkpoint of the first island, and after many epochs its worker is lost, so that it
/// is taken up from its very beginning, long after its neighbours have forgotten theirs.
class Forgetful : public ForwardingTransport {
 public:
  Forgetful(std::unique_ptr<Transport> sound, std::function<void()> lose_worker)
      : ForwardingTransport(std::move(sound)), lose_worker_(std::move(lose_worker)) {}
  std::optional<Message> receive(std::chrono::milliseconds patience) override {
    auto message = ForwardingTransport::receive(patience);
    if (!message) return message;
    const auto* checkpoint = std::get_if<Checkpoint>(&*message);
    if (checkpoint != nullptr && checkpoint->island == IslandKey{0, 0}) return std::nullopt;
    const auto* progress = std::get_if<Progress>(&*message);
    if (progress != nullptr && progress->epoch >= 3 * kMigrantEpochs && lose_worker_)
      std::exchange(lose_worker_, nullptr)();
    return message;
  }

 private:
  std::function<void()> lose_worker_;
};

class ForgetfulWorkerPool : public WorkerPool {
 public:
  ForgetfulWorkerPool()
      : transport_(join(exchange_, Role::coordinator, "coordinator"), [this] {
          first_.reset();
          second_.emplace(exchange_, "second");
        }) {}
  Transport& transport() override { return transport_; }
  void launch(RunId) override { first_.emplace(exchange_, "first"); }

 private:
  std::shared_ptr<Exchange> exchange_ = make_exchange();
  Forgetful transport_;
  std::optional<WorkerThread> first_, second_;
};

TEST(IslandEvolver, BeginsARunAnewWhoseIslandsWaitForWhatNobodyKeeps) {
  Pools pools;
  const auto calm = evolve({}, pools.sound);
  EvolverOptions options;
  options.patience.news = std::chrono::milliseconds(300);
  int made = 0;
  const auto found = evolve(options, [&]() -> std::unique_ptr<WorkerPool> {
    if (++made == 1) return std::make_unique<ForgetfulWorkerPool>();
    return pools.sound();
  });
  EXPECT_EQ(made, 2);
  EXPECT_TRUE(same_candidates(calm, found));
}

TEST(IslandEvolver, FindsTheSameOnThreadsOfThisProcess) {
  Pools pools;
  const auto by_two_workers = evolve({}, pools.sound);
  for (const std::uint32_t threads : {1U, 3U}) {
    const auto found = evolve({}, [threads] { return std::make_unique<InProcessWorkerPool>(threads); });
    EXPECT_TRUE(same_candidates(by_two_workers, found)) << threads;
  }
}

TEST(IslandEvolver, DoesNotRunAgainWhatTheJournalHolds) {
  const TemporaryFolder folder;
  const JobIdentity identity{.data_sha256 = "d", .job_sha256 = "j", .seed = 8, .version = "v"};
  Pools pools;
  EvolverOptions options;
  std::vector<JointCandidates> first;
  {
    RunJournal journal(folder.path().string(), identity, RunJournal::Start::anew);
    options.journal = &journal;
    first = evolve(options, pools.sound);
  }
  EXPECT_EQ(pools.made, 1);
  RunJournal journal(folder.path().string(), identity, RunJournal::Start::resume);
  options.journal = &journal;
  EXPECT_TRUE(same_candidates(first, evolve(options, pools.sound)));
  EXPECT_EQ(pools.made, 1);
}

/// A pool in which another watches.
class WatchedWorkerPool : public WorkerPool {
 public:
  WatchedWorkerPool(std::shared_ptr<Exchange> exchange, bool has_worker)
      : exchange_(std::move(exchange)),
        has_worker_(has_worker),
        transport_(join(exchange_, Role::coordinator, "coordinator")) {}
  Transport& transport() override { return *transport_; }
  void launch(RunId) override {
    if (has_worker_) worker_.emplace(exchange_, "worker");
  }

 private:
  std::shared_ptr<Exchange> exchange_;
  bool has_worker_;
  std::unique_ptr<Transport> transport_;
  std::optional<WorkerThread> worker_;
};

/// The runs of which it heard so far that they stand like this.
std::set<RunId> runs_told(Transport& watcher, Control::State state) {
  std::set<RunId> runs;
  while (const auto message = watcher.receive(std::chrono::milliseconds(0)))
    if (const auto* control = std::get_if<Control>(&*message); control != nullptr && control->state == state)
      runs.insert(control->run);
  return runs;
}

TEST(IslandEvolver, EndsAllRunsFromBeforeWhereItResumes) {
  const TemporaryFolder folder;
  const JobIdentity identity{.data_sha256 = "d", .job_sha256 = "j", .seed = 8, .version = "v"};
  const auto exchange = make_exchange();
  const auto watcher = join(exchange, Role::watcher, "watcher");
  const Job job = small_job();
  const std::atomic<bool> interrupt{false};
  std::set<RunId> before;
  for (int run = 0; run < 3; ++run) {
    RunJournal journal(folder.path().string(), identity, RunJournal::Start::resume);
    EvolverOptions options;
    options.journal = &journal;
    options.patience.worker = std::chrono::milliseconds(run < 2 ? 50 : 60'000);
    const MakeWorkerPool make_pool = [&] { return std::make_unique<WatchedWorkerPool>(exchange, run == 2); };
    IslandEvolver evolutions(job, make_pool, interrupt, options);
    evolutions.evolve(small_training(), {job.seed, job.gp.number_generations});
    if (run < 2) before.merge(runs_told(*watcher, Control::State::running));
  }
  EXPECT_EQ(before.size(), 2U);
  const std::set<RunId> ended = runs_told(*watcher, Control::State::cancelled);
  EXPECT_TRUE(std::ranges::includes(ended, before));
}

TEST(IslandEvolver, EndsWhereIslandsDoNotWaitAsWell) {
  Pools pools;
  EvolverOptions options;
  options.asynchronous = true;
  for (const JointCandidates& joint : evolve(options, pools.sound)) EXPECT_FALSE(joint.front.empty());
}

}  // namespace
}  // namespace demecal

// One pool of workers serves all evolutions of a calibration, whatever becomes of its workers between them.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "forwarding_transport.hpp"
#include "in_memory_pool.hpp"
#include "mortal_transport.hpp"
#include "scheduling/island_evolver.hpp"
#include "transport/participants.hpp"

namespace demecal {
namespace {

/// A coordinator's end of the network that brings each worker's status once, as DDS does while it stays the same.
class ToldOnce : public ForwardingTransport {
 public:
  using ForwardingTransport::ForwardingTransport;
  std::optional<Message> receive(std::chrono::milliseconds patience) override {
    auto message = ForwardingTransport::receive(patience);
    const auto* status = message ? std::get_if<WorkerStatus>(&*message) : nullptr;
    if (status != nullptr && !status->leaving && !told_.insert(status->worker).second) return std::nullopt;
    return message;
  }

 private:
  std::set<std::string> told_;
};

/// What a test sees of its pools, and can do to their workers.
class Hosts {
 public:
  int pools = 0, started = 0;

  void start(const std::shared_ptr<Exchange>& exchange) {
    const std::string name = "worker-" + std::to_string(started++);
    auto mortal = std::make_unique<MortalTransport>(join(exchange, Role::worker, name));
    networks_.push_back(mortal.get());
    workers_.push_back(std::make_unique<WorkerThread>(std::move(mortal), name, 1));
  }
  void kill() {
    networks_.back()->die();
    networks_.pop_back();
    workers_.pop_back();
  }
  bool any_alive() const { return !workers_.empty(); }
  void stop_all() { workers_.clear(), networks_.clear(); }

 private:
  std::vector<MortalTransport*> networks_;
  std::vector<std::unique_ptr<WorkerThread>> workers_;
};

class KeptWorkerPool : public WorkerPool {
 public:
  explicit KeptWorkerPool(Hosts& hosts) : hosts_(hosts), transport_(join(exchange_, Role::coordinator, "coordinator")) {
    ++hosts_.pools;
  }
  ~KeptWorkerPool() override { hosts_.stop_all(); }
  Transport& transport() override { return transport_; }
  void launch(RunId) override {
    if (hosts_.any_alive()) return;
    for (int i = 0; i < 2; ++i) hosts_.start(exchange_);
  }

 private:
  Hosts& hosts_;
  std::shared_ptr<Exchange> exchange_ = make_exchange();
  ToldOnce transport_;
};

Job short_job() {
  Job job;
  job.seed = 3;
  job.gp.population_size = 20;
  job.gp.number_generations = 40;
  job.islands = {.per_joint = 3, .topology = Topology::ring, .migration_interval = 5, .migrants = 2};
  return job;
}

constexpr int kEvolutions = 4;

/// The fronts of some evolutions, one after the other, with `between` before each but the first.
std::vector<Population> fronts_of_all(Hosts& hosts, const std::function<void()>& between) {
  const std::atomic<bool> interrupt{false};
  const Job job = short_job();
  EvolverOptions options;
  options.patience.worker = std::chrono::seconds(10);
  const MakeWorkerPool make = [&] { return std::make_unique<KeptWorkerPool>(hosts); };
  IslandEvolver evolutions(job, make, interrupt, options);
  std::vector<Population> fronts;
  for (int i = 0; i < kEvolutions; ++i) {
    if (i > 0) between();
    for (auto& joint : evolutions.evolve(small_training(), {static_cast<std::uint64_t>(i), 40}).joints)
      fronts.push_back(std::move(joint.front));
    EXPECT_EQ(evolutions.end(), RunEnd::finished);
  }
  evolutions.dismiss_workers();
  EXPECT_FALSE(hosts.any_alive());
  EXPECT_EQ(hosts.pools, 1);
  return fronts;
}

TEST(WorkerPool, IsMadeOnceAndItsWorkersAreKnownToEveryEvolution) {
  Hosts hosts;
  const auto fronts = fronts_of_all(hosts, [] {});
  EXPECT_EQ(hosts.started, 2);
  EXPECT_EQ(fronts.size(), 2U * kEvolutions);
  EXPECT_NE(fronts[0], fronts[2]);
}

TEST(WorkerPool, GoesOnWithThoseWhoAreLeftWhereAWorkerDiesBetweenEvolutions) {
  Hosts calm, disturbed;
  int times = 0;
  const auto after_a_death = fronts_of_all(disturbed, [&] {
    if (++times == 2) disturbed.kill();
  });
  EXPECT_EQ(disturbed.started, 2);
  EXPECT_EQ(after_a_death, fronts_of_all(calm, [] {}));
}

TEST(WorkerPool, StartsWorkersAgainWhereNoneIsLeft) {
  Hosts calm, disturbed;
  int times = 0;
  const auto after_all_died = fronts_of_all(disturbed, [&] {
    if (++times == 2) disturbed.kill(), disturbed.kill();
  });
  EXPECT_EQ(disturbed.started, 4);
  EXPECT_EQ(after_all_died, fronts_of_all(calm, [] {}));
}

TEST(Worker, OfOneCoordinatorServesAllItsRunsAndNoneOfAnother) {
  const auto exchange = make_exchange();
  const auto own = join(exchange, Role::coordinator, "own"), other = join(exchange, Role::coordinator, "other");
  constexpr ParticipantId kOwn{1}, kOther{2};  // by the order in which they came
  WorkerThread worker(join(exchange, Role::worker, "worker"), "worker", 1, kSomeCheckpoints, run_of(kOwn, 7));
  RunObserver silent;
  const std::atomic<bool> interrupt{false};
  CalibrationData of_other = small_run(14);
  of_other.run = run_of(kOther, 1);
  other->publish(of_other);
  for (const IslandKey island : islands(of_other.archipelago))
    other->publish(RunState(of_other).task(island, 1, "worker"));
  std::map<std::string, WorkerStatus> present;
  for (const std::uint16_t serial : {1, 2}) {
    CalibrationData data = small_run(13);
    data.run = run_of(kOwn, serial);
    RunResult result = EvolutionRun(*own, RunState(data), silent, present).run(interrupt, {});
    EXPECT_EQ(result.end, RunEnd::finished);
    EXPECT_TRUE(result.present.contains("worker"));
    present = std::move(result.present);
  }
  while (const auto message = other->receive(std::chrono::milliseconds(0))) {
    const auto* outcome = std::get_if<Outcome>(&*message);
    EXPECT_TRUE(outcome == nullptr || outcome->run != of_other.run);
  }
  const RunResult none =
      EvolutionRun(*other, RunState(of_other), silent).run(interrupt, {.worker = std::chrono::milliseconds(200)});
  EXPECT_EQ(none.end, RunEnd::no_worker);
}

}  // namespace
}  // namespace demecal

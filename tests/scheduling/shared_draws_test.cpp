// Draws that workers and the coordinator make together are, to the bit, those that one process makes.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "../draws/random_works.hpp"
#include "draws/draw_work.hpp"
#include "in_memory_pool.hpp"
#include "scheduling/island_evolver.hpp"
#include "scheduling/worker_pool.hpp"

namespace demecal {
namespace {

/// Draws that take long where they are begun, and no time where their numbers are sent.
class SlowHere final : public DrawWork {
 public:
  explicit SlowHere(const DrawWork& work) : DrawWork(work.draws(), work.stream()), work_(work) {}
  std::vector<double> piece(std::size_t number) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    return work_.piece(number);
  }
  std::uint32_t numbers_of_draw() const override { return work_.numbers_of_draw(); }
  DrawInputs inputs() const override { return work_.inputs(); }

 private:
  const DrawWork& work_;
};

struct SharedOutcome {
  std::vector<std::vector<double>> pieces;
  std::size_t elsewhere = 0;
};

SharedOutcome shared(const DrawWork& work, const MakeWorkerPool& make_pool) {
  const std::atomic<bool> interrupt{false};
  const Job job;
  EvolverOptions options;
  options.share_draws = true;
  options.patience.worker = std::chrono::milliseconds(100);
  IslandEvolver evolver(job, make_pool, interrupt, options);
  SharedOutcome outcome{evolver.make_draws(work)};
  outcome.elsewhere = evolver.shared_pieces().elsewhere;
  EXPECT_EQ(evolver.make_draws(work), outcome.pieces) << "the second time";
  evolver.dismiss_workers();
  return outcome;
}

TEST(SharedDraws, AreTheSameWhoeverMakesThem) {
  RandomWorks works(1);
  const AgreementDraws agreements = works.agreements(false, 900);
  const auto gains = works.gains(900);
  for (const DrawWork* work :
       {static_cast<const DrawWork*>(&agreements), static_cast<const DrawWork*>(gains->work.get())}) {
    const auto alone = make_draws(*work);
    for (const int workers : {1, 2, 12}) {
      const SharedOutcome outcome =
          shared(SlowHere(*work), [=] { return std::make_unique<InMemoryWorkerPool>(workers); });
      EXPECT_EQ(outcome.pieces, alone) << workers;
      EXPECT_GT(outcome.elsewhere, 5U) << workers;
    }
  }
}

TEST(SharedDraws, AreMadeHereWhereNoWorkerComesOrCanBeStarted) {
  const AgreementDraws work = RandomWorks(2).agreements(true, 200);
  const auto alone = make_draws(work);
  EXPECT_EQ(shared(work, [] { return std::make_unique<InMemoryWorkerPool>(0); }).pieces, alone);
  const MakeWorkerPool none = []() -> std::unique_ptr<WorkerPool> { throw std::runtime_error("no program"); };
  EXPECT_EQ(shared(work, none).pieces, alone);
}

/// Its workers are gone soon after they came.
class DyingPool final : public WorkerPool {
 public:
  DyingPool() : transport_(join(exchange_, Role::coordinator, "coordinator")) {}
  ~DyingPool() override {
    if (reaper_.joinable()) reaper_.join();
  }
  Transport& transport() override { return *transport_; }
  void launch(RunId) override {
    if (reaper_.joinable()) return;
    for (const char* const name : {"first", "second"})
      workers_.push_back(std::make_unique<WorkerThread>(exchange_, name));
    reaper_ = std::thread([this] {
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      workers_.clear();
    });
  }

 private:
  std::shared_ptr<Exchange> exchange_ = make_exchange();
  std::unique_ptr<Transport> transport_;
  std::vector<std::unique_ptr<WorkerThread>> workers_;
  std::thread reaper_;
};

TEST(SharedDraws, AreTheSameWhereWorkersDie) {
  const AgreementDraws work = RandomWorks(3).agreements(false, 900);
  EXPECT_EQ(shared(SlowHere(work), [] { return std::make_unique<DyingPool>(); }).pieces, make_draws(work));
}

}  // namespace
}  // namespace demecal

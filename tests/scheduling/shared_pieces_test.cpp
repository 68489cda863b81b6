// Work that workers and the coordinator do together is, to the bit, what one process does.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "../shared_work/random_works.hpp"
#include "in_memory_pool.hpp"
#include "scheduling/island_evolver.hpp"
#include "scheduling/worker_pool.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal {
namespace {

/// Work that takes long where it is begun, and no time where its numbers are sent.
class SlowHere final : public SharedWork {
 public:
  explicit SlowHere(const SharedWork& work) : work_(work) {}
  std::vector<double> piece(std::size_t number) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    return work_.piece(number);
  }
  std::size_t pieces() const override { return work_.pieces(); }
  std::uint32_t numbers_of_piece(std::size_t number) const override { return work_.numbers_of_piece(number); }
  WorkInputs inputs() const override { return work_.inputs(); }

 private:
  const SharedWork& work_;
};

struct SharedOutcome {
  std::vector<std::vector<double>> pieces;
  std::size_t elsewhere = 0;
};

SharedOutcome shared(const SharedWork& work, const MakeWorkerPool& make_pool) {
  const std::atomic<bool> interrupt{false};
  const Job job;
  EvolverOptions options;
  options.share_work_from_s = 0.0;
  options.patience.worker = std::chrono::milliseconds(100);
  IslandEvolver evolver(job, make_pool, interrupt, options);
  SharedOutcome outcome{evolver.do_work(work)};
  outcome.elsewhere = evolver.share_of_workers().elsewhere;
  evolver.dismiss_workers();
  return outcome;
}

TEST(SharedPieces, AreTheSameWhoeverMakesThem) {
  RandomWorks works(1);
  const AgreementDraws agreements = works.agreements(false, 900);
  const auto gains = works.gains(900);
  const Resamplings resamplings = works.resamplings(1'500);
  const auto products = works.products(30);
  for (const SharedWork* work :
       std::initializer_list<const SharedWork*>{&agreements, gains->work.get(), &resamplings, products->work.get()}) {
    const auto alone = do_work(*work);
    for (const int workers : {1, 2, 12}) {
      const SharedOutcome outcome =
          shared(SlowHere(*work), [=] { return std::make_unique<InMemoryWorkerPool>(workers); });
      EXPECT_EQ(outcome.pieces, alone) << workers;
      EXPECT_GT(outcome.elsewhere, 5U) << workers;
    }
  }
}

TEST(SharedPieces, AreMadeHereWhereNoWorkerComesOrCanBeStarted) {
  const AgreementDraws work = RandomWorks(2).agreements(true, 200);
  const auto alone = do_work(work);
  EXPECT_EQ(shared(work, [] { return std::make_unique<InMemoryWorkerPool>(0); }).pieces, alone);
  const MakeWorkerPool none = []() -> std::unique_ptr<WorkerPool> { throw std::runtime_error("no program"); };
  EXPECT_EQ(shared(work, none).pieces, alone);
}

TEST(SharedPieces, AreTheSameOneRunAfterAnother) {
  RandomWorks works(4);
  const Resamplings resamplings = works.resamplings(300);
  const auto products = works.products(10);
  const std::atomic<bool> interrupt{false};
  const Job job;
  EvolverOptions options;
  options.share_work_from_s = 0.0;
  IslandEvolver evolver(
      job, [] { return std::make_unique<InMemoryWorkerPool>(2); }, interrupt, options);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(evolver.do_work(SlowHere(resamplings)), do_work(resamplings)) << i;
    EXPECT_EQ(evolver.do_work(SlowHere(*products->work)), do_work(*products->work)) << i;
  }
  EXPECT_EQ(evolver.share_of_workers().pieces, 3 * (resamplings.pieces() + products->work->pieces()));
}

TEST(SharedPieces, AreAllMadeHereWhereTheWorkTakesLessTimeThanIsAskedFor) {
  const Resamplings work = RandomWorks(5).resamplings(500);
  const std::atomic<bool> interrupt{false};
  const Job job;
  EvolverOptions options;
  options.share_work_from_s = 1e3;
  const MakeWorkerPool none = []() -> std::unique_ptr<WorkerPool> { throw std::logic_error("not asked for"); };
  IslandEvolver evolver(job, none, interrupt, options);
  EXPECT_EQ(evolver.do_work(work), do_work(work));
  EXPECT_EQ(evolver.share_of_workers().pieces, 0U);
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

TEST(SharedPieces, AreTheSameWhereWorkersDie) {
  const AgreementDraws work = RandomWorks(3).agreements(false, 900);
  EXPECT_EQ(shared(SlowHere(work), [] { return std::make_unique<DyingPool>(); }).pieces, do_work(work));
}

}  // namespace
}  // namespace demecal

// A pool inside the test's own process.
#pragma once

#include <memory>
#include <vector>

#include "in_memory_run.hpp"
#include "scheduling/island_evolver.hpp"

namespace demecal {

class InMemoryWorkerPool : public WorkerPool {
 public:
  explicit InMemoryWorkerPool(int workers)
      : workers_(workers), transport_(join(exchange_, Role::coordinator, "coordinator")) {}

  Transport& transport() override { return *transport_; }
  void launch(RunId) override {
    if (!threads_.empty()) return;
    for (int i = 0; i < workers_; ++i) {
      threads_.push_back(std::make_unique<WorkerThread>(exchange_, std::string("worker-").append(std::to_string(i))));
    }
  }

 private:
  int workers_;
  std::shared_ptr<Exchange> exchange_ = make_exchange();
  std::unique_ptr<Transport> transport_;
  std::vector<std::unique_ptr<WorkerThread>> threads_;
};

/// What the joints of small_run(8) learn from.
inline std::vector<JointTraining> small_training() {
  std::vector<JointTraining> training;
  const CalibrationData data = small_run(8);
  for (std::size_t i = 0; i < data.tables.size(); ++i) {
    training.push_back({.joint = data.archipelago.joints[i],
                        .table = data.tables[i],
                        .scale_rad = 1.0,
                        .range_rad = {},
                        .branch = {}});
  }
  return training;
}

}  // namespace demecal

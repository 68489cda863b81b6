// Where a calibration's workers are, and one such place: threads of this process.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

#include "protocol/messages.hpp"
#include "transport/transport.hpp"

namespace demecal::inline scheduling {

/// How a calibration reaches its workers: opens the transport, and keeps the workers that it starts alive from one run
/// to the next.
class WorkerPool {
 public:
  virtual ~WorkerPool() = default;
  virtual Transport& transport() = 0;
  /// Called before each run: starts workers where none that it started is left. `run`: one of this coordinator's.
  virtual void launch(RunId run) = 0;
};

using MakeWorkerPool = std::function<std::unique_ptr<WorkerPool>()>;

/// Islands are bred in this process, over the in-memory transport, and no socket is opened: one worker with as many
/// slots as threads are asked for. What is evolved is, to the bit, what any other pool evolves.
class InProcessWorkerPool final : public WorkerPool {
 public:
  explicit InProcessWorkerPool(std::uint32_t threads);
  ~InProcessWorkerPool() override;
  InProcessWorkerPool(const InProcessWorkerPool&) = delete;
  InProcessWorkerPool& operator=(const InProcessWorkerPool&) = delete;

  Transport& transport() override { return *transport_; }
  void launch(RunId run) override;

 private:
  std::uint32_t threads_;
  std::shared_ptr<Exchange> exchange_ = make_exchange();
  std::unique_ptr<Transport> transport_, worker_transport_;
  std::atomic<bool> stop_{false};
  std::thread worker_;  ///< takes the worker's messages; its slots are threads of their own
};

}  // namespace demecal::inline scheduling

#include "scheduling/worker_pool.hpp"

#include <unistd.h>
#include <string>

#include "hosting/worker.hpp"

namespace demecal::inline scheduling {
namespace {

constexpr const char* kWorkerName = "in-process";

}  // namespace

InProcessWorkerPool::InProcessWorkerPool(std::uint32_t threads)
    : threads_(threads), transport_(join(exchange_, Role::coordinator, "coordinator")) {}

InProcessWorkerPool::~InProcessWorkerPool() {
  if (!worker_.joinable()) return;
  stop_ = true;
  worker_transport_->wake();
  worker_.join();
}

void InProcessWorkerPool::launch(RunId) {
  if (worker_.joinable()) return;
  worker_transport_ = join(exchange_, Role::worker, kWorkerName);
  worker_ = std::thread([this] {
    WorkerOptions options;
    options.name = kWorkerName;
    options.host = "localhost";
    options.process = static_cast<std::uint32_t>(::getpid());
    options.slots = threads_;
    Worker(*worker_transport_, options).serve(stop_);
  });
}

}  // namespace demecal::inline scheduling

#include "transport/presence.hpp"

#include <utility>

namespace demecal {

void Presence::heard(const WriterId& writer, WorkerStatus status) {
  const std::lock_guard lock(mutex_);
  const auto known = workers_.find(writer);
  if (known != workers_.end() && !known->second.lost && known->second.status == status) return;
  mailbox_.put(status);
  workers_[writer] = {std::move(status), false};
}

void Presence::fell_silent(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker != workers_.end()) lose(worker->second);
}

void Presence::spoke_again(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker == workers_.end() || !worker->second.lost) return;
  worker->second.lost = false;
  mailbox_.put(worker->second.status);
}

void Presence::departed(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker == workers_.end()) return;
  lose(worker->second);
  workers_.erase(worker);
}

void Presence::lose(Worker& worker) {
  if (worker.lost || worker.status.leaving) return;
  worker.lost = true;
  mailbox_.put(WorkerLost{worker.status.worker});
}

void Heralds::heard(const WriterId& writer, LoopNews news) {
  const std::lock_guard lock(mutex_);
  calibrations_[writer] = news.calibration;
  mailbox_.put(std::move(news));
}

void Heralds::departed(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto gone = calibrations_.extract(writer);
  if (gone) mailbox_.put(CalibrationLost{gone.mapped()});
}

}  // namespace demecal

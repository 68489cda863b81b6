#include "transport/presence.hpp"

#include <algorithm>
#include <utility>

namespace demecal {

ParticipantId participant_of(const WriterId& writer) {
  ParticipantId participant{};
  std::copy_n(writer.begin(), participant.size(), participant.begin());
  return participant;
}

void Presence::heard(const WriterId& writer, WorkerStatus status) {
  const std::lock_guard lock(mutex_);
  const auto known = workers_.find(writer);
  if (known != workers_.end() && !known->second.lost && known->second.status == status) return;
  mailbox_.put(participant_of(writer), status);
  workers_[writer] = {std::move(status), false};
}

void Presence::fell_silent(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker != workers_.end()) lose(writer, worker->second);
}

void Presence::spoke_again(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker == workers_.end() || !worker->second.lost) return;
  worker->second.lost = false;
  mailbox_.put(participant_of(writer), worker->second.status);
}

void Presence::departed(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker == workers_.end()) return;
  lose(writer, worker->second);
  workers_.erase(worker);
}

void Presence::lose(const WriterId& writer, Worker& worker) {
  if (worker.lost || worker.status.leaving) return;
  worker.lost = true;
  mailbox_.put(participant_of(writer), WorkerLost{worker.status.worker});
}

bool Heralds::heard(const WriterId& writer, LoopNews news) {
  const std::lock_guard lock(mutex_);
  const bool is_anothers = std::ranges::any_of(
      calibrations_, [&](const auto& other) { return other.first != writer && other.second == news.calibration; });
  if (is_anothers) return false;
  calibrations_[writer] = news.calibration;
  return mailbox_.put(participant_of(writer), std::move(news));
}

void Heralds::departed(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto gone = calibrations_.extract(writer);
  if (gone) mailbox_.put(participant_of(writer), CalibrationLost{gone.mapped()});
}

}  // namespace demecal

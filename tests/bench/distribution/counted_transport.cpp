#include "counted_transport.hpp"

#include <time.h>

#include <algorithm>

#include "protocol/message_bytes.hpp"

namespace demecal::bench {
namespace {

/// Processor time of this thread, s.
double seconds_of_this_thread() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

bool CountedTransport::await_workers(std::size_t count, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (workers_.size() < count && std::chrono::steady_clock::now() < end) {
    const std::optional<Message> message = ForwardingTransport::receive(std::chrono::milliseconds(100));
    if (!message) continue;
    if (const auto* status = std::get_if<WorkerStatus>(&*message)) workers_[status->worker] = *status;
  }
  to_tell_ = workers_;
  return workers_.size() >= count;
}

std::optional<Message> CountedTransport::receive(std::chrono::milliseconds patience) {
  if (!to_tell_.empty()) {
    Message known = to_tell_.begin()->second;
    to_tell_.erase(to_tell_.begin());
    return known;
  }
  std::optional<Message> message = ForwardingTransport::receive(patience);
  if (message) {
    const double before_s = seconds_of_this_thread();
    received_.push_back(*message);
    counting_s_ += seconds_of_this_thread() - before_s;
  }
  return message;
}

void CountedTransport::publish(const Message& message) {
  if (const auto* task = std::get_if<IslandTask>(&message)) holders_[task->island] = task->worker;
  ForwardingTransport::publish(message);
}

Traffic CountedTransport::traffic(const CalibrationData& data) const {
  Traffic traffic;
  const auto add = [&traffic](std::size_t bytes, std::size_t messages = 1) {
    traffic.messages += messages;
    traffic.bytes += messages * bytes;
  };
  for (const Message& message : received_) {
    if (const auto* progress = std::get_if<Progress>(&message)) add(to_bytes(*progress).size());
    if (const auto* checkpoint = std::get_if<Checkpoint>(&message)) add(to_bytes(*checkpoint).size());
    const auto* outcome = std::get_if<Outcome>(&message);
    if (outcome == nullptr) continue;
    add(to_bytes(*outcome).size());
    const auto is_far = [&](const IslandKey& key) { return holders_.at(key) != holders_.at(outcome->island); };
    if (std::ranges::none_of(consumers(data.archipelago, outcome->island), is_far)) continue;
    Population best = outcome->front;
    if (best.size() > data.archipelago.migrants)
      best.erase(best.begin(), best.end() - static_cast<std::ptrdiff_t>(data.archipelago.migrants));
    add(to_bytes(Migrants{data.run, outcome->island, 1, best, outcome->worker}).size(), epochs_of(data));
  }
  return traffic;
}

std::size_t epochs_of(const CalibrationData& data) {
  return Island(data.parameters, data.archipelago, data.tables.front(), {}, data.seed).epochs_total();
}

}  // namespace demecal::bench

#include "counted_transport.hpp"

#include "transport/message_bytes.hpp"

namespace demecal::bench {

bool CountedTransport::await_workers(std::size_t count, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (workers_.size() < count && std::chrono::steady_clock::now() < end) {
    const std::optional<Message> message = carrier_.receive(std::chrono::milliseconds(100));
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
  std::optional<Message> message = carrier_.receive(patience);
  if (message) heard_.push_back(*message);
  return message;
}

Traffic CountedTransport::traffic() const {
  Traffic traffic;
  const auto add = [&traffic](std::size_t bytes) {
    ++traffic.messages;
    traffic.bytes += bytes;
  };
  for (const Message& message : heard_) {
    if (const auto* progress = std::get_if<Progress>(&message)) add(to_bytes(*progress).size());
    const auto* checkpoint = std::get_if<Checkpoint>(&message);
    if (checkpoint == nullptr) continue;
    const std::size_t whole = to_bytes(*checkpoint).size();
    add(whole);
    if (checkpoint->recent.empty()) continue;
    Checkpoint without_last = *checkpoint;
    without_last.recent.pop_back();
    add(whole - to_bytes(without_last).size());
  }
  return traffic;
}

}  // namespace demecal::bench

#include "transport/mailbox.hpp"

#include <algorithm>
#include <utility>

#include "transport/topic.hpp"

namespace demecal {

bool Mailbox::put(const ParticipantId& source, Message message) {
  {
    const std::lock_guard lock(mutex_);
    Waiting& waiting = sources_[source];
    const std::size_t bytes = weight_bytes(message);
    const bool is_full = waiting.messages.size() >= most_ || waiting.bytes + bytes > most_bytes_;
    if (is_full && !waiting.messages.empty() && !make_room(waiting, message)) return false;
    waiting.bytes += bytes;
    waiting.messages.push_back(std::move(message));
  }
  changed_.notify_one();
  return true;
}

/// Drops the oldest of its key; whether there was one.
bool Mailbox::make_room(Waiting& waiting, const Message& message) {
  if (!is_sent(message)) return true;
  const TopicKey key = key_of(message);
  const auto oldest = std::ranges::find_if(
      waiting.messages, [&](const Message& other) { return is_sent(other) && key_of(other) == key; });
  if (oldest == waiting.messages.end()) return false;
  waiting.bytes -= weight_bytes(*oldest);
  waiting.messages.erase(oldest);
  return true;
}

std::optional<Message> Mailbox::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return !sources_.empty() || woken_; });
  if (sources_.empty()) {
    woken_ = false;
    return std::nullopt;
  }
  auto turn = sources_.upper_bound(served_);
  if (turn == sources_.end()) turn = sources_.begin();
  served_ = turn->first;
  Waiting& waiting = turn->second;
  Message message = std::move(waiting.messages.front());
  waiting.messages.pop_front();
  waiting.bytes -= weight_bytes(message);
  if (waiting.messages.empty()) sources_.erase(turn);
  return message;
}

void Mailbox::wake() {
  {
    const std::lock_guard lock(mutex_);
    woken_ = true;
  }
  changed_.notify_one();
}

}  // namespace demecal

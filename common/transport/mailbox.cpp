#include "transport/mailbox.hpp"

#include <cstdio>
#include <iterator>
#include <utility>

#include "protocol/message_bytes.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline transport {
namespace {

constexpr std::size_t kMostSources = 64;

}  // namespace

bool Mailbox::put(const ParticipantId& source, Message message) {
  {
    const std::lock_guard lock(mutex_);
    Waiting& waiting = sources_[source];
    if (is_full(waiting, 1) && !waiting.is_all_new) discard_replaced(waiting);
    if (is_full(waiting, 1)) return false;
    waiting.bytes += weight_bytes(message);
    waiting.messages.push_back(std::move(message));
  }
  changed_.notify_one();
  return true;
}

bool Mailbox::is_full(const Waiting& waiting, std::size_t share) const {
  return waiting.messages.size() >= most_ / share || waiting.bytes >= most_bytes_ / share;
}

/// All at once, and not again before half has been taken where it was not worth it: a flood shall cost little.
void Mailbox::discard_replaced(Waiting& waiting) {
  std::map<TopicKey, int> kept;
  std::deque<Message> last;
  for (auto message = waiting.messages.rbegin(); message != waiting.messages.rend(); ++message) {
    if (is_sent(*message)) {
      const TopicKey key = key_of(*message);
      if (++kept[key] > values_kept(key.topic)) {
        waiting.bytes -= weight_bytes(*message);
        continue;
      }
    }
    last.push_front(std::move(*message));
  }
  waiting.messages = std::move(last);
  waiting.is_all_new = is_full(waiting, 2);
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
  if (!is_full(waiting, 2)) waiting.is_all_new = false;
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

void RejectionLog::add(const std::string& source, const std::string& why) {
  const std::lock_guard lock(mutex_);
  ++count_;
  if (source.empty() || logged_.size() >= kMostSources || !logged_.insert(source).second) return;
  std::fprintf(stderr, "rejected a message from %s: %s; further ones from there are only counted\n",
               printable(source).c_str(), printable(why).c_str());
  if (logged_.size() == kMostSources) std::fprintf(stderr, "messages rejected from further sources are only counted\n");
}

std::uint64_t RejectionLog::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace demecal::inline transport

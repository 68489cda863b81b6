// Messages that have arrived and wait to be received, and a log of those that were rejected.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "protocol/messages.hpp"
#include "transport/participants.hpp"

namespace demecal::inline transport {

/// First in, first out for each source; between sources turn by turn, so that one that floods makes the others wait for
/// one message at a time. Between any number of threads.
class Mailbox {
 public:
  /// What waits from one source is kept below so many messages, and so many bytes as far as they can be weighed.
  explicit Mailbox(std::size_t most = 16384, std::size_t most_bytes = 256 << 20)
      : most_(most), most_bytes_(most_bytes) {}

  /// Whether there was room. Where there is none, what newer messages of the source replace is discarded, as by writers
  /// that keep their last values; where even that makes no room, the message is.
  bool put(const ParticipantId& source, Message message);
  /// The oldest message of the source whose turn it is, or nothing after `patience` or when woken. A wake() that finds
  /// nobody waiting is kept for the next take() that finds no message.
  std::optional<Message> take(std::chrono::milliseconds patience);
  void wake();

 private:
  struct Waiting {
    std::deque<Message> messages;
    std::size_t bytes = 0;
    bool is_all_new = false;  ///< nothing in it was replaced by another, or little, when it was full
  };
  bool is_full(const Waiting& waiting, std::size_t share) const;
  void discard_replaced(Waiting& waiting);

  std::size_t most_, most_bytes_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<ParticipantId, Waiting> sources_;  ///< those of which anything waits
  ParticipantId served_{};                    ///< last
  bool woken_ = false;
};

/// What was received and not acted on. Any thread may call.
class RejectionLog {
 public:
  /// Counts one more from this source. The first from each is logged on standard error with the reason: of the first
  /// few sources, lest one that invents names fills the screen, and of none without a name.
  void add(const std::string& source, const std::string& why);
  std::uint64_t count() const;

 private:
  mutable std::mutex mutex_;
  std::uint64_t count_ = 0;
  std::set<std::string> logged_;
};

}  // namespace demecal::inline transport

// Messages that have arrived and wait to be received.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "protocol/messages.hpp"

namespace demecal {

/// First in, first out, between any number of threads.
class Mailbox {
 public:
  void put(Message message);
  /// The oldest message, or nothing after `patience` or when woken. A wake() that finds nobody waiting is kept for the
  /// next take() that finds no message.
  std::optional<Message> take(std::chrono::milliseconds patience);
  void wake();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Message> messages_;
  bool woken_ = false;
};

}  // namespace demecal

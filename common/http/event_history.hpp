// What browsers have been and will be told: lines in order, kept within bounds, and read by as many at a time as like,
// each at its own pace. Whoever adds never waits for them.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace demecal::inline http {

/// A line by its number: from 1, ascending, with gaps where lines were thinned out.
struct NumberedLine {
  std::uint64_t number = 0;
  std::shared_ptr<const std::string> text;
};

class EventHistory {
 public:
  /// Beyond `most_lines` every second line of those that have a later one of the same key goes; where that is not
  /// enough, the oldest.
  explicit EventHistory(std::size_t most_lines) : most_lines_(most_lines) {}

  /// `key` names what the line is the latest state of; an empty one, that it is no such state.
  void add(std::string text, std::string key);

  /// Lines behind number `after`, oldest first, until they come to `most_bytes`; at least one, where there is one.
  /// Waits up to `patience` for it.
  std::vector<NumberedLine> after(std::uint64_t after, std::size_t most_bytes, std::chrono::milliseconds patience);

  /// Nobody waits from now on.
  void close();
  bool is_closed() const;

 private:
  struct Kept {
    NumberedLine line;
    std::string key;
  };

  void thin_out();

  const std::size_t most_lines_;
  mutable std::mutex mutex_;
  std::condition_variable added_;
  std::deque<Kept> lines_;
  std::uint64_t last_ = 0;
  bool closed_ = false;
};

}  // namespace demecal::inline http

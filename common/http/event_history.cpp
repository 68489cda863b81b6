#include "http/event_history.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

namespace demecal::inline http {

void EventHistory::add(std::string text, std::string key) {
  const std::lock_guard lock(mutex_);
  lines_.push_back({{++last_, std::make_shared<const std::string>(std::move(text))}, std::move(key)});
  if (lines_.size() > most_lines_) thin_out();
  added_.notify_all();
}

void EventHistory::thin_out() {
  std::map<std::string, std::size_t> later;
  std::deque<Kept> kept;
  for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
    const bool goes = !line->key.empty() && later[line->key]++ % 2 == 1;
    if (!goes) kept.push_front(std::move(*line));
  }
  // Thinned out to hardly less it would be again at once.
  const std::size_t most = most_lines_ - most_lines_ / 8;
  if (kept.size() > most) kept.erase(kept.begin(), kept.end() - static_cast<std::ptrdiff_t>(most));
  lines_ = std::move(kept);
}

std::vector<NumberedLine> EventHistory::after(std::uint64_t after, std::size_t most_bytes,
                                              std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  added_.wait_for(lock, patience, [&] { return closed_ || last_ > after; });
  std::vector<NumberedLine> lines;
  std::size_t bytes = 0;
  const auto number = [](const Kept& kept) { return kept.line.number; };
  for (auto line = std::ranges::upper_bound(lines_, after, {}, number); line != lines_.end(); ++line) {
    bytes += line->line.text->size();
    if (!lines.empty() && bytes > most_bytes) break;
    lines.push_back(line->line);
  }
  return lines;
}

void EventHistory::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  added_.notify_all();
}

bool EventHistory::is_closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace demecal::inline http

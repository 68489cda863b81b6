// The threads of a worker: each computes one piece of work at a time.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace demecal {

/// Thrown out of work by its own beat() when the slots are going away: what it computed so far is dropped.
struct Abandoned {};

/// Runs pieces of work named by `Label` on a fixed number of threads. All calls come from one thread.
template <typename Label>
class Slots {
 public:
  /// `on_finished` is called from a slot's thread after each piece of work.
  Slots(std::uint32_t count, std::function<void()> on_finished) : on_finished_(std::move(on_finished)) {
    for (std::uint32_t i = 0; i < count; ++i) threads_.emplace_back([this](std::stop_token stop) { run(stop); });
  }
  ~Slots() {
    abandoned_ = true;
    for (std::jthread& thread : threads_) thread.request_stop();
    wake_.notify_all();
  }
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;

  /// Whether there is a thread for more work, or none waits yet: who ends a piece then begins the next at once.
  bool has_room() const { return running_ <= threads_.size(); }
  bool is_idle() const { return running_ == 0; }

  void start(Label label, std::function<void()> work) {
    ++running_;
    {
      const std::lock_guard lock(mutex_);
      queue_.emplace_back(std::move(label), std::move(work));
    }
    wake_.notify_one();
  }

  /// The label of a finished piece, or nothing where none is finished.
  std::optional<Label> finished() {
    const std::lock_guard lock(mutex_);
    if (done_.empty()) return std::nullopt;
    Label label = std::move(done_.front());
    done_.pop_front();
    --running_;
    return label;
  }

  /// Work calls this as it gets on; a count that stands still while slots are busy means that they hang.
  void beat() {
    if (abandoned_.load(std::memory_order_relaxed)) throw Abandoned{};
    beats_.fetch_add(1, std::memory_order_relaxed);
  }
  std::uint64_t beats() const { return beats_.load(std::memory_order_relaxed); }

 private:
  void run(std::stop_token stop) {
    while (true) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, stop, [this] { return !queue_.empty(); });
      if (stop.stop_requested()) return;
      auto [label, work] = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      try {
        work();
      } catch (const Abandoned&) {
        return;
      }
      lock.lock();
      done_.push_back(std::move(label));
      lock.unlock();
      on_finished_();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::function<void()> on_finished_;
  std::deque<std::pair<Label, std::function<void()>>> queue_;
  std::deque<Label> done_;
  std::size_t running_ = 0;  ///< started and not yet collected
  std::atomic<std::uint64_t> beats_{0};
  std::atomic<bool> abandoned_{false};
  std::vector<std::jthread> threads_;  // last: stopped before what they use goes
};

}  // namespace demecal

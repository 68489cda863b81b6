// Threads for connections, no more than are allowed: who connects beyond that waits, at first in the kernel's queue.
#pragma once

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace demecal::inline http {

class ConnectionQueue final : public httplib::TaskQueue {
 public:
  /// `make_room` is called now and then while a connection waits for a place: it may end another.
  explicit ConnectionQueue(std::size_t most, std::function<void()> make_room = nullptr)
      : most_(most), make_room_(std::move(make_room)) {}

  /// Waits while as many connections as are allowed go on; so the server takes no further one.
  void enqueue(std::function<void()> connection) override {
    std::unique_lock lock(mutex_);
    const auto has_place = [&] { return is_ending_ || busy_ + waiting_.size() < most_; };
    while (make_room_ && !has_place()) {
      make_room_();
      changed_.wait_for(lock, kPause, has_place);
    }
    changed_.wait(lock, has_place);
    waiting_.push_back(std::move(connection));
    if (idle_ < waiting_.size() && threads_.size() < most_) threads_.emplace_back([this] { serve(); });
    changed_.notify_all();
  }

  /// Nothing waits for a place any longer.
  void end() {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    changed_.notify_all();
  }

  void shutdown() override {
    end();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      ++idle_;
      changed_.wait(lock, [&] { return is_ending_ || !waiting_.empty(); });
      --idle_;
      if (waiting_.empty()) return;
      const std::function<void()> connection = std::move(waiting_.front());
      waiting_.pop_front();
      ++busy_;
      lock.unlock();
      connection();
      lock.lock();
      --busy_;
      changed_.notify_all();
    }
  }

  static constexpr std::chrono::milliseconds kPause{20};  // between two attempts to make room

  const std::size_t most_;
  const std::function<void()> make_room_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0, busy_ = 0;
  bool is_ending_ = false;
};

}  // namespace demecal::inline http

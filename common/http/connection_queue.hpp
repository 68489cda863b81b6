// Threads for connections, no more than are allowed: who connects beyond that waits, at first in the kernel's queue;
// and how many uploads go on.
#pragma once

#include <httplib.h>
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
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

/// Uploads that go on, of all and of each user.
class UploadCount {
 public:
  UploadCount(std::size_t most, std::size_t most_each) : most_(most), most_each_(most_each) {}

  /// The upload of a user for as long as this lives, where there is a place for it.
  class Upload {
   public:
    Upload(UploadCount& count, std::string user)
        : count_(count), user_(std::move(user)), has_place_(count.begin(user_)) {}
    ~Upload() {
      if (has_place_) count_.end(user_);
    }
    Upload(const Upload&) = delete;
    Upload& operator=(const Upload&) = delete;

    bool has_place() const { return has_place_; }

   private:
    UploadCount& count_;
    std::string user_;
    bool has_place_;
  };

 private:
  bool begin(const std::string& user) {
    const std::lock_guard lock(mutex_);
    if (all_ >= most_ || each_[user] >= most_each_) return false;
    ++all_;
    ++each_[user];
    return true;
  }
  void end(const std::string& user) {
    const std::lock_guard lock(mutex_);
    --all_;
    if (--each_[user] == 0) each_.erase(user);
  }

  const std::size_t most_, most_each_;
  std::mutex mutex_;
  std::size_t all_ = 0;
  std::map<std::string, std::size_t> each_;
};

}  // namespace demecal::inline http

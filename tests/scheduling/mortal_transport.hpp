// A transport whose process can be stopped for a while, or die, at any moment.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "forwarding_transport.hpp"
#include "transport/transport.hpp"

namespace demecal {

/// How many times as long as a release build's a run may take before a test gives it up.
#ifdef DEMECAL_SANITIZED
inline constexpr int kPatience = 10;
#else
inline constexpr int kPatience = 1;
#endif

/// Any thread may call.
class MortalTransport final : public ForwardingTransport {
 public:
  using ForwardingTransport::ForwardingTransport;

  /// Nothing comes or goes any more; others learn of it when the transport is destroyed.
  void die() { enter(State::dead); }
  /// Nothing comes or goes until it continues; what is published meanwhile goes out then, late.
  void stop() { enter(State::stopped); }
  void go_on() {
    {
      const std::lock_guard lock(mutex_);
      if (state_ != State::stopped) return;
      for (const Message& message : late_) ForwardingTransport::publish(message);
      late_.clear();
      state_ = State::running;
    }
    changed_.notify_all();
  }
  /// The network says that it does not hear the worker any more, until it says that it does.
  void tell_lost(const std::string& worker) {
    const std::lock_guard lock(mutex_);
    silent_.insert(worker);
    told_.emplace_back(WorkerLost{worker});
  }
  void tell_back(const WorkerStatus& status) {
    const std::lock_guard lock(mutex_);
    silent_.erase(status.worker);
    told_.emplace_back(status);
  }

  void publish(const Message& message) override {
    const std::lock_guard lock(mutex_);
    if (state_ == State::stopped) late_.push_back(message);
    if (state_ == State::running) ForwardingTransport::publish(message);
  }
  std::optional<Message> receive(std::chrono::milliseconds patience) override {
    {
      std::unique_lock lock(mutex_);
      if (!told_.empty()) {
        Message message = std::move(told_.front());
        told_.erase(told_.begin());
        return message;
      }
      if (state_ != State::running) {
        changed_.wait_for(lock, patience, [this] { return state_ != State::stopped || woken_; });
        woken_ = false;
        return std::nullopt;
      }
    }
    auto message = ForwardingTransport::receive(patience);
    const std::lock_guard lock(mutex_);
    const auto* status = message ? std::get_if<WorkerStatus>(&*message) : nullptr;
    if (status != nullptr && silent_.contains(status->worker)) return std::nullopt;
    return message;
  }
  void wake() override {
    {
      const std::lock_guard lock(mutex_);
      woken_ = true;
    }
    changed_.notify_all();
    ForwardingTransport::wake();
  }

  void assert_alive() override {}  // it would be a sign of life of the dead, too
  bool flush(std::chrono::milliseconds) override { return true; }

 private:
  enum class State { running, stopped, dead };

  void enter(State state) {
    {
      const std::lock_guard lock(mutex_);
      if (state_ == State::dead) return;
      state_ = state;
    }
    changed_.notify_all();
    ForwardingTransport::wake();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::running;
  bool woken_ = false;
  std::vector<Message> late_;
  std::vector<Message> told_;  ///< received before all else
  std::set<std::string> silent_;
};

}  // namespace demecal

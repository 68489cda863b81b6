// The share of some time that was spent waiting, kept up as what one waits for comes and goes.
#pragma once

#include <algorithm>
#include <chrono>

namespace demecal {

/// Counts how much of something could work and how much of it waited: an island that is there or not, the slots of a
/// worker. Times are arguments and never go back.
class WaitedShare {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// From `now` on, `waiting` of `all` wait (0 <= waiting <= all); where `all` is 0 the time does not count.
  void set(Time now, double waiting, double all) {
    count_until(now);
    waiting_ = waiting;
    all_ = all;
  }

  /// Something waited for some time that was counted, though not as waiting.
  void add_waited(Time::duration time) { waited_s_ += std::chrono::duration<double>(time).count(); }

  /// 0 to 1, of the time so far; 0 before any has counted.
  double at(Time now) const {
    WaitedShare until = *this;
    until.count_until(now);
    return until.counted_s_ > 0.0 ? std::min(until.waited_s_ / until.counted_s_, 1.0) : 0.0;
  }

 private:
  void count_until(Time now) {
    const double elapsed_s = std::chrono::duration<double>(now - last_).count();
    waited_s_ += waiting_ * elapsed_s;
    counted_s_ += all_ * elapsed_s;
    last_ = now;
  }

  Time last_{};
  double waiting_ = 0.0, all_ = 0.0;
  double waited_s_ = 0.0, counted_s_ = 0.0;
};

}  // namespace demecal

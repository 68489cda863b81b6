#include "workflows/piece_threads.hpp"

#include <pthread.h>
#include <csignal>

#include <algorithm>
#include <atomic>
#include <exception>

namespace demecal::inline workflows {

/// One call of run().
struct PieceThreads::Work {
  std::size_t count;
  const Piece* piece;
  std::atomic<std::size_t> next{0};
  std::mutex faults;
  std::size_t first_fault;
  std::exception_ptr fault{};

  /// Does pieces until none is left.
  void take_part() {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        (*piece)(i);
      } catch (...) {
        const std::lock_guard lock(faults);
        if (fault && i > first_fault) continue;
        first_fault = i;
        fault = std::current_exception();
      }
    }
  }
};

PieceThreads::PieceThreads(unsigned threads)
    : threads_(threads > 0 ? threads : std::max(std::thread::hardware_concurrency(), 1U)) {}

/// With all signals blocked: they are for the threads that wait for them.
void PieceThreads::start_helpers() {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  while (helpers_.size() + 1 < threads_) helpers_.emplace_back([this] { help(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

PieceThreads::~PieceThreads() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  begun_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void PieceThreads::run(std::size_t count, const Piece& piece) {
  if (helpers_.empty()) start_helpers();
  Work work{.count = count, .piece = &piece, .faults = {}, .first_fault = count};
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    ++turn_;
  }
  begun_.notify_all();
  work.take_part();
  std::unique_lock lock(mutex_);
  left_.wait(lock, [this] { return helping_ == 0; });
  work_ = nullptr;
  if (work.fault) std::rethrow_exception(work.fault);
}

void PieceThreads::help() {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    begun_.wait(lock, [&] { return ending_ || turn_ != seen; });
    if (ending_) return;
    seen = turn_;
    if (work_ == nullptr) continue;
    Work& work = *work_;
    ++helping_;
    lock.unlock();
    work.take_part();
    lock.lock();
    if (--helping_ == 0) left_.notify_all();
  }
}

}  // namespace demecal::inline workflows

// The runs of served jobs: processes, one at a time.
#include <chrono>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "coordinator/child_process.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/jobs/job_folders.hpp"
#include "coordinator/jobs/job_service.hpp"
#include "serving/job_queue.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kSavingPoll{20};

std::int64_t unix_time_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

void JobService::tick() {
  const std::lock_guard lock(mutex_);
  try {
    if (child_) watch();
    if (child_) return;
    if (const auto next = queue_.begin_next(unix_time_s())) begin(*next);
  } catch (const std::exception& error) {
    say(error.what());
    child_.reset();
    if (queue_.running()) end(static_cast<int>(ExitCode::run_failed));
  }
}

void JobService::begin(const JobId& id) {
  is_stopping_ = false;
  command_ = 0;
  folders_.save(id, queue_.record(id));
  // What it leaves is of its own files, even where it fails; certificates are of the model that stood there when they
  // were made.
  const bool goes_on = orders_[id].goes_on;
  folders_.remove_results(id, goes_on ? "certificate." : "");
  began_ = Clock::now();
  begin_command(id, goes_on);
}

void JobService::begin_command(const JobId& id, bool keep_terminal) {
  interrupted_.reset();
  const OwnedDescriptor said = folders_.open_terminal(id, keep_terminal);
  child_.emplace(options_.program, orders_[id].commands[command_], folders_.path_of(id), said.get());
}

/// Interrupts the run where it is to end, and takes note of how it ended.
void JobService::watch() {
  const bool is_late = Clock::now() - began_ > options_.longest_run;
  if ((is_stopping_ || is_late) && !interrupted_) {
    child_->interrupt();
    interrupted_ = Clock::now();
  }
  const bool is_stuck = interrupted_ && Clock::now() - *interrupted_ > options_.saving;
  auto code = child_->exit_code();
  if (!code && !is_stuck) return;
  child_.reset();
  const JobId id = *queue_.running();
  const bool goes_on = code == static_cast<int>(ExitCode::done) && ++command_ < orders_[id].commands.size();
  if (goes_on && !is_stopping_) return begin_command(id, true);
  end(code.value_or(static_cast<int>(ExitCode::run_failed)));
}

void JobService::end(int exit_code) {
  const JobId id = *queue_.running();
  queue_.end(exit_code, unix_time_s());
  orders_.erase(id);
  save_or_say(id);
}

void JobService::shut_down() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      if (child_) watch();
      if (!child_) return;
    }
    std::this_thread::sleep_for(kSavingPoll);
  }
}

}  // namespace demecal

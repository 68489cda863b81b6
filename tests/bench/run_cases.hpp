// The cases of a benchmark on several threads; what comes of them does not depend on how many.
#pragma once

#include <atomic>
#include <cstddef>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

namespace demecal::bench {

/// Runs every case below `count` on the first thread that is free, and says when it is finished, one case at a time.
template <typename Run, typename Finished>
void run_cases(std::size_t count, int threads, const Run& run, const Finished& finished) {
  std::atomic<std::size_t> next{0};
  std::mutex one_at_a_time;
  std::vector<std::jthread> workers;
  for (int i = 0; i < threads; ++i)
    workers.emplace_back([&] {
      for (std::size_t number = next++; number < count; number = next++) {
        run(number);
        const std::lock_guard lock(one_at_a_time);
        finished(number);
      }
    });
}

/// The same, counting finished cases on standard error.
template <typename Run>
void run_cases(std::size_t count, int threads, const Run& run) {
  std::size_t done = 0;
  run_cases(count, threads, run, [&](std::size_t) {
    std::cerr << '\r' << ++done << " of " << count << " cases" << std::flush;
    if (done == count) std::cerr << '\n';
  });
}

}  // namespace demecal::bench

// A calibration of real processes over real DDS that everything befalls that can befall one: workers are killed,
// stopped, continued, sent away and added, and the coordinator is killed and resumed. Which, and when, is drawn from a
// seed.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "program.hpp"
#include "random/random_stream.hpp"
#include "small_job.hpp"

namespace demecal {

/// What befell a calibration.
struct Disturbances {
  int killed = 0, stopped = 0, continued = 0, left = 0, joined = 0, resumed = 0;
  int crashed = 0;  ///< workers that ended by a signal of their own

  Disturbances& operator+=(const Disturbances& other);
};

class DisturbedJob {
 public:
  /// Results go to folder `out` of the job; `domain` must be no other's.
  DisturbedJob(const SmallJob& job, const std::string& out, const std::string& domain, std::uint64_t seed);

  /// Until the calibration ends by itself; how it did.
  Ended run();
  const Disturbances& happened() const { return happened_; }

 private:
  struct Worker {
    std::unique_ptr<StartedProgram> program;
    bool stopped = false;
  };

  void start_coordinator(bool resume);
  void disturb();
  void add();
  void kill_worker();
  void stop_worker();
  void continue_one();
  void dismiss();
  void kill_local_worker();
  void note_crash(Worker& worker, std::chrono::milliseconds patience);
  void kill_coordinator();
  void keep_one();

  const SmallJob& job_;
  std::string out_, domain_;
  RandomStream random_;
  Disturbances happened_;
  std::vector<Worker> workers_;
  int local_workers_;
  std::unique_ptr<StartedProgram> coordinator_;
};

}  // namespace demecal

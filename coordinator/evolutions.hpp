// The evolutions of one calibration: the first, and those that follow when effects were found.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "calibration/selection.hpp"
#include "coordinator/calibrate.hpp"

namespace demecal {

/// The evolutions of one calibration, each a run of its own on a fleet of its own.
class Evolutions {
 public:
  Evolutions(const Job& job, const std::function<std::unique_ptr<Fleet>()>& make_fleet,
             const std::atomic<bool>& interrupt, const CalibrateOptions& options)
      : job_(job), make_fleet_(make_fleet), interrupt_(interrupt), options_(options) {}

  /// The candidates that the islands found, or had reached when the run ended; `end` says how it did.
  std::vector<JointCandidates> run(const std::vector<JointTraining>& training);
  RunEnd end() const { return end_; }
  /// Rows of all runs; the generations of a later one follow those of the earlier.
  std::vector<Progress> take_history() { return std::move(history_); }
  const RunFacts& facts() const { return facts_; }

 private:
  void note(RunResult& result);

  const Job& job_;
  const std::function<std::unique_ptr<Fleet>()>& make_fleet_;
  const std::atomic<bool>& interrupt_;
  const CalibrateOptions& options_;
  RunEnd end_ = RunEnd::finished;
  std::vector<Progress> history_;
  RunFacts facts_;
  std::uint32_t runs_ = 0;
};

}  // namespace demecal

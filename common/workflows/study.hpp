// A study: the same data calibrated by many jobs and seeds, one after the other on the workers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "evolution/building_blocks.hpp"
#include "report/study.hpp"
#include "workflows/calibrate.hpp"

namespace demecal::inline workflows {

struct StudyOutcome {
  RunEnd end = RunEnd::finished;
  std::vector<StudyRun> runs;       ///< those that came to their end
  std::vector<IslandFront> fronts;  ///< of the runs' islands
};

/// The figures of a calibration that came to its end; cell and seed are left to the caller. Where validation poses had
/// a part in the last fit, what they said before.
StudyRun figures_of(const DataSet& data, const CalibrateResult& result);

/// Runs every job with every seed: all jobs with the first seed, then all with the second, so that what an interruption
/// leaves compares them alike. `on_run` is told of each run that came to its end, after it was added. Ends with the
/// first that does not. Throws InputError for data that a job cannot be fitted to.
StudyOutcome run_study(const DataSet& data, std::span<const Job> jobs, std::span<const std::uint64_t> seeds,
                       const MakeFleet& make_fleet, const std::atomic<bool>& interrupt, const CalibrateOptions& options,
                       const std::function<void(const StudyOutcome&)>& on_run);

}  // namespace demecal::inline workflows

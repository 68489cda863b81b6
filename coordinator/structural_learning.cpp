#include "coordinator/structural_learning.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "random/random_purpose.hpp"
#include "structure/structural_calibration.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBetweenLines = 10;

}  // namespace

CalibrateResult calibrate_structurally(const DataSet& data, const Job& job, const std::atomic<bool>& interrupt,
                                       const CalibrateOptions& options) {
  const Clock::time_point begin = Clock::now();
  Job without_corrections = job;
  without_corrections.declared.joint_corrections = false;
  CalibrateResult result;
  result.preparation = prepare(data, without_corrections);
  const StructureOptions search;
  const auto watch = [&](int generation, double left) {
    if (!options.quiet && generation % kBetweenLines == 0)
      fmt::print(stderr, "  generation {} of {}: the best structure leaves {:.1f} % of the validation poses' squares\n",
                 generation, search.generations, 1e2 * left);
    return !interrupt;
  };
  RandomStream random{job.seed, number_of(RandomPurpose::structure_search)};
  StructuralCalibration found =
      calibrate_structure(data, job.declared, result.preparation.registered.robot, search, random, watch);
  result.calibration = conclude(data, without_corrections, result.preparation, {});
  result.calibration.robot = std::move(found.robot);
  result.calibration.estimates = std::move(found.estimates);
  result.calibration.index_after_mm2 =
      performance_index_mm2(result.calibration.robot, data, poses_of(data, PoseSet::calibration));
  result.before = result.calibration.robot;
  result.structure = std::move(found.transforms);
  result.model = model_of(data, without_corrections, result.calibration);
  if (interrupt) result.end = RunEnd::interrupted;
  result.facts.generations = static_cast<std::uint64_t>(found.generations);
  result.facts.evaluations = found.evaluations;
  result.facts.interrupted = interrupt;
  result.facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

}  // namespace demecal

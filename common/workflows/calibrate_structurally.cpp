#include "workflows/workflows.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <utility>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "data/data_set.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "scheduling/run_state.hpp"
#include "structure/structural_calibration.hpp"
#include "structure/structure_fit.hpp"

namespace demecal::inline workflows {

CalibrateResult calibrate_structurally(const DataSet& data, const Job& job, const std::atomic<bool>& interrupt,
                                       const CalibrateOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Job without_corrections = job;
  without_corrections.declared.joint_corrections = false;
  CalibrateResult result;
  result.preparation = prepare(data, without_corrections);
  const StructureOptions search;
  const auto watch = [&](int generation, double left) {
    if (options.observer != nullptr) options.observer->on_structure_generation(generation, search.generations, left);
    return !interrupt;
  };
  RandomStream random{job.seed, number_of(RandomPurpose::structure_search)};
  auto found = calibrate_structure(data, job.declared, result.preparation.registered.robot, search, random, watch);
  result.calibration = conclude(data, without_corrections, result.preparation, {});
  result.calibration.robot = std::move(found.robot);
  result.calibration.estimates = std::move(found.estimates);
  result.calibration.index_after_mm2 =
      performance_index_mm2(result.calibration.robot, data, poses_of(data, PoseSet::calibration));
  result.before = result.calibration.robot;
  result.structure = std::move(found.transforms);
  result.model = make_model(data, without_corrections, result.calibration);
  if (interrupt) result.end = RunEnd::interrupted;
  result.facts.generations = static_cast<std::uint64_t>(found.generations);
  result.facts.evaluations = found.evaluations;
  result.facts.interrupted = interrupt;
  result.facts.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace demecal::inline workflows

#include "diagnosis/final_fit.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/candidates.hpp"
#include "diagnosis/evidence.hpp"
#include "effects/measurement.hpp"
#include "fitting/median.hpp"

namespace demecal {
namespace {

constexpr double kWorse = 1.05;  ///< a last fit that leaves this much more of its own poses' errors is not taken

/// Mean squared tool error over the poses, errors beyond ten times the median counted as these.
double capped_index_m2(const DiagnosisData& of, const CorrectedRobot& robot) {
  constexpr double kFarOut = 10.0;
  std::vector<double> errors_m;
  for (const std::size_t pose : of.fitted) errors_m.push_back(tool_error_m(robot, of.data, of.data.poses[pose]));
  const double most_m = kFarOut * median(errors_m);
  double squares = 0.0;
  for (const double error_m : errors_m) squares += std::pow(std::min(error_m, most_m), 2);
  return squares / static_cast<double>(errors_m.size());
}

}  // namespace

std::vector<std::size_t> poses_of_last_fit(const DataSet& data) {
  std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  if (poses_of(data, PoseSet::accept).empty()) return poses;
  std::ranges::copy(poses_of(data, PoseSet::validation), std::back_inserter(poses));
  std::ranges::sort(poses);
  return poses;
}

DiagnosedModel final_fit(const DataSet& data, const DeclaredModel& declared, DiagnosedModel model) {
  constexpr int kSteps = 12;
  const std::vector<std::size_t> poses = poses_of_last_fit(data);
  if (poses == poses_of(data, PoseSet::calibration)) return model;
  const Evidence evidence = evidence_of(data, poses);
  for (Effect& effect : model.robot.effects) set_measured_ranges(effect, data.robot, evidence);
  const DiagnosisData chosen{data, declared, poses_of(data, PoseSet::calibration), {}}, all{data, declared, poses, {}};
  DiagnosedModel last = model;
  last.precision = linearise(chosen, model).precision.tail(model.smooth.coefficients.size());
  last = refined(all, std::move(last), kSteps);
  return capped_index_m2(all, last.robot) <= std::pow(kWorse, 2) * capped_index_m2(all, model.robot) ? last : model;
}

}  // namespace demecal

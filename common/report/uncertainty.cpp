#include "report/uncertainty.hpp"

#include <cmath>

#include "fitting/posterior.hpp"
#include "kinematics/units.hpp"
#include "report/evaluation.hpp"

namespace demecal::inline report {
namespace {

/// Poses enough for a mean of what the posterior says.
constexpr std::size_t kMostPoses = 300;

double mean_posterior_m2(const CalibratedModel& model, const DataSet& data, std::span<const std::size_t> rows) {
  const std::size_t step = 1 + (rows.size() - 1) / kMostPoses;
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < rows.size(); i += step) {
    sum += posterior_square_m2(*model.posterior, model.robot, data, data.poses[rows[i]]);
    count += 1.0;
  }
  return sum / count;
}

}  // namespace

std::optional<UncertaintyEntry> uncertainty_of(const CalibratedModel& model, const DataSet& data,
                                               std::span<const std::size_t> rows, std::optional<double> instrument_m) {
  if (!model.posterior || !model.interval || rows.empty()) return std::nullopt;
  const double scale = model.interval->quantile / kCoverageFactor;
  const double numbers_m = scale * std::sqrt(mean_posterior_m2(model, data, rows));
  const double left_m = scale * std::sqrt(3.0) * model.interval->model_error_m;
  const double stated_m = instrument_m.value_or(0.0) / kCoverageFactor;
  const double standard_m = std::sqrt(numbers_m * numbers_m + left_m * left_m + stated_m * stated_m);
  UncertaintyEntry entry;
  entry.contributions = {
      {"numbers of the model, from the noise of the calibration measurements", "A", if_finite(millimetres(numbers_m))},
      {"error that the model leaves at poses it was not fitted to", "A", if_finite(millimetres(left_m))},
      {"instrument, as its calibration states", "B", {}}};
  if (instrument_m) entry.contributions.back().standard_mm = millimetres(stated_m);
  entry.standard_mm = if_finite(millimetres(standard_m));
  entry.coverage_factor = kCoverageFactor;
  entry.expanded_mm = if_finite(millimetres(kCoverageFactor * standard_m));
  entry.remark = prediction_entry(*model.interval).remark;
  return entry;
}

}  // namespace demecal::inline report

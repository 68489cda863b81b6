#include "calibration/correction_limit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fitting/median.hpp"

namespace demecal {
namespace {

constexpr double kMostOverTarget = 3.0;

/// The largest target errors are often those of poses near a singularity.
double large_target_rad(const JointTraining& training) {
  std::vector<double> sizes;
  const double least = training.table.loss == Loss::squared ? median(training.table.weight) : 1.0;
  for (std::size_t row = 0; row < training.table.target.size(); ++row) {
    if (training.table.weight[row] >= least) sizes.push_back(std::abs(training.table.target[row]));
  }
  if (sizes.empty()) return 0.0;
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), place, sizes.end());
  return *place * training.scale_rad;
}

}  // namespace

double correction_limit_rad(const JointTraining& training) {
  return std::min(kMostOverTarget * large_target_rad(training), training.largest_rad);
}

void limit_formulas(JointTraining& training) {
  training.table.limit = correction_limit_rad(training) / training.scale_rad;
}

}  // namespace demecal

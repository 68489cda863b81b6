#include "calibration/shortened.hpp"

#include <cmath>
#include <vector>

#include "expression/simplify.hpp"

namespace demecal {

JointCorrection shortened(const JointCorrection& correction) {
  if (correction.is_neutral()) return correction;
  constexpr int kGrid = 512;
  std::vector<std::vector<double>> angles_rad(1);
  const auto [lower, upper] = correction.range_rad();
  for (int i = 0; i <= kGrid; ++i) angles_rad[0].push_back(std::lerp(lower, upper, static_cast<double>(i) / kGrid));
  return {simplified_over(correction.formula(), angles_rad), correction.branch(), correction.range_rad()};
}

CorrectedRobot with_shortened_corrections(CorrectedRobot robot) {
  for (JointCorrection& correction : robot.corrections) correction = shortened(correction);
  return robot;
}

}  // namespace demecal

#include "calibration/shared_calls.hpp"

#include <algorithm>

namespace demecal {

FoldedFormula folded_correction(const JointCorrection& correction, const KnownFunctions& functions) {
  if (!functions) return {correction.formula(), 1, {}};
  return folded(correction.formula(), *functions);
}

std::vector<int> joints_calling(const CorrectedRobot& robot, const std::vector<SharedFunction>& functions,
                                std::size_t place) {
  std::vector<int> joints;
  for (std::size_t joint = 0; joint < robot.corrections.size(); ++joint) {
    if (robot.corrections[joint].is_neutral()) continue;
    const FoldedFormula calling = folded_correction(robot.corrections[joint], functions);
    if (std::ranges::binary_search(functions_called(calling), place)) joints.push_back(static_cast<int>(joint));
  }
  return joints;
}

}  // namespace demecal

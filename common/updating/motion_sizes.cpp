#include "updating/motion_sizes.hpp"

#include <cmath>

#include "effects/arm_state.hpp"
#include "effects/catalogue.hpp"

namespace demecal::inline updating {

bool is_of_transmission(const Effect& effect) {
  return cause_of(effect.kind).group == CauseGroup::transmission;
}

std::vector<std::vector<double>> unit_motion_sizes(const CorrectedRobot& robot, const DataSet& data,
                                                   std::span<const std::size_t> poses) {
  std::vector<std::vector<double>> sums(robot.effects.size());
  std::vector<UnitMotion> units;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    sums[i].assign(law_of(robot.effects[i]).coefficients(robot.effects[i], data.robot).size(), 0.0);
    Effect everywhere = robot.effects[i];
    everywhere.ranges.clear();
    for (const std::size_t pose : poses) {
      units.clear();
      append_unit_motions(everywhere, data.robot, arm_state(data.robot, Stop(data.poses[pose])), units);
      for (const UnitMotion& unit : units)
        sums[i][static_cast<std::size_t>(unit.coefficient)] +=
            unit.size * unit.size / static_cast<double>(poses.size());
    }
    for (double& sum : sums[i]) sum = std::sqrt(sum);
  }
  return sums;
}

}  // namespace demecal::inline updating

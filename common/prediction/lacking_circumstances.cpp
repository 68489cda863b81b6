#include "prediction/lacking_circumstances.hpp"

#include <algorithm>

namespace demecal::inline prediction {

std::vector<LackingCircumstance> lacking_circumstances(const CorrectedRobot& robot, const DataSet& data,
                                                       std::span<const std::size_t> poses) {
  std::vector<LackingCircumstance> all;
  for (const Effect& effect : robot.effects) {
    const Needs needs = robot.needs(effect);
    for (const CircumstanceWords& one : circumstances()) {
      if (!(needs.*one.needed)) continue;
      const auto without = static_cast<std::size_t>(
          std::ranges::count_if(poses, [&](std::size_t pose) { return !one.recorded(data.poses[pose]); }));
      if (without > 0) all.push_back({&effect, &one, without, poses.size()});
    }
  }
  return all;
}

std::string to_string(const LackingCircumstance& lacking) {
  const Effect& effect = *lacking.effect;
  return effect.kind + (effect.joint >= 0 ? " of joint " + std::to_string(effect.joint + 1) : "") +
         " cannot be applied as it was calibrated at " + std::to_string(lacking.without) + " of " +
         std::to_string(lacking.poses) + " poses: they do not state " + std::string(lacking.words->words) + ", and " +
         std::string(lacking.words->instead) + " is taken";
}

}  // namespace demecal::inline prediction

#include "effects/displacement.hpp"

namespace demecal {

std::vector<EffectMotion> effect_motions(const std::vector<Effect>& effects, const Robot& described,
                                         const ArmState& state) {
  std::vector<EffectMotion> all;
  std::vector<UnitMotion> motions;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    motions.clear();
    append_unit_motions(effects[i], described, state, motions);
    for (const UnitMotion& motion : motions) all.push_back({static_cast<int>(i), motion});
  }
  return all;
}

bool is_joint_motion(const Chain& chain, const UnitMotion& motion) {
  if (motion.place < 0 || motion.place >= chain.size()) return false;
  const bool revolute = chain.joints[static_cast<std::size_t>(motion.place)].type == JointType::revolute;
  return motion.axis == (revolute ? 5 : 2);
}

Displacement displacement(const Chain& chain, const std::vector<Effect>& effects,
                          const std::vector<EffectMotion>& motions) {
  Displacement sum{JointVector::Zero(chain.size()), PlaceMotions::Zero(6, chain.size() + 1), SmallMotion::Zero()};
  for (const auto& [effect, unit] : motions) {
    const double size =
        unit.size * effects[static_cast<std::size_t>(effect)].value(static_cast<std::size_t>(unit.coefficient));
    if (unit.place == kSensorPlace) {
      sum.sensor[unit.axis] += size;
    } else if (is_joint_motion(chain, unit)) {
      sum.joints[unit.place] += size;
    } else {
      sum.places(unit.axis, unit.place) += size;
    }
  }
  return sum;
}

}  // namespace demecal

// What all effects of a model together do to the arm at one stop.
#pragma once

#include <vector>

#include "effects/effect.hpp"
#include "kinematics/displaced.hpp"

namespace demecal {

/// What a unit of a coefficient of one of a model's effects does.
struct EffectMotion {
  int effect = 0;  ///< of the model's, from 0
  UnitMotion unit;
};

/// The motions of all effects at a state of the nominal arm, by effect.
std::vector<EffectMotion> effect_motions(const std::vector<Effect>& effects, const Robot& described,
                                         const ArmState& state);

/// Motions of all kinds, added up over the effects.
struct Displacement {
  JointVector joints;   ///< along (m) or about (rad) the joints' own axes: they add to the joints' values
  PlaceMotions places;  ///< the rest, by place
  SmallMotion sensor;   ///< of the whole arm, in the measurements' frame about its origin; it comes last
};
Displacement displacement(const Chain& chain, const std::vector<Effect>& effects,
                          const std::vector<EffectMotion>& motions);

/// Whether the motion is that of a joint about or along its own axis.
bool is_joint_motion(const Chain& chain, const UnitMotion& motion);

}  // namespace demecal

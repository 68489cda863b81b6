// The laws of the catalogue, one function each; what each law says stands in the file of its kind.
#pragma once

#include "effects/effect.hpp"

namespace demecal {

const EffectLaw& registration_law();
const EffectLaw& tool_law();
const EffectLaw& joint_offset_law();
const EffectLaw& geometry_law();
const EffectLaw& gain_law();
const EffectLaw& eccentricity_law();
const EffectLaw& gear_harmonic_law();
const EffectLaw& compliance_law();
const EffectLaw& link_bending_law();
const EffectLaw& coupling_law();
const EffectLaw& backlash_law();
const EffectLaw& hysteresis_law();
const EffectLaw& axis_wobble_law();
const EffectLaw& thermal_offset_law();
const EffectLaw& thermal_length_law();
const EffectLaw& drift_law();
const EffectLaw& sensor_scale_law();
const EffectLaw& symbolic_law();

}  // namespace demecal

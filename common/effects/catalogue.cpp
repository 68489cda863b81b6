#include <algorithm>

#include "effects/laws.hpp"
#include "errors/check.hpp"

namespace demecal {

const std::vector<const EffectLaw*>& catalogue() {
  static const std::vector<const EffectLaw*> laws = {
      &registration_law(), &tool_law(),          &joint_offset_law(), &geometry_law(),       &gain_law(),
      &eccentricity_law(), &gear_harmonic_law(), &compliance_law(),   &link_bending_law(),   &coupling_law(),
      &backlash_law(),     &hysteresis_law(),    &axis_wobble_law(),  &thermal_offset_law(), &thermal_length_law(),
      &drift_law(),        &sensor_scale_law(),  &symbolic_law()};
  return laws;
}

const EffectLaw* find_law(std::string_view kind) {
  const auto found = std::ranges::find_if(catalogue(), [&](const EffectLaw* law) { return law->kind() == kind; });
  return found == catalogue().end() ? nullptr : *found;
}

const EffectLaw& law_of(const Effect& effect) {
  const EffectLaw* law = find_law(effect.kind);
  DEMECAL_CHECK(law != nullptr, "kind '" << effect.kind << "'");
  return *law;
}

}  // namespace demecal

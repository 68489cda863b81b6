// How well the radius of a sphere is known that is stated, and where the length is zero that a wire shows. What is not
// exact stands among the known lengths, from the contact (`first`) to the tool that touches it: `second` is empty, and
// the form of the contact leaves the radius free.
#pragma once

#include <algorithm>
#include <string>

#include "data/contacts.hpp"

namespace demecal::inline data {

/// Standard uncertainties where none is stated: of a sphere's radius, with that of the tip that touches it, and of what
/// is to be added to a wire's length.
inline constexpr double kRadiusDeviation_m = 5e-5, kWireZeroDeviation_m = 0.1;

inline bool is_radius(const KnownDistance& known) {
  return known.second.empty();
}

/// A radius of 0 is that of the end of a wire, which shows a length itself.
inline bool is_wire_zero(const KnownDistance& known) {
  return is_radius(known) && known.length_m == 0.0;
}

/// Null where the radius is unknown or exact. Of contacts that are const, a pointer to const.
inline auto* stated_radius(auto& contacts, const std::string& contact) {
  const auto own = std::ranges::find_if(
      contacts.distances, [&](const KnownDistance& known) { return is_radius(known) && known.first == contact; });
  return own == contacts.distances.end() ? nullptr : &*own;
}

}  // namespace demecal::inline data

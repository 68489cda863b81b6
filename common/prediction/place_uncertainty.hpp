// How surely touches that scatter tell how far their contact's place is from another.
#pragma once

#include <vector>

#include "prediction/contact_place.hpp"

namespace demecal::inline prediction {

/// What touches that scatter by `noise_m` leave open of how far a place is from another, m^2: of a plane its tilt, of a
/// sphere its radius, too. Infinite where they do not tell where it is.
double placed_m2(const ContactPlace& own, const std::vector<Touch>& touches, const ContactPlace& other, double noise_m);

}  // namespace demecal::inline prediction

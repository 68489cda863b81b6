// The size of an effect as people say it: in mrad, mm, ppm or arc seconds.
#pragma once

#include <string>

namespace demecal {

/// `value` of an SI unit as it stands in a coefficient's label, with three digits and a unit of fitting size:
/// (0.000412, "rad") is "0.412 mrad", (2e-7, "rad/Nm") "0.2 µrad/Nm", (1.3e-5, "1/K") "13 ppm/K". A dash where it is
/// not finite.
std::string amount(double value, const std::string& unit);

/// The same with two digits, and small angles in arc seconds: "8 arcsec".
std::string limit_amount(double value, const std::string& unit);

}  // namespace demecal

#include "simulation/thermal_truth.hpp"

#include <cmath>
#include <numbers>

namespace demecal {

double temperature_celsius(const TemperatureCourse& course, double time_s) {
  const double middle = 0.5 * (course.lower_celsius + course.upper_celsius);
  const double swing = 0.5 * (course.upper_celsius - course.lower_celsius);
  return middle + swing * std::sin(2.0 * std::numbers::pi * time_s / course.period_s);
}

double deviation(const ThermalOffset& error, const Situation& situation) {
  return error.rad_per_kelvin * situation.warming_kelvin;
}

void deform(Chain& chain, const ThermalLength& error, const Situation& situation) {
  Joint& link = chain.joints[static_cast<std::size_t>(error.joint)];
  const double growth = 1.0 + error.per_kelvin * situation.warming_kelvin;
  link.a_m *= growth;
  link.d_m *= growth;
}

}  // namespace demecal

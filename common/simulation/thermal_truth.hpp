// True errors that follow from the arm's temperature, and the temperature's course.
#pragma once

#include "simulation/situation.hpp"

namespace demecal {

/// A joint's zero that moves as the arm warms up.
struct ThermalOffset {
  int joint = 0;
  double rad_per_kelvin = 0.0;
};

/// A link that grows as the arm warms up: its a and d by this share of themselves.
struct ThermalLength {
  int joint = 0;
  double per_kelvin = 0.0;
};

/// The arm's temperature over the measurement: a slow swing between two values, starting half way and rising.
struct TemperatureCourse {
  double lower_celsius = 20.0;
  double upper_celsius = 20.0;
  double period_s = 1800.0;
};

/// degC, `time_s` after the first pose.
double temperature_celsius(const TemperatureCourse& course, double time_s);

/// What it adds to its joint's angle, rad (m for prismatic joints).
double deviation(const ThermalOffset& error, const Situation& situation);
/// The link grown by the situation's warming.
void deform(Chain& chain, const ThermalLength& error, const Situation& situation);

}  // namespace demecal

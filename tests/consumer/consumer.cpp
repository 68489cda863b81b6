// Calibrates the data set that it is given, and prints what is left of the error and what to send to reach a pose.
#include <demecal/demecal.hpp>
#include <iostream>

int main(int, char** arguments) {
  const demecal::Measurements measured = demecal::Measurements::load(arguments[1]);
  const demecal::CalibratedArm arm = demecal::calibrate(measured);
  std::cout << arm.errors(measured, demecal::PoseUse::validation).rms_mm << " mm rms on validation poses\n";
  for (const double joint_deg : arm.correct({{10, -80, 120, 0, 40, 0}})) std::cout << joint_deg << ' ';
  std::cout << "deg\n";
  arm.save(arguments[2]);
}

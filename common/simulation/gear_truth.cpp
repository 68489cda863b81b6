#include "simulation/gear_truth.hpp"

#include <array>
#include <cmath>

#include "expression/evaluate.hpp"

namespace demecal {
namespace {

double harmonic(double angle, double cosine, double sine) {
  return cosine * std::cos(angle) + sine * std::sin(angle);
}

}  // namespace

VariableNames symbolic_variables(int joints) {
  VariableNames names;
  for (int joint = 1; joint <= joints; ++joint) names.push_back(std::to_string(joint).insert(0, 1, 'q'));
  names.insert(names.end(), {"tau", "s", "T"});
  return names;
}

double deviation(const JointError& error, const Situation& situation) {
  const std::array<double, 1> theta{situation.commanded[error.joint]};
  return evaluate(error.formula, theta);
}

double deviation(const GearHarmonic& error, const Situation& situation) {
  return harmonic(error.ratio * situation.commanded[error.joint], error.cosine_rad, error.sine_rad);
}

double deviation(const Gain& error, const Situation& situation) {
  return error.per_rad * situation.commanded[error.joint];
}

double deviation(const Eccentricity& error, const Situation& situation) {
  return harmonic(error.order * situation.commanded[error.joint], error.cosine_rad, error.sine_rad);
}

double deviation(const Coupling& error, const Situation& situation) {
  const double q = situation.commanded[error.from];
  return error.per_rad * q + harmonic(q, error.cosine_rad, error.sine_rad);
}

double deviation(const SymbolicError& error, const Situation& situation) {
  std::vector<double> values(situation.commanded.begin(), situation.commanded.end());
  values.insert(values.end(), {situation.loads[static_cast<std::size_t>(error.joint)].effort,
                               situation.approach[error.joint], situation.warming_kelvin});
  return evaluate(error.formula, values);
}

}  // namespace demecal

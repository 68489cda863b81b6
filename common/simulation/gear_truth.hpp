// True errors of a joint that follow from where the joints stand, and from nothing else.
#pragma once

#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "simulation/situation.hpp"

namespace demecal {

/// A smooth error of a joint as a formula in theta (rad in, rad out).
struct JointError {
  int joint = 0;
  Tree formula;
};

/// A gear's transmission error: cosine rad * cos(N theta) + sine rad * sin(N theta).
struct GearHarmonic {
  int joint = 0;
  double ratio = 1.0;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;
};

/// A wrong gear ratio: `per_rad` times theta.
struct Gain {
  int joint = 0;
  double per_rad = 0.0;
};

/// An eccentric gear or encoder: cosine rad * cos(n theta) + sine rad * sin(n theta).
struct Eccentricity {
  int joint = 0;
  int order = 1;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;
};

/// A joint dragged along by another: per_rad * q + cosine * cos(q) + sine * sin(q), q being the other's value.
struct Coupling {
  int joint = 0;
  int from = 0;
  double per_rad = 0.0;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;
};

/// An error outside every catalogue: a formula in the variables that symbolic_variables() names.
struct SymbolicError {
  int joint = 0;
  Tree formula;
};

/// q1 .. qn (rad or m), then of the joint in error: tau (Nm or N, of gravity), s (approach sign), and T (K of warming).
VariableNames symbolic_variables(int joints);

/// What each adds to its joint's angle, rad (m for prismatic joints).
double deviation(const JointError& error, const Situation& situation);
double deviation(const GearHarmonic& error, const Situation& situation);
double deviation(const Gain& error, const Situation& situation);
double deviation(const Eccentricity& error, const Situation& situation);
double deviation(const Coupling& error, const Situation& situation);
double deviation(const SymbolicError& error, const Situation& situation);

}  // namespace demecal

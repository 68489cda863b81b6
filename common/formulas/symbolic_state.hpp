// How the nominal arm stands, and what its own weight does to its joints, as expressions of them.
#pragma once

#include "effects/weight_parts.hpp"
#include "formulas/symbolic_frame.hpp"

namespace demecal {

/// As ArmState, at a stop of which nothing is known but the joints: no payload, no approach, no warmth, no time.
struct SymbolicState {
  const Robot* robot;
  std::vector<Expression> joints;     ///< where an effect is taken: where the arm is, or within what was measured
  std::vector<SymbolicFrame> places;  ///< n + 1, base frame; of where the arm is
  std::vector<SymbolicFrame> links;   ///< n, base frame
  SymbolicVector tool_in_sensor;

  Algebra& algebra() const { return tool_in_sensor[0].algebra(); }
};

/// The state of the arm at the joints; its tool in the sensor's frame is set by the caller who knows it.
SymbolicState symbolic_state(Algebra& algebra, const Robot& robot, const std::vector<Expression>& joints);

/// Nm (revolute) or N (prismatic): what a gravity does to a joint through the masses of the links beyond.
Expression effort(const SymbolicState& state, int joint, const Eigen::Vector3d& gravity_mps2);
/// The moment of gravity at the joint's place, in the axes of the place, Nm.
SymbolicVector gravity_moment(const SymbolicState& state, int joint);
/// As lever() of numbers, under any gravity.
Expression lever(const SymbolicState& state, int joint, const WeightPart& part, const Eigen::Vector3d& gravity_mps2);

}  // namespace demecal

// How the nominal arm stands and what its own weight does to its joints, as expressions of them, and how laws write
// their motions in these.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "effects/weight_parts.hpp"
#include "kinematics/chain.hpp"
#include "symbolic/algebra.hpp"
#include "symbolic/code.hpp"
#include "symbolic/parse_expression.hpp"

namespace demecal::inline effects {

using SymbolicVector = std::vector<Expression>;  ///< x, y, z

SymbolicVector constant_vector(Algebra& algebra, const Eigen::Vector3d& vector);
SymbolicVector plus(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector minus(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector scaled(Expression factor, const SymbolicVector& a);
Expression dot(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector cross(const SymbolicVector& a, const SymbolicVector& b);

/// Axes and origin in the frame that it stands in.
struct SymbolicFrame {
  std::array<SymbolicVector, 3> axes;
  SymbolicVector origin;

  explicit SymbolicFrame(Algebra& algebra);  ///< the frame it stands in itself
  SymbolicFrame(Algebra& algebra, const Eigen::Isometry3d& pose);

  Algebra& algebra() const { return origin[0].algebra(); }
  /// A direction or a point, given in this frame, in the frame it stands in.
  SymbolicVector direction(const SymbolicVector& own) const;
  SymbolicVector point(const SymbolicVector& own) const;
  /// A direction of the frame it stands in, in this frame.
  SymbolicVector own_direction(const SymbolicVector& outer) const;
  SymbolicMatrix matrix() const;
};

/// `frame` and then `next`, which stands in it.
SymbolicFrame operator*(const SymbolicFrame& frame, const SymbolicFrame& next);
/// `frame` seen from `from`; both stand in the same frame.
SymbolicFrame seen_from(const SymbolicFrame& from, const SymbolicFrame& frame);

/// As driven_joints() of numbers.
std::vector<Expression> driven_joints(const Chain& chain, std::vector<Expression> commanded);
/// As elementary_value() of numbers.
Expression elementary_value(const Joint& joint, LinkParameter parameter, Expression q);
/// `frame` moved by an elementary transform of the given value; an angle of exactly 0 or a right angle is exact.
void advance(SymbolicFrame& frame, const Elementary& transform, Expression value);

/// Six components as of SmallMotion: a shift, and then a turn by a rotation vector.
using SymbolicMotion = std::vector<Expression>;
SymbolicFrame moved(const SymbolicFrame& frame, const SymbolicMotion& motion);

/// As ArmState, at any joints, payload, warmth and approach: symbols of code.hpp. Nothing is known of time and drives.
struct SymbolicState {
  const Robot* robot;
  std::vector<Expression> joints;     ///< where an effect is taken: where the arm is, or within what was measured
  std::vector<Expression> driven;     ///< where the drives turn the joints of the arm as it is
  std::vector<SymbolicFrame> places;  ///< n + 1, base frame; of where the arm is
  std::vector<SymbolicFrame> links;   ///< n, base frame
  SymbolicVector tool_in_sensor;
  SymbolicVector payload_point{};   ///< where the payload hangs, base frame
  double reference_celsius = 20.0;  ///< above which warming counts; set by the caller

  Expression payload_kg() const { return algebra().symbol(kPayload); }
  /// Of the joint that counts from 0.
  Expression approach(int which) const { return algebra().symbol(approach_symbol(which + 1)); }
  Algebra& algebra() const { return tool_in_sensor[0].algebra(); }
};

/// The state of the arm at the joints; its tool in the sensor's frame is set by the caller who knows it.
SymbolicState symbolic_state(Algebra& algebra, const Robot& robot, const std::vector<Expression>& joints);

/// Nm (revolute) or N (prismatic): what a gravity does to a joint through the payload and the links beyond.
Expression effort(const SymbolicState& state, int joint, const Eigen::Vector3d& gravity_mps2);
/// The moment of gravity at the joint's place, in the axes of the place, Nm.
SymbolicVector gravity_moment(const SymbolicState& state, int joint);
/// As payload_torque() of numbers.
Expression payload_torque(const SymbolicState& state, int joint);
/// As lever_moment() of numbers.
SymbolicVector lever_moment(const SymbolicState& state, int joint, const WeightPart& part);
/// As lever() of numbers, under any gravity.
Expression lever(const SymbolicState& state, int joint, const WeightPart& part, const Eigen::Vector3d& gravity_mps2);

/// What a unit of one coefficient does, as UnitMotion.
struct SymbolicUnit {
  int coefficient;
  int place;
  int axis;
  Expression size;
};

/// One effect whose motions are being written as expressions; what comes to nothing is left out.
struct SymbolicWriter {
  const Effect& effect;
  const SymbolicState& state;
  const std::string& name;  ///< stands for the effect's formula where it has one
  std::vector<SymbolicUnit> units{};

  const Robot& robot() const { return *state.robot; }
  Expression constant(double value) const { return state.algebra().constant(value); }
  Expression joint(int which) const { return state.joints[static_cast<std::size_t>(which)]; }
  Expression own_joint() const { return joint(effect.joint); }
  Expression torque(int which) const { return effort(state, which, robot().gravity_mps2); }
  /// As warming_kelvin() of numbers.
  Expression warming() const;

  void append(int coefficient, int place, int axis, Expression size);
  /// About the effect's joint, or along it where it is prismatic.
  void append_joint(int coefficient, Expression size);
  /// Cosine and sine of the angle, as motions of the effect's joint.
  void append_wave(Expression angle);
  /// A change of a link parameter of the effect's joint: its transform's screw, seen from the joint's place.
  void append_link(int coefficient, LinkParameter parameter, Expression size);
  /// The first `count` motions of a place, coefficient by coefficient.
  void append_rigid(int place, int count);
};

/// What a unit of each coefficient of the effect does at the state.
std::vector<SymbolicUnit> symbolic_units(const Effect& effect, const SymbolicState& state, const std::string& name);

}  // namespace demecal::inline effects

// What is wrong with a simulated robot: each kind of true error, written independently of the law that looks for it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "simulation/stance.hpp"

namespace demecal::inline simulation {

// An error says by visit_fields() which keys a scenario's file has for it; joints count from 0 inside. `visit` has
//   number(key, value), optional(key, value)     a plain number; 0 where it is left out
//   positive(key, value), order(key, value)      above 0; a whole number from 1 on, 1 where it is left out
//   motion(stem, value), optional_motion(...)    rad or m by the kind of the joint, at borders with the unit in the key
//   per_load(revolute_key, prismatic_key, value) a number whose key goes by the kind of the joint
//   tilts(stem, vector)                          angles about x and y of the joint's place; 0 where left out
//   joint(key, joint), formula(key, tree, names)
// Those that come of the arm's weight, or bear it, say so by takes_weight().
// What an error does is an overload of deviation() (added to its joint, rad or m), tilt() (the rotation vector by which
// its joint's axis tilts, rad, in the axis frame) or deform() (of links). TrueErrors lists the kinds.

/// An error of a link parameter, rad or m.
struct GeometryError {
  int joint = 0;
  LinkParameter parameter = LinkParameter::theta;
  double value = 0.0;
};
/// The error added to its link parameter.
void deform(Chain& chain, const GeometryError& error);

/// A smooth error of a joint as a formula in theta (rad in, rad out).
struct JointError {
  int joint = 0;
  Tree formula;

  void visit_fields(auto&& visit) { visit.formula("formula", formula, theta_only()); }
};
double deviation(const JointError& error, const Situation& situation);

/// A wrong gear ratio: `per_rad` times theta.
struct Gain {
  int joint = 0;
  double per_rad = 0.0;

  void visit_fields(auto&& visit) { visit.number("share", per_rad); }
};
double deviation(const Gain& error, const Situation& situation);

/// An eccentric gear or encoder: cosine rad * cos(n theta) + sine rad * sin(n theta).
struct Eccentricity {
  int joint = 0;
  int order = 1;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;

  void visit_fields(auto&& visit) {
    visit.order("order", order);
    visit.optional_motion("cosine", cosine_rad);
    visit.optional_motion("sine", sine_rad);
  }
};
double deviation(const Eccentricity& error, const Situation& situation);

/// A gear's transmission error: cosine rad * cos(N theta) + sine rad * sin(N theta).
struct GearHarmonic {
  int joint = 0;
  double ratio = 1.0;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;

  void visit_fields(auto&& visit) {
    visit.positive("ratio", ratio);
    visit.optional_motion("cosine", cosine_rad);
    visit.optional_motion("sine", sine_rad);
  }
};
double deviation(const GearHarmonic& error, const Situation& situation);

/// A joint dragged along by another: per_rad * q + cosine * cos(q) + sine * sin(q), q being the other's value.
struct Coupling {
  int joint = 0;
  int from = 0;
  double per_rad = 0.0;
  double cosine_rad = 0.0;
  double sine_rad = 0.0;

  void visit_fields(auto&& visit) {
    visit.joint("from", from);
    visit.optional("share", per_rad);
    visit.optional_motion("cosine", cosine_rad);
    visit.optional_motion("sine", sine_rad);
  }
};
double deviation(const Coupling& error, const Situation& situation);

/// Lost motion of the joint's gear, rad: the joint stops half of it short on either side, so that it stands at
/// q - s width / 2, s being the sign of its last motion.
struct Backlash {
  int joint = 0;
  double width_rad = 0.0;

  void visit_fields(auto&& visit) { visit.motion("width", width_rad); }
};
double deviation(const Backlash& error, const Situation& situation);

/// Friction against the gear's spring: the joint stops short by friction_rad (1 + per_nm |tau|), tau being the torque
/// of gravity on it.
struct Hysteresis {
  int joint = 0;
  double friction_rad = 0.0;
  double per_nm = 0.0;

  void visit_fields(auto&& visit) {
    visit.motion("friction", friction_rad);
    visit.optional("per_nm", per_nm);
  }
  bool takes_weight() const { return per_nm != 0.0; }
};
double deviation(const Hysteresis& error, const Situation& situation);

/// Gear compliance, rad/Nm, under the weight of the links and the payload: the joint gives way where gravity pushes it.
struct Compliance {
  int joint = 0;
  double rad_per_nm = 0.0;

  void visit_fields(auto&& visit) { visit.per_load("rad_per_nm", "m_per_n", rad_per_nm); }
  bool takes_weight() const { return true; }
};
double deviation(const Compliance& error, const Situation& situation);

/// A spring between a pivot `fixed_m` from the joint's axis on the link before it and one `moving_m` from it on the
/// link behind, nearest where the joint is at shortest_rad: it pulls with force_n there and n_per_m more as it grows,
/// and the joint gives way to it.
struct BalanceSpring {
  int joint = 0;
  double fixed_m = 0.0;
  double moving_m = 0.0;
  double shortest_rad = 0.0;
  double force_n = 0.0;
  double n_per_m = 0.0;
  double rad_per_nm = 0.0;

  void visit_fields(auto&& visit) {
    visit.positive("fixed_m", fixed_m);
    visit.positive("moving_m", moving_m);
    visit.optional_motion("shortest", shortest_rad);
    visit.optional("force_n", force_n);
    visit.optional("n_per_m", n_per_m);
    visit.number("rad_per_nm", rad_per_nm);
  }
  bool takes_weight() const { return true; }
};
double deviation(const BalanceSpring& error, const Situation& situation);

/// A joint's zero that moves as the arm warms up.
struct ThermalOffset {
  int joint = 0;
  double rad_per_kelvin = 0.0;

  void visit_fields(auto&& visit) { visit.per_load("rad_per_kelvin", "m_per_kelvin", rad_per_kelvin); }
};
double deviation(const ThermalOffset& error, const Situation& situation);

/// q1 .. qn (rad or m), then of the joint in error: tau (Nm or N, of gravity), s (approach sign), and T (K of warming).
VariableNames symbolic_variables(int joints);

/// An error outside every catalogue: a formula in the variables that symbolic_variables() names.
struct SymbolicError {
  int joint = 0;
  Tree formula;

  void visit_fields(auto&& visit) { visit.formula("formula", formula, symbolic_variables(visit.joints())); }
};
double deviation(const SymbolicError& error, const Situation& situation);

/// A joint's bearing, and the link before it, give way across the axis: the axis tilts about x and y of its own frame
/// by the moment of gravity there times these, rad/Nm.
struct LinkBending {
  int joint = 0;
  double x_rad_per_nm = 0.0;
  double y_rad_per_nm = 0.0;

  void visit_fields(auto&& visit) {
    visit.optional("x_rad_per_nm", x_rad_per_nm);
    visit.optional("y_rad_per_nm", y_rad_per_nm);
  }
  bool takes_weight() const { return true; }
};
Eigen::Vector3d tilt(const LinkBending& error, const Situation& situation);

/// A turning axis that wobbles n times a turn: it tilts about x and y of its own frame by
/// cosine_rad cos(n theta) + sine_rad sin(n theta).
struct AxisWobble {
  int joint = 0;
  int order = 1;
  Eigen::Vector2d cosine_rad = Eigen::Vector2d::Zero();
  Eigen::Vector2d sine_rad = Eigen::Vector2d::Zero();

  void visit_fields(auto&& visit) {
    visit.order("order", order);
    visit.tilts("cosine", cosine_rad);
    visit.tilts("sine", sine_rad);
  }
};
Eigen::Vector3d tilt(const AxisWobble& error, const Situation& situation);

/// A link that grows as the arm warms up: its a and d by this share of themselves.
struct ThermalLength {
  int joint = 0;
  double per_kelvin = 0.0;

  void visit_fields(auto&& visit) { visit.number("share_per_kelvin", per_kelvin); }
};
/// The link grown by the situation's warming.
void deform(Chain& chain, const ThermalLength& error, const Situation& situation);

/// The base creeps through the sensor's frame: a translation and a rotation (about the sensor's origin) that grow with
/// time.
struct Drift {
  Eigen::Vector3d metres_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rad_per_s = Eigen::Vector3d::Zero();
};
/// `pose` (sensor's frame) as it stands `time_s` after the first pose.
Eigen::Isometry3d drifted(const Eigen::Isometry3d& pose, const Drift& drift, double time_s);

/// Lengths are measured (1 + share) times as long as they are.
struct SensorScale {
  double share = 0.0;
};
/// What the instrument reads for a point (sensor's frame, m).
Eigen::Vector3d scaled(const Eigen::Vector3d& point_m, const SensorScale& scale);

/// Everything that is wrong with a robot and its instrument.
struct TrueErrors {
  std::vector<GeometryError> geometry;
  std::vector<JointError> joint_errors;
  std::vector<Gain> gains;
  std::vector<Eccentricity> eccentricities;
  std::vector<GearHarmonic> gear_harmonics;
  std::vector<Coupling> couplings;
  std::vector<Backlash> backlash;
  std::vector<Hysteresis> hysteresis;
  std::vector<Compliance> compliance;
  std::vector<BalanceSpring> balance_springs;
  std::vector<ThermalOffset> thermal_offsets;
  std::vector<SymbolicError> symbolic;
  std::vector<LinkBending> link_bending;
  std::vector<AxisWobble> axis_wobble;
  std::vector<ThermalLength> thermal_lengths;
  Drift drift;
  SensorScale sensor_scale;
  Eigen::Vector3d tool_error_m = Eigen::Vector3d::Zero();
};

/// The keys of what is not wrong with a joint or link: of the instrument and the tool.
inline constexpr std::string_view kDriftKey = "drift", kSensorScaleKey = "sensor_scale", kToolErrorKey = "tool_mm";

/// Calls visit(key, list) with every list of joints' and links' errors and its key in a scenario's file, in the order
/// in which they add up.
template <typename Errors, typename Visit>
void visit_joint_errors(Errors& errors, Visit&& visit) {
  visit("geometry", errors.geometry);
  visit("joint_errors", errors.joint_errors);
  visit("gain", errors.gains);
  visit("eccentricity", errors.eccentricities);
  visit("gear_harmonic", errors.gear_harmonics);
  visit("coupling", errors.couplings);
  visit("backlash", errors.backlash);
  visit("hysteresis", errors.hysteresis);
  visit("compliance", errors.compliance);
  visit("balancer", errors.balance_springs);
  visit("thermal_offset", errors.thermal_offsets);
  visit("symbolic", errors.symbolic);
  visit("link_bending", errors.link_bending);
  visit("axis_wobble", errors.axis_wobble);
  visit("thermal_length", errors.thermal_lengths);
}

/// The arm's temperature over the measurement: a slow swing between two values, starting half way and rising.
struct TemperatureCourse {
  double lower_celsius = 20.0;
  double upper_celsius = 20.0;
  double period_s = 1800.0;
};
/// degC, `time_s` after the first pose.
double temperature_celsius(const TemperatureCourse& course, double time_s);

}  // namespace demecal::inline simulation

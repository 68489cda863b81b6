// The unknown weights of an arm, part by part, and where an arm is likely to stand: what a law could show of itself.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"

namespace demecal::inline effects {

/// One of a link's four unknowns that gravity's torque on a joint is linear in: its first moments along x, y, z of its
/// own frame (kg m), or its mass as if hung at its frame's origin (kg).
struct WeightPart {
  int link = 0;  ///< from 0
  int axis = 0;  ///< 0-2: first moment; 3: mass
};

/// What gravity of unit strength does, per unit of the part, to the joint along its axis: dimensionless (moments) or m
/// (mass) for a revolute joint, 0 or dimensionless for a prismatic one.
double lever(const Robot& robot, const ArmState& state, int joint, const WeightPart& part);

/// The moment of gravity of unit strength about the joint's place, in its axes, per unit of the part: dimensionless
/// (moments) or m (mass).
Eigen::Vector3d lever_moment(const ArmState& state, int joint, const WeightPart& part);

/// The parts of the links beyond the joint that can be told apart at these states: moments before masses, inner links
/// before outer ones, each kept where more than 1 % of it is independent of those before.
std::vector<WeightPart> independent_parts(const Robot& robot, const std::vector<ArmState>& states, int joint);
/// The same of what tilts the joint's place across its axis.
std::vector<WeightPart> tilting_parts(const Robot& robot, const std::vector<ArmState>& states, int joint);

/// What the drives' torques tell of the weight on a joint: the torque (Nm or N) of gravity of each independent part
/// ("logged_3_mx", times its lever), of friction ("logged_friction", against the last motion) and of the sensor itself
/// ("logged_zero"), by least squares over these states. Of what their payloads weigh it is free. Nothing where torques
/// were not logged at all of them, or are the same at all.
std::map<std::string, double> logged_weights(const Robot& robot, const std::vector<ArmState>& states, int joint);
/// Before the name of a part among those.
inline constexpr std::string_view kLogged = "logged_";
/// The torque of gravity on the joint by such weights, payload left out.
double weight_torque(const std::map<std::string, double>& weights, const Robot& robot, const ArmState& state,
                     int joint);
/// That of the state's payload at the tool point alone.
double payload_torque(const Robot& robot, const ArmState& state, int joint);

/// Before the name of a part in the settings of an effect that has it.
inline constexpr std::string_view kKeep = "keep_";
/// The parts that an effect's settings keep, in the order of its coefficients.
std::vector<WeightPart> kept_parts(const Effect& effect);

/// Gravity turned a quarter about each of the two directions across it: of a base that stands upright, about x and y.
std::array<Eigen::Vector3d, 2> turned_gravity(const Eigen::Vector3d& gravity_mps2);

/// "3_mx" or "3_mass"; links count from 1.
std::string name_of(const WeightPart& part);
/// The part of that name; nothing where there is none.
std::optional<WeightPart> weight_part(std::string_view name);

/// 64 states with `payload_kg`, joints within the measured ranges (where these are unknown: a turn, or a prismatic
/// joint's limits), spread evenly by a Halton sequence.
std::vector<ArmState> sampled_states(const Robot& robot, const Evidence& evidence, double payload_kg);

/// |torque| (Nm or N) of gravity on the joint in each state, ascending.
std::vector<double> torques_by_size(const Robot& robot, const std::vector<ArmState>& states, int joint);

/// Loads and levers below this (N, Nm, m) are rounding.
inline constexpr double kNoLoad = 1e-9;

}  // namespace demecal::inline effects

#include "effects/weight_parts.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>

#include "decompositions/decompositions.hpp"
#include "effects/law_terms.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {
namespace {

constexpr int kMass = 3;
constexpr double kIndependent = 0.01;
constexpr std::array<std::string_view, 4> kNames{"mx", "my", "mz", "mass"};

/// Takes out of `column` what the orthonormal `basis` spans; twice, for rounding.
void project_off(const std::vector<Eigen::VectorXd>& basis, Eigen::VectorXd& column) {
  for (int pass = 0; pass < 2; ++pass) {
    for (const Eigen::VectorXd& direction : basis) column -= direction.dot(column) * direction;
  }
}

/// The parts of the links from `joint` on, in the order in which they are preferred.
std::vector<WeightPart> parts_beyond(const Robot& robot, int joint) {
  std::vector<WeightPart> parts;
  for (int link = joint; link < robot.chain.size(); ++link) {
    for (int axis = 0; axis < kMass; ++axis) parts.push_back({link, axis});
  }
  for (int link = joint; link < robot.chain.size(); ++link) parts.push_back({link, kMass});
  return parts;
}

/// Of which `fill` writes what each does: those that add to the ones before.
template <typename Fill>
std::vector<WeightPart> parts_told_apart(const Robot& robot, int joint, std::size_t rows, const Fill& fill) {
  std::vector<WeightPart> kept;
  std::vector<Eigen::VectorXd> basis;
  Eigen::VectorXd column(static_cast<Eigen::Index>(rows));
  for (const WeightPart& part : parts_beyond(robot, joint)) {
    fill(part, column);
    const double before = column.norm();
    if (before < kNoLoad) continue;
    project_off(basis, column);
    if (column.norm() < kIndependent * before) continue;
    basis.emplace_back(column.normalized());
    kept.push_back(part);
  }
  return kept;
}

constexpr int kDrawnStates = 64;
Interval drawn_range(const Robot& robot, const Evidence& evidence, std::size_t joint) {
  if (joint < evidence.joint_ranges.size()) return evidence.joint_ranges[joint];
  const Joint& link = robot.chain.joints[joint];
  if (!is_revolute(link)) return {link.lower, link.upper};
  return {-std::numbers::pi, std::numbers::pi};
}

}  // namespace

Eigen::Vector3d lever_moment(const ArmState& state, int joint, const WeightPart& part) {
  const double strength = state.gravity_mps2.norm();
  if (strength == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Isometry3d& place = state.places[static_cast<std::size_t>(joint)];
  const Eigen::Isometry3d& link = state.links[static_cast<std::size_t>(part.link)];
  const Eigen::Vector3d arm = part.axis == kMass ? Eigen::Vector3d(link.translation() - place.translation())
                                                 : Eigen::Vector3d(link.linear().col(part.axis));
  return place.linear().transpose() * arm.cross(state.gravity_mps2 / strength);
}

double lever(const Robot& robot, const ArmState& state, int joint, const WeightPart& part) {
  const double strength = state.gravity_mps2.norm();
  if (strength == 0.0) return 0.0;
  const Eigen::Vector3d down = state.gravity_mps2 / strength;
  const Eigen::Isometry3d& place = state.places[static_cast<std::size_t>(joint)];
  const Eigen::Isometry3d& link = state.links[static_cast<std::size_t>(part.link)];
  const bool mass = part.axis == kMass;
  const Eigen::Vector3d axis = place.linear().col(2);
  if (!is_revolute(robot.chain, joint)) return mass ? axis.dot(down) : 0.0;
  const Eigen::Vector3d arm =
      mass ? Eigen::Vector3d(link.translation() - place.translation()) : Eigen::Vector3d(link.linear().col(part.axis));
  return axis.dot(arm.cross(down));
}

std::vector<WeightPart> independent_parts(const Robot& robot, const std::vector<ArmState>& states, int joint) {
  return parts_told_apart(robot, joint, states.size(), [&](const WeightPart& part, Eigen::VectorXd& column) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      column[static_cast<Eigen::Index>(i)] = lever(robot, states[i], joint, part);
    }
  });
}

std::vector<WeightPart> tilting_parts(const Robot& robot, const std::vector<ArmState>& states, int joint) {
  return parts_told_apart(robot, joint, 2 * states.size(), [&](const WeightPart& part, Eigen::VectorXd& column) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      column.segment<2>(2 * static_cast<Eigen::Index>(i)) = lever_moment(states[i], joint, part).head<2>();
    }
  });
}

double payload_torque(const Robot& robot, const ArmState& state, int joint) {
  const Eigen::Isometry3d& place = state.places[static_cast<std::size_t>(joint)];
  const Eigen::Vector3d axis = place.linear().col(2), weight_n = state.stop.payload_kg * state.gravity_mps2;
  if (!is_revolute(robot.chain, joint)) return axis.dot(weight_n);
  return axis.dot(Eigen::Vector3d(state.payload_point_m - place.translation()).cross(weight_n));
}

std::map<std::string, double> logged_weights(const Robot& robot, const std::vector<ArmState>& states, int joint) {
  constexpr double kVaried = 1e-6;
  const std::vector<WeightPart> parts = independent_parts(robot, states, joint);
  const auto rows = static_cast<Eigen::Index>(states.size()), count = static_cast<Eigen::Index>(parts.size());
  Eigen::MatrixXd columns(rows, count + 2);
  Eigen::VectorXd gravity(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const ArmState& state = states[static_cast<std::size_t>(row)];
    if (state.stop.torque.size() == 0) return {};
    for (Eigen::Index part = 0; part < count; ++part) {
      columns(row, part) = lever(robot, state, joint, parts[static_cast<std::size_t>(part)]);
    }
    columns(row, count) = state.approach(joint);
    columns(row, count + 1) = 1.0;
    gravity[row] = -state.drive_torque(joint) - payload_torque(robot, state, joint);
  }
  if (rows == 0 || gravity.maxCoeff() - gravity.minCoeff() < kVaried) return {};
  const Eigen::VectorXd fitted = least_norm_solution(columns, gravity);
  std::map<std::string, double> weights{{"logged_friction", fitted[count]}, {"logged_zero", fitted[count + 1]}};
  for (Eigen::Index part = 0; part < count; ++part) {
    weights[std::string(kLogged) + name_of(parts[static_cast<std::size_t>(part)])] = fitted[part];
  }
  return weights;
}

double weight_torque(const std::map<std::string, double>& weights, const Robot& robot, const ArmState& state,
                     int joint) {
  double torque = 0.0;
  for (const auto& [name, value] : weights) {
    if (!name.starts_with(kLogged)) continue;
    if (const auto part = weight_part(std::string_view(name).substr(kLogged.size()))) {
      torque += value * lever(robot, state, joint, *part);
    }
  }
  return torque;
}

std::vector<WeightPart> kept_parts(const Effect& effect) {
  std::vector<WeightPart> parts;
  for (const auto& [name, value] : effect.settings) {
    if (!name.starts_with(kKeep) || value == 0.0) continue;
    if (const auto part = weight_part(std::string_view(name).substr(kKeep.size()))) parts.push_back(*part);
  }
  return parts;
}

std::array<Eigen::Vector3d, 2> turned_gravity(const Eigen::Vector3d& gravity_mps2) {
  if (gravity_mps2.isZero()) return {gravity_mps2, gravity_mps2};
  const Eigen::Vector3d down = gravity_mps2.normalized();
  const Eigen::Vector3d hint = std::abs(down.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d first = (hint - down.dot(hint) * down).normalized();
  const Eigen::Vector3d second = first.cross(down).normalized();
  return {first.cross(gravity_mps2), second.cross(gravity_mps2)};
}

std::string name_of(const WeightPart& part) {
  return std::to_string(part.link + 1) + '_' + std::string(kNames[static_cast<std::size_t>(part.axis)]);
}

std::optional<WeightPart> weight_part(std::string_view name) {
  if (name.size() < 3 || name[0] < '1' || name[0] > '9' || name[1] != '_') return std::nullopt;
  const auto* const found = std::ranges::find(kNames, name.substr(2));
  if (found == kNames.end()) return std::nullopt;
  return WeightPart{name[0] - '1', static_cast<int>(found - kNames.begin())};
}

std::vector<ArmState> sampled_states(const Robot& robot, const Evidence& evidence, double payload_kg) {
  std::vector<ArmState> states;
  states.reserve(kDrawnStates);
  for (int index = 1; index <= kDrawnStates; ++index) {
    JointVector joints(robot.chain.size());
    for (std::size_t i = 0; i < robot.chain.joints.size(); ++i) {
      const Interval range = drawn_range(robot, evidence, i);
      joints[static_cast<Eigen::Index>(i)] = range.lower + (range.upper - range.lower) * spread_share(index, i);
    }
    Stop stop(joints);
    stop.payload_kg = payload_kg;
    states.push_back(arm_state(robot, stop));
  }
  return states;
}

std::vector<double> torques_by_size(const Robot& robot, const std::vector<ArmState>& states, int joint) {
  std::vector<double> sizes;
  sizes.reserve(states.size());
  for (const ArmState& state : states) sizes.push_back(std::abs(state.torque(robot.chain, joint)));
  std::ranges::sort(sizes);
  return sizes;
}

}  // namespace demecal::inline effects

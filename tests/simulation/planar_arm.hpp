// Arms of the tests: a planar arm of two links whose every figure can be worked out by hand, and the PUMA 761.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "kinematics/units.hpp"
#include "simulation/scenario.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal {

inline constexpr double kFirstLink = 0.5, kSecondLink = 0.4;      // m
inline constexpr double kSecondMass = 3.0, kSecondCentre = 0.25;  // kg; m from joint 2 along the link
inline constexpr double kGravity = 9.81;

inline JointVector joints(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.begin());
  return q;
}

/// Two parallel axes along z; weight pulls along `down`, and only link 2 has any.
inline Robot planar_arm(const Eigen::Vector3d& down = -Eigen::Vector3d::UnitY()) {
  Robot robot;
  robot.name = "planar";
  robot.chain.joints = {{.a_m = kFirstLink, .lower = -2.0, .upper = 2.0},
                        {.a_m = kSecondLink, .lower = -2.5, .upper = 2.5}};
  robot.masses = {{0.0, Eigen::Vector3d::Zero()},
                  {kSecondMass, Eigen::Vector3d(kSecondCentre - kSecondLink, 0.0, 0.0)}};
  robot.gravity_mps2 = kGravity * down;
  return robot;
}

/// Where the planar arm's tip is, by hand.
inline Eigen::Vector3d planar_tip(double q1, double q2, double first = kFirstLink, double second = kSecondLink) {
  return {first * std::cos(q1) + second * std::cos(q1 + q2), first * std::sin(q1) + second * std::sin(q1 + q2), 0.0};
}

/// The PUMA 761 (thesis table A-1) with the tool of its section 6.1.
inline Robot puma_761() {
  constexpr double kQuarter = std::numbers::pi / 2;
  Robot robot;
  robot.name = "PUMA 761";
  robot.chain.joints = {{.alpha_rad = -kQuarter}, {.d_m = 0.191, .a_m = 0.65},
                        {.alpha_rad = kQuarter},  {.d_m = 0.6, .alpha_rad = -kQuarter},
                        {.alpha_rad = kQuarter},  {.d_m = 0.125}};
  const std::array<std::array<double, 2>, 6> limits_deg{
      {{-160, 160}, {-200, 20}, {-45, 225}, {-266, 266}, {-100, 100}, {-300, 300}}};
  for (std::size_t i = 0; i < limits_deg.size(); ++i) {
    robot.chain.joints[i].lower = radians(limits_deg[i][0]);
    robot.chain.joints[i].upper = radians(limits_deg[i][1]);
  }
  robot.chain.tool_m = {0.15025, 0.00163, 0.05569};
  return robot;
}

}  // namespace demecal

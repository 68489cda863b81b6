#include "effects/sampled_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace demecal {
namespace {

constexpr int kStates = 64;
constexpr std::array<int, kMaxJoints> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23};

/// The `index`-th number of van der Corput's sequence, in (0, 1) for index >= 1.
double radical_inverse(int index, int base) {
  double value = 0.0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

Interval range_of(const Robot& robot, const Evidence& evidence, std::size_t joint) {
  if (joint < evidence.joint_ranges.size()) return evidence.joint_ranges[joint];
  const Joint& link = robot.chain.joints[joint];
  if (link.type == JointType::prismatic) return {link.lower, link.upper};
  return {-std::numbers::pi, std::numbers::pi};
}

}  // namespace

std::vector<ArmState> sampled_states(const Robot& robot, const Evidence& evidence, double payload_kg) {
  std::vector<ArmState> states;
  states.reserve(kStates);
  for (int index = 1; index <= kStates; ++index) {
    JointVector joints(robot.chain.size());
    for (std::size_t i = 0; i < robot.chain.joints.size(); ++i) {
      const Interval range = range_of(robot, evidence, i);
      joints[static_cast<Eigen::Index>(i)] =
          range.lower + (range.upper - range.lower) * radical_inverse(index, kPrimes[i]);
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

}  // namespace demecal

#include "programs/stated_configuration.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "programs/configuration.hpp"
#include "programs/nominal_joints.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {
namespace {

std::string taken(const Chain& arm, std::size_t joint, const JointVector& nominal, const JointVector& command) {
  const Joint& link = arm.joints[joint];
  const auto index = static_cast<Eigen::Index>(joint);
  return "the correction takes " + joint_label(static_cast<int>(joint)) + " from " +
         joint_amount(link, nominal[index]) + " to " + joint_amount(link, command[index]);
}

/// What the hint says of this joint alone.
std::string words_of_joint(const ArmHint& hint, std::size_t joint) {
  if (joint < hint.quadrants.size() && hint.quadrants[joint]) {
    const int lower_deg = 90 * *hint.quadrants[joint];
    return std::to_string(lower_deg) + " .. " + std::to_string(lower_deg + 90) + " deg";
  }
  return *hint.negative[joint] ? "an angle below 0" : "an angle of 0 or more";
}

ArmHint only_of(const ArmHint& hint, std::size_t joint) {
  ArmHint one;
  one.quadrants.resize(joint + 1);
  one.negative.resize(joint + 1);
  if (joint < hint.quadrants.size()) one.quadrants[joint] = hint.quadrants[joint];
  if (joint < hint.negative.size()) one.negative[joint] = hint.negative[joint];
  return one;
}

constexpr double kRounding = 1e-6;  ///< rad

double whole_turns(double angle) {
  return std::round(angle / (2.0 * std::numbers::pi));
}

/// Whether the target says on which side the part is.
bool states_side(const ArmHint& hint, std::size_t part) {
  if (!hint.configuration.empty() || !hint.quadrants.empty() || !hint.negative.empty()) return true;
  return part < hint.parts.size() && (hint.parts[part].kept || !hint.parts[part].word.empty());
}

std::string stated_words(const ArmHint& hint, std::size_t part) {
  if (!hint.configuration.empty()) return "'" + hint.configuration + "'";
  if (part < hint.parts.size() && !hint.parts[part].word.empty()) return "'" + hint.parts[part].word + "'";
  return "its line";
}

}  // namespace

std::string leaving_stated(const Target& target, const Chain& arm, const JointVector& nominal,
                           const JointVector& command) {
  constexpr std::array<const char*, 3> kParts{"shoulder", "elbow", "wrist"};
  constexpr std::array<std::size_t, 3> kJoints{1, 2, 4};  // that take the parts to their other sides
  const std::string not_corrected = ": this line was not corrected; a point that is taught farther from there can be";
  const ArmHint& hint = target.hint;
  const std::size_t carried = target.carried.size();
  if (!target.is_pose() || hint.empty() || nominal == command) return "";
  if (target.motion == Motion::line && !hint.counts_on_lines()) return "";
  for (std::size_t joint = 0; joint < arm.joints.size(); ++joint) {
    if (contradictions(only_of(hint, joint), command) > 0)
      return taken(arm, joint, nominal, command) + ", out of the configuration that its line states, " +
             words_of_joint(hint, joint) + not_corrected;
  }
  for (std::size_t part = 0; part < kParts.size(); ++part) {
    if (states_side(hint, part) && leaves_side(arm, nominal, command, part))
      return taken(arm, carried + kJoints[part], nominal, command) + ", where the " + kParts[part] +
             " is not on the side that " + stated_words(hint, part) + " states" + not_corrected;
  }
  for (const std::size_t joint : hint.counted_turns) {
    const auto index = static_cast<Eigen::Index>(joint);
    if (joint >= arm.joints.size() || !is_revolute(arm, static_cast<int>(joint))) continue;
    const bool moved = std::abs(nominal[index] - command[index]) > kRounding;
    if (moved && whole_turns(nominal[index]) != whole_turns(command[index]))
      return taken(arm, joint, nominal, command) + ", into another turn than '" + hint.configuration + "' states" +
             not_corrected;
  }
  return "";
}

}  // namespace demecal::inline programs

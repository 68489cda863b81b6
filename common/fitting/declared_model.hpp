// What the user declares the model to contain, and the numbers in it that least squares identifies.
#pragma once

#include <string>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal {

struct DeclaredModel {
  bool registration = false;  ///< the base in the instrument's frame, 6 numbers
  bool tool = false;          ///< each target's tool point, 3 numbers; 6 where orientation was measured
  bool joint_offset = false;  ///< theta of revolute, d of prismatic joints
  bool geometry = false;  ///< d, a, alpha (theta, d with joint_offset); beta in place of d where axes are near-parallel
  bool joint_corrections = false;  ///< evolved, not fitted here
};

/// One number of the model that can be identified.
struct ParameterId {
  enum class Kind { base_translation, base_rotation, tool_translation, tool_rotation, link };
  Kind kind = Kind::link;
  int index = 0;  ///< axis 0..2 of base and tool parameters; joint (from 0) of link parameters
  LinkParameter link = LinkParameter::theta;
  std::string target;  ///< of tool parameters

  bool operator==(const ParameterId&) const = default;

  /// As reports and models write it, with unit: "base_x_mm", "tool_rz_deg", "joint 2 alpha_deg".
  std::string name() const;
  /// Whether it is an angle (rad inside, degrees at borders) or a length (m, mm).
  bool is_angle() const;
};

}  // namespace demecal

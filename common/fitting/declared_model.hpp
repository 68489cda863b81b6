// What the user declares the model to contain, and the numbers in it that least squares identifies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline fitting {

struct DeclaredModel {
  bool registration = false;  ///< the base in the instrument's frame, 6 numbers
  bool tool = false;          ///< each target's tool point, 3 numbers; 6 where orientation was measured
  bool joint_offset = false;  ///< theta of revolute, d of prismatic joints
  bool geometry = false;  ///< d, a, alpha (theta, d with joint_offset); beta in place of d where axes are near-parallel
  bool joint_corrections = false;  ///< evolved, not fitted here

  bool operator==(const DeclaredModel&) const = default;

  /// What is declared, of declared_words() and in their order.
  std::vector<std::string> words() const;
  /// Whether effects of that kind are declared already.
  bool holds(std::string_view kind) const;
};

/// What may be declared, as jobs and models call it; kinds of effects by the catalogue's word.
std::vector<std::string> declared_words();
/// The flag of one of these words; null for others.
bool DeclaredModel::*declared_flag(std::string_view word);

/// One number of the model that can be identified.
struct ParameterId {
  enum class Kind { base_translation, base_rotation, tool_translation, tool_rotation, link, effect, contact, station };
  Kind kind = Kind::link;
  int index = 0;  ///< axis 0..2 of base and tool parameters; joint (from 0) of links; which of the model's effects;
                  ///< the motion of a contact's place, or of a station's frame: three shifts and three turns
  LinkParameter link = LinkParameter::theta;
  std::string target{};                ///< of tool parameters; of a contact's or station's place, its name
  int coefficient = 0;                 ///< of an effect's parameters
  std::string effect{};                ///< what the coefficient is called, with unit: "backlash joint 2 width_rad"
  PoseSet set = PoseSet::calibration;  ///< of a contact's place: whose poses

  bool operator==(const ParameterId&) const = default;

  /// As reports and models write it, with unit: "base_x_mm", "tool_rz_deg", "joint 2 alpha_deg", "backlash
  /// joint 2 width_rad". Coefficients of effects are in SI units.
  std::string name() const;
  /// Whether it is an angle (rad inside, degrees at borders); otherwise it is a length (m, mm) or, of an effect,
  /// neither.
  bool is_angle() const;
};

}  // namespace demecal::inline fitting

// What the user declares the model to contain, and the numbers in it that least squares identifies.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline parameters {

/// What makers' link figures usually err by, a standard deviation.
inline constexpr double kMakersDeviation_m = 5e-3, kMakersDeviation_rad = 17.5e-3;

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
  bool is_of_base() const { return kind == Kind::base_translation || kind == Kind::base_rotation; }
  bool is_of_tool() const { return kind == Kind::tool_translation || kind == Kind::tool_rotation; }
};

/// A combination of parameters these poses cannot see: held where the start has it.
struct UnidentifiedDirection {
  double relative_singular = 0.0;  ///< its effect on the measurements over the largest effect
  bool weak = false;               ///< seen, but less surely than a maker's figures are known: kept near nominal
  /// Those with a share of the effect above 0.1, largest first, the whole of unit norm. The largest is positive.
  std::vector<std::pair<ParameterId, double>> parts;

  /// "joint 1 d_mm and base_z_mm have the same effect in these poses: only their combination is identified (1 : -1 by
  /// effect)"
  std::string sentence() const;
};

/// The parameters `declared` frees on this data: base, then links by joint, then tools by target. Where all is touched
/// and nothing measured by an instrument, no base, and of the first joint nothing that only says where the arm stands.
/// Geometry is, for a revolute joint, d, a, alpha, and beta in place of d on a link between near-parallel axes; for a
/// prismatic one, whose axis has a direction but no place, the two angles theta and alpha (beta and alpha on such a
/// link).
std::vector<ParameterId> free_parameters(const DataSet& data, const DeclaredModel& declared);

/// The numbers of the places that these poses touch: nobody knows them beforehand and no model keeps them, but they are
/// free wherever the poses are fitted, so that what they take is not believed of the arm.
std::vector<ParameterId> contact_parameters(const DataSet& data, std::span<const std::size_t> poses);

/// `robot` with a place for every contact among `ids`: its own, or else that of its poses on average.
CorrectedRobot with_contacts_of(CorrectedRobot robot, const std::vector<ParameterId>& ids, const DataSet& data);

/// Every coefficient of the robot's effects, by effect.
std::vector<ParameterId> effect_parameters(const CorrectedRobot& robot);

}  // namespace demecal::inline parameters

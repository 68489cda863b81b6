// The free numbers of a model as one vector: the robot at any value of it, and how its tool moves with each number.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "fitting/declared_model.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline fitting {

/// The robot at one value of the vector.
struct ModelPoint {
  CorrectedRobot robot;
  /// Column k: the turn (rad, measurements' frame) of the base per unit of its rotation parameter k.
  Eigen::Matrix3d base_turns = Eigen::Matrix3d::Identity();
  /// The same of each target's tool, in the flange frame.
  std::map<std::string, Eigen::Matrix3d> tool_turns;
  /// As the base's, of each further station's frame.
  std::map<std::string, Eigen::Matrix3d> station_turns{};
  /// Of each contact's place: the rotation vector by which it is turned, in its reference's frame.
  std::map<ContactGroup, Eigen::Vector3d> contact_turns{};
};

/// Where the tool is, and its twist (6 x parameters; linear m, angular rad; measurements' frame) per unit of each.
struct ToolMotion {
  Eigen::Isometry3d predicted = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, Eigen::Dynamic> twists;
};

/// Changes (rad, m) of a reference robot's parameters. Link parameters and translations add; rotations are rotation
/// vectors applied before the reference's: the base's in the measurements' frame about the base's origin, the tools'
/// in the flange frame about the tool point; stations' frames as the base, about the measurements' origin. Coefficients
/// of effects add too. Contacts' places move along and about their reference's axes.
class ParameterSpace {
 public:
  ParameterSpace(CorrectedRobot reference, std::vector<ParameterId> ids);

  int size() const { return static_cast<int>(ids_.size()); }
  const std::vector<ParameterId>& ids() const { return ids_; }
  const CorrectedRobot& reference() const { return reference_; }

  /// The model changed by `change` (size()).
  ModelPoint at(const Eigen::VectorXd& change) const;

  /// The tool of `target` at joints already corrected, with the motions of the robot's effects there. `motion` is
  /// overwritten; given again it is not reallocated.
  void move_tool(const ModelPoint& point, const JointVector& corrected, const std::vector<EffectMotion>& motions,
                 const std::string& target, ToolMotion& motion) const;

  /// Adds to a tool's motion, whose pose touches a contact of `group`, what moving the contact's place would have the
  /// tool seem to do.
  void move_contact(const ModelPoint& point, const ContactGroup& group, ToolMotion& motion) const;

  /// The same of a pose measured from a further station, and of moving that station's frame.
  void move_station(const ModelPoint& point, const std::string& station, ToolMotion& motion) const;

 private:
  CorrectedRobot reference_;
  std::vector<ParameterId> ids_;
  std::vector<std::vector<int>> effect_columns_;  ///< by effect and coefficient; -1 where it is not free
};

/// The value of a parameter in a robot, rad or m (an effect's coefficient: SI; 0 in a robot without that effect);
/// rotations by the components of their rotation vector.
double parameter_value(const CorrectedRobot& robot, const ParameterId& id);

/// The matrix (n x n) that takes small differences of changes to differences of parameter_value: the identity but for
/// rotations, whose vectors do not add.
Eigen::MatrixXd value_jacobian(const ParameterSpace& space, const ModelPoint& point);

}  // namespace demecal::inline fitting

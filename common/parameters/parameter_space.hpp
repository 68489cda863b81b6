// The free numbers of a model as one vector: the robot at any value of it, and how its tool moves with each number; and
// which combinations of them the poses can see, and which they cannot.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline parameters {

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
  double size = 1.0;  ///< of the arm over the reference's
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
  /// The change of ModelPoint::size with each parameter. A touch scatters in the arm's real millimetres, whatever the
  /// model takes these to be: rows of contacts are residuals over the model's size, since an arm that is smaller with
  /// all it touches would otherwise seem to touch it more closely. All zero where nothing is touched.
  const Eigen::VectorXd& size_slopes() const { return size_slopes_; }

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
  Eigen::VectorXd size_slopes_;
};

/// The value of a parameter in a robot, rad or m (an effect's coefficient: SI; 0 in a robot without that effect);
/// rotations by the components of their rotation vector.
double parameter_value(const CorrectedRobot& robot, const ParameterId& id);

/// The matrix (n x n) that takes small differences of changes to differences of parameter_value: the identity but for
/// rotations, whose vectors do not add.
Eigen::MatrixXd value_jacobian(const ParameterSpace& space, const ModelPoint& point);

/// A Jacobian's triangular factor R (n x n, R^T R = J^T J) with columns scaled to unit length, so that parameters of
/// different units compare by their effect. Columns without effect are zero, their length 1.
struct ScaledJacobian {
  explicit ScaledJacobian(const Eigen::MatrixXd& factor);

  Eigen::MatrixXd scaled;
  Eigen::VectorXd lengths;
  double largest = 0.0;  ///< singular value of `scaled`
};

/// The directions a fit may move in.
struct IdentifiableSubspace {
  /// n x rank: changes of the parameters are basis * z. On the Jacobian it was made from, J * basis is orthonormal.
  Eigen::MatrixXd basis;
  std::vector<UnidentifiedDirection> held;
};

/// Splits the parameters by the singular values of their effects: directions below `rank_tolerance` times the largest
/// are held. Of all changes with the same effect the basis holds the smallest, a change of base or tool counting next
/// to nothing and one of an effect's coefficients most: what a base or a tool can explain is not laid at a joint's
/// door, nor what a joint can at an effect's.
IdentifiableSubspace identifiable_subspace(const ScaledJacobian& jacobian, const std::vector<ParameterId>& ids,
                                           double rank_tolerance);

/// The directions that the prior knows better than the poses do: those whose variance (`covariance` of the changes,
/// n x n) is above half of what the prior (`precision`: see Prior) left open.
std::vector<UnidentifiedDirection> weak_directions(const ScaledJacobian& jacobian, const std::vector<ParameterId>& ids,
                                                   const Eigen::MatrixXd& covariance, const Eigen::VectorXd& precision);

/// Where contacts are is nobody's question: the directions of the arm's numbers alone.
void leave_out_contacts(std::vector<UnidentifiedDirection>& directions);

}  // namespace demecal::inline parameters

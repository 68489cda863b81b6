// What measured poses would tell of a model's numbers, and how far the tool would then be known: linear algebra over
// poses that are not measured yet.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"

namespace demecal::inline planning {

/// One place of the arm to be measured, from one side of every joint.
struct PlannedPose {
  JointVector joints;
  ApproachSigns approach;
  std::optional<std::size_t> socket{};  ///< which of the planned sockets is touched; none: an instrument measures
};

/// A socket where a plan puts it.
struct PlannedSocket {
  std::string name;
  Eigen::Vector3d place_m;  ///< base frame, of the nominal arm
};

/// The model that a measurement is planned for, about the nominal arm.
struct PlannedModel {
  DataSet nominal;  ///< the arm and its targets; without poses
  DeclaredModel declared;
  std::vector<Effect> effects;           ///< to be told apart beside what is declared, coefficients zero
  double noise_m = 5e-5;                 ///< of a measured position, standard deviation per axis
  double noise_rad = 1e-4;               ///< of a measured orientation, per axis
  bool orientation = false;              ///< measured
  bool by_touch = false;                 ///< sockets alone are touched: the base is no question
  std::vector<PlannedSocket> sockets{};  ///< whose places are to be found beside the rest, one calibration group each
};

/// Columns of the model's numbers in units of what is believed of them beforehand: as in a fit, links within a few mm
/// and mrad of the drawing, base and tool anywhere, effects of the size that arms have.
class InformationModel {
 public:
  explicit InformationModel(PlannedModel model);

  const std::vector<ParameterId>& ids() const { return space_.ids(); }
  const PlannedModel& model() const { return model_; }
  /// One standard deviation of each number before anything is measured, m or rad; an effect's in SI.
  const Eigen::VectorXd& beliefs() const { return beliefs_; }
  /// Rows that a pose measures, of all targets.
  int rows_per_pose() const { return rows_per_pose_; }

  /// What a pose measures by the numbers in units of belief, over the noise: rows_per_pose() x numbers.
  Eigen::MatrixXd measured_rows(const PlannedPose& pose) const;
  /// How the tool point moves (m) by the same numbers: 3 x numbers.
  Eigen::MatrixXd tool_rows(const PlannedPose& pose) const;
  /// The part of poses already measured, as data sets have them: numbers x numbers.
  Eigen::MatrixXd information_of(const DataSet& measured) const;
  /// The part of the lengths known between sockets (of the model's nominal data set).
  Eigen::MatrixXd information_of_lengths() const;

  /// The columns as a fit would see them after these poses, for fitting/parameter_space.hpp.
  ScaledJacobian jacobian(const std::vector<PlannedPose>& poses) const;

 private:
  DataSet data_of(const PlannedPose& pose) const;
  ModelPoint nominal_point() const;

  PlannedModel model_;
  ParameterSpace space_;
  Eigen::VectorXd beliefs_;
  int rows_per_pose_ = 3;
};

/// What poses measure (measured_rows), one after another.
Eigen::MatrixXd stacked_rows(const InformationModel& model, std::span<const PlannedPose> poses);

/// How far the tool's predicted position will be off, over many places.
struct PredictedError {
  double rms_m = 0.0, mean_m = 0.0, p95_m = 0.0;
};

/// The places that a plan is good for, and how the tool moves there; where sockets alone are touched, beside the motion
/// of the arm as a whole that is nearest.
class Workspace {
 public:
  Workspace(const InformationModel& model, const std::vector<PlannedPose>& places);

  /// Mean of the squared rows: the expected squared error is its product with a covariance, summed up.
  const Eigen::MatrixXd& weight() const { return weight_; }
  double square_m2(const Eigen::MatrixXd& covariance) const { return weight_.cwiseProduct(covariance).sum(); }
  /// Errors are normal with this covariance of the numbers (in units of belief).
  PredictedError predicted(const Eigen::MatrixXd& covariance) const;

 private:
  std::vector<Eigen::MatrixXd> rows_;
  Eigen::MatrixXd weight_;
};

}  // namespace demecal::inline planning

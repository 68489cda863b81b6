// How the measurements of one arm scatter together, as the residuals of a model show it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "products/tall_products.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

/// What an estimate of the noise is made from: rows before any whitening.
struct NoiseRows {
  RowMatrix columns;  ///< rows x numbers of the model
  Eigen::VectorXd residual;
  RowMatrix joint_motions;              ///< rows x revolute joints, per rad
  std::vector<Eigen::Index> first_row;  ///< of each pose, and one past the last
  std::vector<std::size_t> group;       ///< per pose: repeats of one pose have the same
  std::vector<double> order;            ///< per pose: its place in the order of measuring
  bool drift_is_rival = false;          ///< of what is asked: what neighbours share counts however little shows it
  RowMatrix even_drift{};               ///< rows x numbers that count as fitted; as a rival, it may be likelier
};

/// The components of variance of which the residuals are likeliest, the model's numbers integrated out (restricted
/// maximum likelihood; Patterson and Thompson, 1971). A component is zero where it makes the residuals hardly likelier.
/// Joints scatter by about the same, or one by far more than the others.
/// At most some 360 rows take part, in three runs of poses.
NoiseEstimate estimate_noise(const NoiseRows& rows);

/// Minus twice the restricted log-likelihood of components of variance, up to a constant, over some of the poses.
class RestrictedLikelihood {
 public:
  enum class EvenDrift { fitted, not_fitted };
  RestrictedLikelihood(const NoiseRows& rows, const std::vector<std::size_t>& poses,
                       EvenDrift drift = EvenDrift::fitted);

  Eigen::Index freedom() const { return freedom_; }
  enum Component { joints, repeats, order };
  bool has(Component component) const { return covariance_[component].size() > 0; }
  double minus_twice_log(const std::array<double, 3>& variances) const;
  /// Sum of squares per degree of freedom, the components being as they are.
  double variance_left(const std::array<double, 3>& variances) const;
  /// Mean variance of a row per rad^2 of the joints' scatter.
  double per_joint_square() const { return per_joint_square_; }
  void set_correlation(double from_pose_to_pose);
  /// What goes by the order of measuring is then any sum of some columns, in place of what neighbours share.
  void set_in_order(const Eigen::MatrixXd& columns);
  /// How much of the joints' variance each of them has; one of all at first.
  void set_joint_shares(const Eigen::VectorXd& shares);
  const Eigen::VectorXd& joint_shares() const { return joint_shares_; }
  /// The share at which one joint alone, the others having none, makes as much of the rows as all alike do.
  double share_alone(Eigen::Index joint) const { return alike_over_alone_[joint]; }
  /// The log-likelihood's slope along the logarithm of each joint's variance, and what the data tell of it (Fisher's
  /// information).
  struct Slope {
    Eigen::VectorXd slope;
    Eigen::MatrixXd information;
  };
  Slope along_joint_variances(const std::array<double, 3>& variances) const;
  /// Lag-one products of the poses' residuals over what chance would make their root mean square.
  double neighbourhood() const { return neighbourhood_; }

 private:
  void take_joints(const NoiseRows& rows, const std::vector<std::size_t>& poses);
  void take_repeats(const NoiseRows& rows, const std::vector<std::size_t>& poses);
  void take_neighbourhood();
  Eigen::MatrixXd beyond_model(const Eigen::MatrixXd& columns) const;
  Eigen::MatrixXd covariance(const std::array<double, 3>& variances) const;

  PivotedQr model_;
  Eigen::Index rows_ = 0, rank_ = 0, freedom_ = 0;
  Eigen::VectorXd left_;
  std::array<Eigen::MatrixXd, 3> covariance_;
  Eigen::MatrixXd turns_;                  ///< of each joint in turn: one column a pose
  std::vector<Eigen::MatrixXd> of_joint_;  ///< covariances that each joint alone gives, freedom x freedom
  Eigen::VectorXd joint_shares_, alike_over_alone_;
  std::vector<Eigen::Index> first_row_;
  std::vector<double> order_;
  double per_joint_square_ = 1.0, neighbourhood_ = 0.0;
};

/// The same of the residuals over the fitted poses of a model that has no noise; nothing where no pose takes part.
std::optional<NoiseEstimate> noise_shown(const DiagnosisProblem& problem, const Linearization& linearization,
                                         const DiagnosedModel& model);

/// The model with that noise and its scales of independent noise. The model as it is where its residuals scatter by
/// more than noise may: 1 mrad of a joint, 5 mm that poses share.
DiagnosedModel with_noise(DiagnosedModel model, const Linearization& linearization, const NoiseEstimate& noise);

/// The model with the noise, and the scales of independent noise, that its residuals over the fitted poses show. Poses
/// far out have no part in it. Smooth terms count whether they were chosen or not, slow ones first, as many as leave
/// enough distinct poses: what a choice among them explains by chance is not taken for less noise. So does even drift
/// where poses have times: a cause that can be named is no noise that neighbours share.
DiagnosedModel with_noise_estimated(const DiagnosisProblem& problem, DiagnosedModel model);

}  // namespace demecal::inline residuals

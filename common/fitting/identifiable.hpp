// Which combinations of parameters the poses can see, and which they cannot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/declared_model.hpp"
#include "fitting/fit.hpp"

namespace demecal::inline fitting {

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

}  // namespace demecal::inline fitting

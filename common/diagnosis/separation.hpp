// How much of a signal other columns cannot imitate, as poses are added to those at hand.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/residual_field.hpp"

namespace demecal {

/// Sums of products of the model's columns and of those asked about, over rows of unit variance.
struct Products {
  Eigen::MatrixXd model;  ///< r x r
  Eigen::MatrixXd cross;  ///< r x k
  Eigen::MatrixXd asked;  ///< k x k
};
Products products(const RowMatrix& model, const RowMatrix& asked, double weight);

class Separation {
 public:
  /// `present`: of the poses at hand, in coordinates of the model that they know to one unit (its own products are not
  /// used); `per_pose`: the mean of a further pose; `precision`: of what is believed of the asked columns'
  /// coefficients, one over their variance (k).
  Separation(const Products& present, const Products& per_pose, const Eigen::VectorXd& precision);

  /// How many columns are asked about.
  Eigen::Index columns() const { return asked_.cols(); }

  /// The sum of squares that the model and the columns `others` leave of column `signal`, at best, after `poses`
  /// further ones: its noncentrality. It never falls as poses are added.
  double information(double poses, const std::vector<Eigen::Index>& others, Eigen::Index signal) const;

  /// How many further poses tell the signal from the others by themselves, one-sided at 5 % with power 0.9, given all
  /// that the poses at hand know of model and others; nothing where `most` would not do.
  std::optional<int> poses_needed(const std::vector<Eigen::Index>& others, Eigen::Index signal, int most) const;

 private:
  Eigen::VectorXd spread_;              ///< of the model's products per pose: its eigenvalues
  Eigen::MatrixXd present_, per_pose_;  ///< cross products along them
  Eigen::MatrixXd asked_, asked_per_pose_;
};

}  // namespace demecal

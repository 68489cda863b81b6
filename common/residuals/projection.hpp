// The residual with everything already in the model projected off, on the fitted poses and on the validation poses.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

/// Of a column's square that must remain for it to count as new: less is rounding and the errors of derivatives.
inline constexpr double kNewShare = 1e-5;

/// Columns of the model over the fitted poses and over the validation ones, and what is believed of their coefficients
/// beforehand: `precision` (one over the standard deviation; 0: nothing) and `offset` (present value minus the believed
/// one).
struct ModelColumns {
  RowMatrix fitted;
  RowMatrix validation;
  Eigen::VectorXd precision;
  Eigen::VectorXd offset;
  Eigen::Index shared = 0;  ///< how many of them, the last, are errors that poses share: noise, not the model's numbers
  /// Further beliefs, of unit variance, that several columns share: what is known between contacts.
  RowMatrix known{};
  Eigen::VectorXd known_residual{};
};

/// The norm below which a column is taken to be nothing: a whole radian, metre or unit share that moves all that was
/// measured by less than its scatter.
inline constexpr double kNoColumn = 1.0;

/// An orthonormal basis of the model's columns (believed values taken as further measurements), and the least-squares
/// residuals. Adding columns keeps both up to date.
class Projection {
 public:
  Projection(const ModelColumns& model, const Eigen::VectorXd& fitted, const Eigen::VectorXd& validation);

  /// Rank of the model's columns so far.
  Eigen::Index rank() const { return rank_; }
  /// Over the fitted rows: rows x rank(), orthonormal together with the rows of the prior.
  RowsOf basis() const { return basis_.leftCols(rank_); }
  /// The same combinations of columns over the validation rows.
  RowsOf validation_basis() const { return validation_basis_.leftCols(rank_); }
  /// Residual of the fitted rows and of the validation rows.
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::VectorXd& validation_residual() const { return validation_residual_; }
  /// Least-squares changes of the coefficients of the columns it was made from.
  const Eigen::VectorXd& changes() const { return changes_; }
  /// By how much they change where the fitted rows' share along the basis is less by `along`: rank().
  Eigen::VectorXd changes_along(const Eigen::VectorXd& along) const { return to_basis_ * along; }
  /// What makes the basis of the columns it was made from: one row a column.
  const Eigen::MatrixXd& to_basis() const { return to_basis_; }
  /// Of the coefficients, in rows of unit variance.
  Eigen::MatrixXd covariance() const { return to_basis_ * to_basis_.transpose(); }
  /// Sum of squares left, prior values included, and degrees of freedom of the fitted rows.
  double squares() const { return residual_.squaredNorm() + prior_residual_.squaredNorm(); }
  double freedom() const { return freedom_; }
  /// Over the rows of the prior: what is known between contacts, then one row a column of the model it was made from,
  /// zero where nothing is believed.
  RowsOf prior_basis() const { return prior_basis_.leftCols(rank_); }
  const Eigen::VectorXd& prior_residual() const { return prior_residual_; }
  /// How many of these rows, the last, are of errors that poses share.
  Eigen::Index shared() const { return shared_; }
  /// Of the same rows: whether anything is believed.
  const std::vector<bool>& has_prior() const { return has_prior_; }

  /// What of new columns the model does not explain, rows x m each.
  struct Unexplained {
    RowMatrix fitted, validation;
    RowMatrix prior;  ///< over the rows of the prior
  };
  Unexplained unexplained(const RowMatrix& fitted, const RowMatrix& validation) const;

  /// The same with their coefficients' least-squares values and what adding them leaves of either residual.
  struct Trial : Unexplained {
    Eigen::MatrixXd to_basis{};      ///< m x rank: makes the new columns orthonormal
    Eigen::VectorXd along{};         ///< rank: the residual's share along these
    Eigen::VectorXd coefficients{};  ///< m: of the share; 0 in directions that the model explains already
    double drop = 0.0;               ///< decrease of the sum of squares
    Eigen::Index rank = 0;           ///< directions that the model does not explain
    Eigen::VectorXd validation_residual{};

    /// The new columns over the fitted rows, as add() puts them beside the basis: rows x rank.
    RowMatrix columns() const { return fitted * to_basis; }
  };
  Trial trial(const RowMatrix& fitted, const RowMatrix& validation) const;
  /// Takes a trial's columns into the model.
  void add(const Trial& trial);

 private:
  RowMatrix basis_, validation_basis_, prior_basis_;  ///< beyond the first rank_ columns: room for further ones
  Eigen::Index rank_ = 0;
  double freedom_ = 0.0;
  Eigen::MatrixXd to_basis_;  ///< of the columns it was made from
  Eigen::VectorXd residual_, validation_residual_, prior_residual_, changes_;
  std::vector<bool> has_prior_;
  Eigen::Index shared_;
};

}  // namespace demecal::inline residuals

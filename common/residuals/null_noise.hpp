// Draws of what noise alone would have left of the rows of a field.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

#include "fitting/tall_products.hpp"
#include "random/random_stream.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

/// Draws rows as if nothing but the noise had been measured. The whitened residual of a pose keeps its length, which
/// goes to any pose with as many rows, and takes any direction (a rotation test by poses, after Langsrud, 2005, that
/// keeps heavy tails); what is believed of the model's numbers, and what poses share, is drawn as large as it was
/// found.
class NullNoise {
 public:
  NullNoise(const ResidualField& field, const Projection& model);

  /// Before the model is fitted to them; a column each.
  struct Draws {
    RowMatrix fitted, beliefs;
  };
  Draws draw(Eigen::Index count, RandomStream& random) const;
  /// What the model leaves, in `rows` of the field, of `count` draws, each of the residual's sum of squares (all rows
  /// and beliefs included): rows x count.
  Eigen::MatrixXd residuals(Eigen::Index count, const std::vector<Eigen::Index>& rows, RandomStream& random) const;

 private:
  friend class NullResiduals;
  Eigen::VectorXd draw_fitted(RandomStream& random) const;
  Eigen::VectorXd draw_beliefs(RandomStream& random) const;

  const ResidualField& field_;
  const Projection& model_;
  std::map<Eigen::Index, std::vector<double>> lengths_;  ///< of poses by their number of rows
  Eigen::VectorXd belief_deviations_;                    ///< one per row of beliefs
};

/// What the model leaves of such draws in some of the poses. What the others tell of the model's numbers is drawn as
/// one normal vector where there are many of them (central limit theorem).
class NullResiduals {
 public:
  /// `poses` of the field, by number, ascending. Keeps the noise by reference.
  NullResiduals(const NullNoise& noise, const std::vector<std::size_t>& poses);

  /// The field's rows of the poses, one pose after another.
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  /// As NullNoise::residuals: rows() x count.
  Eigen::MatrixXd draw(Eigen::Index count, RandomStream& random) const;

 private:
  Eigen::VectorXd draw_rows(RandomStream& random) const;
  RowMatrix told_by_others() const;

  const NullNoise& noise_;
  std::vector<std::size_t> poses_;
  std::vector<Eigen::Index> rows_;
  RowMatrix basis_;              ///< its rows
  Eigen::MatrixXd others_root_;  ///< of the covariance of what the other poses tell; of no size: all rows are drawn
  double squares_ = 0.0;         ///< of all fitted rows of a draw
};

}  // namespace demecal::inline residuals

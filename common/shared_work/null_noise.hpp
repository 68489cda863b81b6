// Draws of what noise alone would have left of measured rows, from plain numbers.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

#include "products/tall_products.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline shared_work {

/// Rows as if nothing but the noise had been measured. The whitened residual of a pose keeps its length, which goes to
/// any pose with as many rows, and takes any direction (a rotation test by poses, after Langsrud, 2005, that keeps
/// heavy tails); what is believed of the model's numbers, and what poses share, is drawn as large as it was found.
struct NullNoise {
  std::vector<Eigen::Index> first_row;                  ///< of each pose, and one past the last: poses + 1
  std::vector<bool> silent;                             ///< per pose: it has no weight, and its rows are 0
  std::map<Eigen::Index, std::vector<double>> lengths;  ///< of the poses that have weight, by their number of rows
  Eigen::VectorXd belief_deviations;                    ///< one per row of beliefs
  std::vector<bool> believed;                           ///< of the same rows: whether anything is

  std::size_t poses() const { return silent.size(); }
  Eigen::Index rows() const { return first_row.back(); }
  Eigen::Index rows_of_pose(std::size_t pose) const { return first_row[pose + 1] - first_row[pose]; }
  /// The sum of squares of all rows of a draw.
  double squares() const;

  /// Before the model is fitted to them; a column each.
  struct Draws {
    RowMatrix fitted, beliefs;
  };
  Draws draw(Eigen::Index count, RandomStream& random) const;
  /// The rows of some poses alone, one pose after another.
  Eigen::VectorXd draw_poses(const std::vector<std::size_t>& drawn_poses, RandomStream& random) const;
  Eigen::VectorXd draw_beliefs(RandomStream& random) const;
};

/// What a model leaves of such draws in some of the poses. What the others tell of the model's numbers is drawn as one
/// normal vector where there are many of them (central limit theorem).
struct NullResiduals {
  NullNoise noise;
  std::vector<std::size_t> poses;  ///< by number, ascending
  RowMatrix basis;        ///< of the model, orthonormal with `prior_basis`: all rows, or those of the poses where the
                          ///< others are drawn as one
  RowMatrix prior_basis;  ///< over the rows of beliefs
  Eigen::MatrixXd others_root;  ///< of the covariance of what the other poses tell; of no size: all rows are drawn
  double model_squares = 0.0;   ///< of the measured residual, beliefs included: what a draw's are scaled to

  /// Which rows of the draws the poses have, one pose after another.
  std::vector<Eigen::Index> rows() const;
  /// rows() x count.
  Eigen::MatrixXd draw(Eigen::Index count, RandomStream& random) const;

 private:
  Eigen::MatrixXd draw_all(Eigen::Index count, RandomStream& random) const;
};

}  // namespace demecal::inline shared_work

// What noise does to the rows of a field: errors that several poses share, and draws of what noise alone would leave.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "fitting/tall_products.hpp"
#include "random/random_stream.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

/// Columns of unit variance each: random effects, marginalised where they are believed to be zero within one.
struct SharedErrors {
  RowMatrix fitted, validation;
};

/// The part of noise.order^2 that the functions of shared_errors() for poses at `places` in the order of measuring do
/// not follow, as NoiseModel::fast has it.
double unfollowed_variance(const NoiseModel& noise, std::span<const std::size_t> places);

/// What repeats of one pose have in common, and what drifts in the order of measuring, of the components that `noise`
/// has; `validation` poses share it with `fitted` ones. The order of measuring is that of the data set. Drift is
/// followed through at most 120 of the fitted poses; of more than 200 repeated poses the error is not modelled.
SharedErrors shared_errors(const NoiseModel& noise, const ResidualField& fitted, const ResidualField& validation);

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
  Eigen::VectorXd draw_fitted(RandomStream& random) const;
  Eigen::VectorXd draw_beliefs(RandomStream& random) const;

  const ResidualField& field_;
  const Projection& model_;
  std::map<Eigen::Index, std::vector<double>> lengths_;  ///< of poses by their number of rows
  Eigen::VectorXd belief_deviations_;                    ///< one per row of beliefs
};

}  // namespace demecal::inline residuals

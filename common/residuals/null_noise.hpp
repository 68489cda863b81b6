// What noise alone would leave of the rows: the null hypothesis of every test of the closed loop.
#pragma once

#include <map>

#include "random/random_stream.hpp"
#include "residuals/projection.hpp"

namespace demecal {

/// Draws rows as if nothing but the noise had been measured. The whitened residual of a pose keeps its length, which
/// goes to any pose with as many rows, and takes any direction (a rotation test by poses, after Langsrud, 2005, that
/// keeps heavy tails); what is believed of the model's numbers, and what poses share, is drawn as large as it was
/// found.
class NullNoise {
 public:
  NullNoise(const ResidualField& field, const Projection& model);

  /// Before the model is fitted to it.
  struct Rows {
    Eigen::VectorXd fitted, beliefs;
  };
  Rows draw(RandomStream& random) const;
  /// What the model leaves of a draw's rows, of the residual's sum of squares (beliefs included).
  Eigen::VectorXd left(RandomStream& random) const;

 private:
  const ResidualField& field_;
  const Projection& model_;
  std::map<Eigen::Index, std::vector<double>> lengths_;  ///< of poses by their number of rows
  Eigen::VectorXd belief_deviations_;                    ///< one per row of beliefs
};

}  // namespace demecal

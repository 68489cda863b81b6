// How much of the residual each candidate effect would explain, and how much the best one would by noise alone.
#pragma once

#include <cstdint>
#include <vector>

#include "random/random_stream.hpp"
#include "residuals/effect_columns.hpp"
#include "residuals/projection.hpp"

namespace demecal {

/// One candidate against the residual.
struct Score {
  double drop = 0.0;        ///< decrease of the sum of squares
  Eigen::Index rank = 0;    ///< directions that the model does not have
  double gain_nats = 0.0;   ///< description length saved: likelihood won, less the price of coefficients and name
  Eigen::VectorXd visible;  ///< per coefficient: the squared length of its column beyond the model
};

/// All candidates' projections off one model. Building it costs one pass over the candidates' columns.
class Scan {
 public:
  /// `naming_cost_nats`: per candidate, the price of naming it (log of the number of its like).
  Scan(const EffectColumns& columns, const std::vector<double>& naming_cost_nats, const ResidualField& field,
       const Projection& model);

  /// Brings the scan up to date with a model to which columns were added (as `added` says, from column `from` on).
  void follow(const EffectColumns& columns, const ResidualField& field, const Projection& model);

  /// One score per candidate.
  std::vector<Score> scores() const;

  /// Per candidate, the cosine between a direction and the candidate's columns beyond the model. The direction lies
  /// beyond the model too; `products`: columns^T direction; `square`: its squared length.
  std::vector<double> cosines(const Eigen::MatrixXd& products, double square) const;

  /// The largest gain_nats of any candidate, ascending, over `count` draws of independent noise in place of the
  /// whitened residual, fitted by the model: a rotation test (Langsrud, 2005).
  std::vector<double> null_maxima(const EffectColumns& columns, const ResidualField& field, const Projection& model,
                                  int count, RandomStream random) const;

 private:
  struct Gram {
    Eigen::MatrixXd inverse;  ///< pseudo-inverse over new directions
    Eigen::Index rank = 0;
    Eigen::VectorXd visible;
  };
  double gain_nats(double drop, double squares, Eigen::Index rank, std::size_t candidate) const;
  double best_fall(const Eigen::VectorXd& moments, double squares) const;
  void invert(const std::vector<ColumnSpan>& spans);

  std::vector<ColumnSpan> spans_;
  std::vector<double> name_nats_;
  std::vector<Eigen::MatrixXd> whole_;  ///< X^T X per candidate
  Eigen::MatrixXd along_;               ///< X^T basis: columns x rank
  std::vector<Gram> grams_;
  Eigen::VectorXd moment_;  ///< X^T residual
  double squares_ = 0.0;
  double rows_ = 0.0;
  double poses_ = 0.0;
};

}  // namespace demecal

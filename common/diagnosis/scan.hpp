// How much of the residual each candidate would explain, how much the best would by noise alone, and which explain the
// same.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effects/effect.hpp"
#include "next_measurement/next_measurement.hpp"
#include "random/random_stream.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/gain_draws.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline diagnosis {

/// One candidate against the residual.
struct Score {
  double drop = 0.0;        ///< decrease of the sum of squares
  Eigen::Index rank = 0;    ///< directions that the model does not have
  double gain_nats = 0.0;   ///< description length saved: likelihood won, less the price of coefficients and name
  Eigen::VectorXd visible;  ///< per coefficient: the squared length of its column beyond the model
};

/// Some numbers of a model, beyond all its others: orthonormal directions of its basis (rank x k), and what they
/// explain along these (k).
struct ModelPart {
  Eigen::MatrixXd directions;
  Eigen::VectorXd explained;
};

/// `to_basis`: the numbers' rows of Projection::to_basis(). Combinations of them that the others explain are left out.
ModelPart part_of_model(const Eigen::MatrixXd& to_basis, const Eigen::VectorXd& values);

/// All candidates' projections off one model. Building it costs one pass over the candidates' columns.
class Scan {
 public:
  /// `naming_costs_nats`: per candidate, the price of naming it (log of the number of its like).
  /// `do_work` makes the products of the candidates' columns with the model and its residual.
  Scan(const EffectColumns& columns, const std::vector<double>& naming_costs_nats, const ResidualField& field,
       const Projection& model, const DoWork& do_work = demecal::do_work);

  /// Brings the scan up to date with a model that took a trial in. `products`: columns^T the trial's new ones.
  void follow(const Eigen::MatrixXd& products, const Projection::Trial& trial, const Projection& model);

  /// Of all candidates' columns, their share along the model's basis: columns x rank.
  const Eigen::MatrixXd& along() const { return along_; }
  /// One score per candidate.
  std::vector<Score> scores() const;

  /// Per candidate, the cosine between a direction and the candidate's columns beyond the model. The direction lies
  /// beyond the model too; `products`: columns^T direction; `square`: its squared length.
  std::vector<double> cosines(const Eigen::MatrixXd& products, double square) const;

  /// Per candidate, with a part of the model taken out: the cosine with what the part explains, and gain_nats.
  struct InPlace {
    std::vector<double> cosines, gains_nats;
  };
  InPlace in_place_of(const ModelPart& part) const;
  /// Description length that the part saves, its name at that price.
  double gain_nats(const ModelPart& part, double naming_cost_nats) const;

  /// The largest gain_nats of any candidate, ascending, over `count` draws of the noise in place of the
  /// whitened residual, fitted by the model: a rotation test (Langsrud, 2005). `make` makes the draws.
  std::vector<double> null_maxima(const EffectColumns& columns, const ResidualField& field, const Projection& model,
                                  int count, RandomStream random, const DoWork& make = do_work) const;

 private:
  struct Gram {
    Eigen::MatrixXd inverse;  ///< pseudo-inverse over new directions
    Eigen::Index rank = 0;
    Eigen::VectorXd visible;
  };
  static Gram inverted(const Eigen::MatrixXd& left, const Eigen::VectorXd& lengths);
  void invert();

  std::vector<ColumnSpan> spans_;
  std::vector<double> naming_costs_nats_;
  std::vector<Eigen::MatrixXd> whole_;  ///< X^T X per candidate
  Eigen::MatrixXd along_;               ///< X^T basis: columns x rank
  std::vector<Gram> grams_;
  Eigen::VectorXd moment_;  ///< X^T residual
  double squares_ = 0.0;
  GainPrices prices_;
};

/// Whether another effect is a rival of the one named: the cosine with it is above 0.9, or the description's length
/// within 5 nats at a cosine above one half. Formulas outside the catalogue are rivals only of each other.
bool is_rival(const Effect& named, const Effect& other, double cosine, double nats_behind);
/// Nearest first, at most eight.
void keep_nearest(std::vector<Rival>& rivals);

/// Rivals of `named`. The cosine is between what it explains beyond the model and the best that the rival can make of
/// it. `products`: all candidates' columns^T the new ones of `explained`.
std::vector<Rival> rivals_of(std::size_t named, const Projection::Trial& explained, const Eigen::MatrixXd& products,
                             const std::vector<Candidate>& all, const std::vector<Score>& scores, const Scan& scan);

/// The same of an effect that the model holds, beside all others of it; `part` is what its numbers are of the model,
/// and `scan` of candidates beyond the whole model.
std::vector<Rival> rivals_of_held(const Effect& held, const ModelPart& part, const std::vector<Candidate>& all,
                                  const Scan& scan);

/// Takes other forms of an effect, which are no rivals of it, out of its round.
void exclude_own_forms(std::vector<Round>& rounds);

}  // namespace demecal::inline diagnosis

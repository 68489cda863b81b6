// What the best of all candidates would explain of noise alone: the null distribution of a scan.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shared_work/feature_blocks.hpp"
#include "shared_work/null_noise.hpp"
#include "shared_work/random_draws.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {

/// How the description's length falls by what columns explain (nats).
struct GainPrices {
  double rows = 0.0;   ///< measured numbers
  double poses = 0.0;  ///< distinct ones

  /// `drop` of `squares` is explained along `rank` directions, whose name costs so much.
  double gain_nats(double drop, double squares, Eigen::Index rank, double naming_cost_nats) const;
};

/// One candidate beyond the model: its columns' place among all, the pseudo-inverse of their Gram matrix, and its rank.
struct GainCandidate {
  Eigen::Index first = 0;
  Eigen::Index rank = 0;
  double naming_cost_nats = 0.0;
  Eigen::MatrixXd inverse;
};

/// In single precision, which is enough for a null distribution and twice as fast.
class GainDraws final : public RandomDraws {
 public:
  /// `basis`, `prior_basis` and `along`: of the model, over rows, beliefs and all candidates' columns.
  struct Parts {
    NullNoise noise;
    RowMatrixF basis, prior_basis;
    Eigen::MatrixXf along;
    std::vector<GainCandidate> candidates;
    GainPrices prices;
  };
  /// Keeps blocks and motions by reference.
  GainDraws(Parts parts, const std::vector<FeatureBlock>& blocks, const RowMatrix& motions, const DrawCount& count);
  static std::unique_ptr<SharedWork> read(WorkReader& reader);

  /// The largest gain of any candidate, nats.
  std::vector<double> piece(std::size_t number) const override;
  std::uint32_t numbers_of_draw() const override { return 1; }
  WorkInputs inputs() const override;

 private:
  double best_gain(const Eigen::VectorXd& moments, double squares) const;

  Parts parts_;
  const std::vector<FeatureBlock>& blocks_;
  const RowMatrix& motions_;
};

}  // namespace demecal::inline shared_work

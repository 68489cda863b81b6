#include "shared_work/gain_draws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "random/random_stream.hpp"

namespace demecal::inline shared_work {
namespace {

/// Of numbers that came from elsewhere: the same with what it refers to.
class ReceivedGainDraws final : public SharedWork {
 public:
  ReceivedGainDraws(GainDraws::Parts parts, ReceivedBlocks received, const DrawCount& count)
      : received_(std::move(received)), work_(std::move(parts), received_.blocks, received_.motions, count) {}

  std::size_t pieces() const override { return work_.pieces(); }
  std::uint32_t numbers_of_piece(std::size_t number) const override { return work_.numbers_of_piece(number); }
  std::vector<double> piece(std::size_t number) const override { return work_.piece(number); }
  WorkInputs inputs() const override { return work_.inputs(); }

 private:
  ReceivedBlocks received_;
  GainDraws work_;
};

}  // namespace

double GainPrices::gain_nats(double drop, double squares, Eigen::Index rank, double naming_cost_nats) const {
  if (rank == 0) return 0.0;
  const double share = std::min(drop / squares, 1.0 - 1e-12);
  return -0.5 * rows * std::log1p(-share) - 0.5 * static_cast<double>(rank) * std::log(poses) - naming_cost_nats;
}

GainDraws::GainDraws(Parts parts, const std::vector<FeatureBlock>& blocks, const RowMatrix& motions,
                     const DrawCount& count)
    : RandomDraws(count), parts_(std::move(parts)), blocks_(blocks), motions_(motions) {}

std::vector<double> GainDraws::piece(std::size_t number) const {
  RandomStream random = random_of_piece(number);
  const NullNoise::Draws draws = parts_.noise.draw(static_cast<Eigen::Index>(draws_of_piece(number)), random);
  const RowMatrixF rows = draws.fitted.cast<float>(), beliefs = draws.beliefs.cast<float>();
  const Eigen::MatrixXf explained = parts_.basis.transpose() * rows + parts_.prior_basis.transpose() * beliefs;
  const Eigen::MatrixXd moments =
      (transposed_times(blocks_, parts_.noise.first_row, motions_, parts_.along.rows(), rows) -
       parts_.along * explained)
          .cast<double>();
  const Eigen::VectorXd squares =
      (rows.colwise().squaredNorm() + beliefs.colwise().squaredNorm() - explained.colwise().squaredNorm())
          .transpose()
          .cast<double>();
  std::vector<double> gains;
  for (Eigen::Index draw = 0; draw < squares.size(); ++draw)
    gains.push_back(best_gain(moments.col(draw), squares[draw]));
  return gains;
}

double GainDraws::best_gain(const Eigen::VectorXd& moments, double squares) const {
  double best = -std::numeric_limits<double>::infinity();
  for (const GainCandidate& one : parts_.candidates) {
    if (one.rank == 0) continue;
    const auto moment = moments.segment(one.first, one.inverse.rows());
    best = std::max(best,
                    parts_.prices.gain_nats(moment.dot(one.inverse * moment), squares, one.rank, one.naming_cost_nats));
  }
  return best;
}

/// Of motions the columns that blocks are of.
WorkInputs GainDraws::inputs() const {
  WorkInputs inputs = counted_inputs(WorkKind::gains);
  append(parts_.noise, inputs);
  std::vector<std::uint32_t> firsts, widths, ranks;
  WorkTable costs{static_cast<std::uint32_t>(parts_.candidates.size()), {}};
  for (const GainCandidate& one : parts_.candidates) {
    firsts.push_back(static_cast<std::uint32_t>(one.first));
    widths.push_back(static_cast<std::uint32_t>(one.inverse.rows()));
    ranks.push_back(static_cast<std::uint32_t>(one.rank));
    costs.numbers.push_back(one.naming_cost_nats);
  }
  inputs.lists.insert(inputs.lists.end(), {firsts, widths, ranks});
  inputs.tables.push_back(table_of(parts_.basis));
  inputs.tables.push_back(table_of(parts_.prior_basis));
  inputs.tables.push_back(table_of(parts_.along));
  inputs.tables.push_back(costs);
  inputs.tables.push_back({2, {parts_.prices.rows, parts_.prices.poses}});
  for (const GainCandidate& one : parts_.candidates) inputs.tables.push_back(table_of(one.inverse));
  append(blocks_, motions_, inputs);
  return inputs;
}

std::unique_ptr<SharedWork> GainDraws::read(WorkReader& reader) {
  const DrawCount count = read_draw_count(reader);
  Parts parts{read_noise(reader), {}, {}, {}, {}, {}};
  const Eigen::Index rows = parts.noise.rows();
  const auto& firsts = reader.list(kMostColumnsOfWork);
  const auto& widths = reader.list(kMostColumnsOfWork, firsts.size());
  const auto& ranks = reader.list(kMostColumnsOfWork, firsts.size());
  parts.basis = reader.table(rows).cast<float>();
  parts.prior_basis = reader.table(parts.noise.belief_deviations.size(), parts.basis.cols()).cast<float>();
  const Eigen::Index columns = reader.rows_of_next_table();
  WorkReader::require(columns <= static_cast<Eigen::Index>(kMostColumnsOfWork), "too many columns");
  parts.along = reader.table(columns, parts.basis.cols()).cast<float>();
  const Eigen::MatrixXd costs = reader.table(static_cast<Eigen::Index>(firsts.size()), 1), prices = reader.table(2, 1);
  parts.prices = {prices(0, 0), prices(1, 0)};
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(firsts[i]), width = static_cast<Eigen::Index>(widths[i]);
    WorkReader::require(first + width <= columns, "a candidate whose columns exceed the matrix");
    parts.candidates.push_back({first, static_cast<Eigen::Index>(ranks[i]), costs(static_cast<Eigen::Index>(i), 0),
                                reader.table(width, width)});
  }
  ReceivedBlocks received = read_blocks(reader, static_cast<std::size_t>(columns), parts.noise.first_row);
  return std::make_unique<ReceivedGainDraws>(std::move(parts), std::move(received), count);
}

}  // namespace demecal::inline shared_work

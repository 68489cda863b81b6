#include "draws/gain_draws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "random/random_stream.hpp"

namespace demecal::inline draws {
namespace {

constexpr std::size_t kMostDrawnColumns = 100'000;

/// Of numbers that came from elsewhere: the same with what it refers to.
class ReceivedGainDraws final : public DrawWork {
 public:
  ReceivedGainDraws(GainDraws::Parts parts, std::vector<FeatureBlock> blocks, RowMatrix motions,
                    const DrawInputs& inputs)
      : DrawWork(inputs.draws, inputs.stream),
        blocks_(std::move(blocks)),
        motions_(std::move(motions)),
        work_(std::move(parts), blocks_, motions_, inputs.draws, inputs.stream) {}

  std::vector<double> piece(std::size_t number) const override { return work_.piece(number); }
  std::uint32_t numbers_of_draw() const override { return work_.numbers_of_draw(); }
  DrawInputs inputs() const override { return work_.inputs(); }

 private:
  std::vector<FeatureBlock> blocks_;
  RowMatrix motions_;
  GainDraws work_;
};

}  // namespace

double GainPrices::gain_nats(double drop, double squares, Eigen::Index rank, double naming_cost_nats) const {
  if (rank == 0) return 0.0;
  const double share = std::min(drop / squares, 1.0 - 1e-12);
  return -0.5 * rows * std::log1p(-share) - 0.5 * static_cast<double>(rank) * std::log(poses) - naming_cost_nats;
}

GainDraws::GainDraws(Parts parts, const std::vector<FeatureBlock>& blocks, const RowMatrix& motions,
                     std::uint32_t draws, std::uint64_t stream)
    : DrawWork(draws, stream), parts_(std::move(parts)), blocks_(blocks), motions_(motions) {}

std::vector<double> GainDraws::piece(std::size_t number) const {
  RandomStream random{stream(), number};
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
DrawInputs GainDraws::inputs() const {
  DrawInputs inputs{DrawKind::gains, draws(), numbers_of_draw(), stream(), {}, {}};
  append(parts_.noise, inputs);
  std::vector<std::uint32_t> firsts, widths, ranks;
  DrawTable costs{static_cast<std::uint32_t>(parts_.candidates.size()), {}};
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
  for (const FeatureBlock& block : blocks_) {
    inputs.lists.push_back(list_of(block.columns));
    inputs.tables.push_back(table_of(motions_.col(block.motion)));
    inputs.tables.push_back(table_of(block.features));
  }
  return inputs;
}

std::unique_ptr<DrawWork> GainDraws::read(const DrawInputs& inputs, DrawReader& reader) {
  Parts parts{read_noise(reader), {}, {}, {}, {}, {}};
  const Eigen::Index rows = parts.noise.rows(), poses = static_cast<Eigen::Index>(parts.noise.poses());
  const auto& firsts = reader.list(kMostDrawnColumns);
  const auto& widths = reader.list(kMostDrawnColumns, firsts.size());
  const auto& ranks = reader.list(kMostDrawnColumns, firsts.size());
  parts.basis = reader.table(rows).cast<float>();
  parts.prior_basis = reader.table(parts.noise.belief_deviations.size(), parts.basis.cols()).cast<float>();
  const Eigen::Index columns = reader.rows_of_next_table();
  DrawReader::require(columns <= static_cast<Eigen::Index>(kMostDrawnColumns), "too many columns");
  parts.along = reader.table(columns, parts.basis.cols()).cast<float>();
  const Eigen::MatrixXd costs = reader.table(static_cast<Eigen::Index>(firsts.size()), 1), prices = reader.table(2, 1);
  parts.prices = {prices(0, 0), prices(1, 0)};
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(firsts[i]), width = static_cast<Eigen::Index>(widths[i]);
    DrawReader::require(first + width <= columns, "a candidate whose columns exceed the matrix");
    parts.candidates.push_back({first, static_cast<Eigen::Index>(ranks[i]), costs(static_cast<Eigen::Index>(i), 0),
                                reader.table(width, width)});
  }
  // Before memory is claimed for motions: each block has a list and two tables, of which one is as long as the rows.
  constexpr std::size_t kMostMotions = 8'000'000;
  DrawReader::require(reader.tables_left() == 2 * reader.lists_left() &&
                          reader.lists_left() <= kMostMotions / static_cast<std::size_t>(rows),
                      "blocks without their tables, or too many");
  std::vector<FeatureBlock> blocks;
  RowMatrix motions(rows, static_cast<Eigen::Index>(reader.lists_left()));
  while (reader.lists_left() > 0) {
    const auto& own = reader.ascending(static_cast<std::size_t>(columns));
    const auto number = static_cast<Eigen::Index>(blocks.size());
    motions.col(number) = reader.table(rows, 1);
    blocks.push_back({number, {own.begin(), own.end()}, reader.table(poses, static_cast<Eigen::Index>(own.size()))});
  }
  return std::make_unique<ReceivedGainDraws>(std::move(parts), std::move(blocks), std::move(motions), inputs);
}

}  // namespace demecal::inline draws

#include "evolution/model_archive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "errors/check.hpp"
#include "expression/node_store.hpp"
#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline evolution {

double description_length_nats(const Tree& tree, double square, double rows) {
  double nats = 0.5 * rows * std::log(square);
  for (const Node& node : tree) nats += node.primitive == Primitive::constant ? 1.0 + 0.5 * std::log(rows) : 1.0;
  return nats;
}

Tree FormulaRefiner::fitted(const Tree& simple) {
  NodeStore store;
  return demecal::simplified(store.tree(fit_.by_squares(store, store.enter(simple)).root));
}

namespace {

constexpr double kWorthKeeping = 4.0;  // times the least mean square

void append_rows(std::vector<double>& column, const std::vector<double>& more) {
  column.insert(column.end(), more.begin(), more.end());
}

TrainingTable stacked_tables(TrainingTable rows, const TrainingTable& more) {
  DEMECAL_CHECK(rows.variables.size() == more.variables.size(), rows.variables.size() << ", " << more.variables.size());
  for (std::size_t i = 0; i < rows.variables.size(); ++i) append_rows(rows.variables[i], more.variables[i]);
  append_rows(rows.target, more.target);
  append_rows(rows.weight, more.weight);
  return rows;
}

}  // namespace

ModelArchive::ModelArchive(const TrainingTable& training, const TrainingTable& validation,
                           const GpParameters& parameters)
    : brief_(training, parameters),
      rows_(stacked_tables(training, validation)),
      weights_(std::accumulate(rows_.weight.begin(), rows_.weight.end(), 0.0)),
      evaluate_(rows_.variables) {}

double ModelArchive::mean_square(const Tree& tree) {
  const std::span<const double> values = evaluate_(tree);
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = rows_.target[i] - values[i];
    sum += rows_.weight[i] * error * error;
  }
  return sum / weights_;
}

double ModelArchive::offer(const Tree& tree) {
  const double square = mean_square(tree);
  front_.offer({tree, square});
  return square;
}

void ModelArchive::offer(const Population& front) {
  std::vector<std::pair<std::size_t, double>> offered;
  for (const Individual& member : front) {
    offered.emplace_back(member.tree.size(), member.fitness);
    if (std::binary_search(last_.begin(), last_.end(), offered.back())) continue;
    const Tree tree = brief_.simplified(member.tree);
    const double square = offer(tree);
    if (front_.members().empty() || square > kWorthKeeping * front_.members().back().fitness) continue;
    offer(brief_.fitted(tree));
  }
  last_ = std::move(offered);
}

const Individual* ModelArchive::chosen() const {
  const Population& members = front_.members();
  const auto nats = [this](const Individual& one) { return description_length_nats(one.tree, one.fitness, weights_); };
  const auto briefest = std::min_element(members.begin(), members.end(),
                                         [&](const Individual& a, const Individual& b) { return nats(a) < nats(b); });
  return briefest == members.end() ? nullptr : &*briefest;
}

}  // namespace demecal::inline evolution

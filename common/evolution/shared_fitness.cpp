#include "evolution/shared_fitness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace demecal {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SharedFitness::SharedFitness(const TrainingTable& table, std::size_t budget_bytes)
    : errors_(table.target, table.weight, table.loss), evaluator_(table.variables, budget_bytes) {
  check_columns(table);
}

void SharedFitness::bind(const NodeStore& store, std::span<const NodeId> roots) {
  known_.resize(store.end(), kUnknown);
  asked_.clear();
  for (const NodeId root : roots) {
    if (!std::isnan(known_[root])) continue;
    asked_.push_back(root);
    known_[root] = 0.0;
  }
  evaluator_.bind(store, asked_);
}

void SharedFitness::run() {
  if (sums_.size() < asked_.size()) sums_.resize(asked_.size());
  std::fill(sums_.begin(), sums_.end(), ErrorSum::Lanes{});
  evaluator_.run([this](std::size_t i, std::size_t begin, const double* values, std::size_t rows) {
    errors_.add(sums_[i], begin, values, rows);
  });
  for (std::size_t i = 0; i < asked_.size(); ++i) known_[asked_[i]] = ErrorSum::total(sums_[i]);
}

void SharedFitness::forget(std::span<const NodeId> dropped) {
  for (const NodeId id : dropped)
    if (id < known_.size()) known_[id] = kUnknown;
  evaluator_.forget(dropped);
}

}  // namespace demecal

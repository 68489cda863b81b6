#include "fitness/fitness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors/check.hpp"

namespace demecal::inline fitness {

void check_columns(const TrainingTable& table) {
  DEMECAL_CHECK(!table.variables.empty() && table.weight.size() == table.target.size(),
                "variables=" << table.variables.size() << " weights=" << table.weight.size()
                             << " targets=" << table.target.size());
  DEMECAL_CHECK(table.variables.size() == 1 || std::isinf(table.limit), "limit=" << table.limit);
  for (const auto& column : table.variables)
    DEMECAL_CHECK(column.size() == table.target.size(), column.size() << " rows of " << table.target.size());
}

Fitness::Fitness(const TrainingTable& table)
    : errors_(table.target, table.weight, table.loss), evaluate_(table.variables) {
  check_columns(table);
}

double Fitness::operator()(const Tree& tree) {
  const std::span<const double> values = evaluate_.padded_values(tree);
  ErrorSum::Lanes sums{};
  errors_.add(sums, 0, values.data(), values.size());
  return ErrorSum::total(sums);
}

namespace {

constexpr double kNotEvaluated = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SharedFitness::SharedFitness(const TrainingTable& table, std::size_t budget_bytes)
    : errors_(table.target, table.weight, table.loss), evaluator_(table.variables, budget_bytes) {
  check_columns(table);
}

void SharedFitness::bind(const NodeStore& store, std::span<const NodeId> roots) {
  known_.resize(store.end(), kNotEvaluated);
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
    if (id < known_.size()) known_[id] = kNotEvaluated;
  evaluator_.forget(dropped);
}

namespace {

Interval trained_range(const TrainingTable& table) {
  if (table.target.empty()) return {};
  const auto [least, greatest] = std::minmax_element(table.variables.front().begin(), table.variables.front().end());
  return {*least, *greatest};
}

}  // namespace

SafeFormulas::SafeFormulas(const TrainingTable& table)
    : is_on_(std::isfinite(table.limit)), limit_(table.limit), range_(trained_range(table)) {}

bool SafeFormulas::operator()(const NodeStore& store, NodeId root) {
  if (!is_on_) return true;
  if (known_.size() <= root) known_.resize(store.end(), Verdict::unknown);
  Verdict& verdict = known_[root];
  if (verdict == Verdict::unknown) {
    tree_.clear();
    store.append(root, tree_);
    verdict = stays_within(tree_, range_, limit_) ? Verdict::safe : Verdict::unsafe;
  }
  return verdict == Verdict::safe;
}

void SafeFormulas::forget(std::span<const NodeId> dropped) {
  for (const NodeId id : dropped)
    if (id < known_.size()) known_[id] = Verdict::unknown;
}

}  // namespace demecal::inline fitness

#include "evolution/safe_formulas.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

Interval range_of(const TrainingTable& table) {
  if (table.target.empty()) return {};
  const auto [least, greatest] = std::minmax_element(table.variables.front().begin(), table.variables.front().end());
  return {*least, *greatest};
}

}  // namespace

SafeFormulas::SafeFormulas(const TrainingTable& table)
    : is_on_(std::isfinite(table.limit)), limit_(table.limit), range_(range_of(table)) {}

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

}  // namespace demecal

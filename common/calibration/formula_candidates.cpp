#include "calibration/formula_candidates.hpp"

#include <algorithm>

#include "calibration/polish.hpp"

namespace demecal {
namespace {

bool says_something(const Tree& formula) {
  return std::ranges::any_of(formula, [](const Node& node) { return node.primitive == Primitive::variable; });
}

}  // namespace

std::vector<Candidate> formula_candidates(const FormulaTable& table, const Population& front, std::size_t most) {
  std::vector<Candidate> candidates;
  const int variables = static_cast<int>(table.table.variables.size());
  for (const Individual& individual : front) {
    if (candidates.size() >= most) break;
    if (!says_something(individual.tree)) continue;
    Candidate candidate;
    candidate.effect = {.kind = "symbolic", .joint = table.joint};
    candidate.effect.formula = polished(individual.tree, table.table);
    candidate.effect.settings["reference_celsius"] = table.reference_celsius;
    candidate.name_nats = description_nats(candidate.effect.formula, variables, table.table.target.size());
    const bool known = std::ranges::any_of(
        candidates, [&](const Candidate& other) { return other.effect.same_law_as(candidate.effect); });
    if (!known) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace demecal

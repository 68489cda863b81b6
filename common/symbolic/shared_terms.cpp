#include "symbolic/shared_terms.hpp"

#include <algorithm>
#include <cmath>

#include "symbolic/values.hpp"

namespace demecal {
namespace {

/// Whether writing the expression again costs nothing: a name, a number, or one of them with its sign changed.
bool is_free(const ExpressionNode& term) {
  if (term.kind == Kind::constant || term.kind == Kind::symbol) return true;
  return term.kind == Kind::sum && term.value == 0.0 && term.parts.size() == 1 && term.parts[0].second == -1.0;
}

}  // namespace

Steps steps_to(const std::vector<Expression>& expressions, const Spelling& spelling, const std::string& stem) {
  std::map<std::uint32_t, int> written;
  for (const Expression expression : expressions) ++written[expression->id];
  const std::vector<Expression> terms = terms_of(expressions);
  Steps steps;
  std::vector<Expression> shared;
  for (std::size_t i = terms.size(); i-- > 0;) {  // from the whole to its parts
    const ExpressionNode& term = *terms[i];
    const int times = written[term.id];
    const bool named = times > 1 && !is_free(term);
    if (named) shared.push_back(terms[i]);
    for (const auto& [part, amount] : term.parts) {
      const int repeats = term.kind == Kind::product ? static_cast<int>(std::abs(amount)) : 1;
      written[part->id] += (named ? 1 : times) * repeats;
    }
  }
  std::ranges::reverse(shared);
  for (const Expression term : shared) {
    const std::string name = stem + std::to_string(steps.assignments.size() + 1);
    steps.assignments.emplace_back(name, spelling(term, steps.names));
    steps.names.emplace(term->id, name);
  }
  for (const Expression expression : expressions) {
    const auto name = steps.names.find(expression->id);
    steps.results.push_back(name == steps.names.end() ? spelling(expression, steps.names) : name->second);
  }
  return steps;
}

}  // namespace demecal

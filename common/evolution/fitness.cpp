#include "evolution/fitness.hpp"

#include <cmath>

#include "errors/check.hpp"

namespace demecal {

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

}  // namespace demecal

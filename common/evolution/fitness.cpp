#include "evolution/fitness.hpp"

#include <cmath>
#include <limits>

#include "errors/check.hpp"

namespace demecal {

Fitness::Fitness(const TrainingTable& table) : table_(table), evaluate_(table.variables) {
  DEMECAL_CHECK(!table.variables.empty() && table.weight.size() == table.target.size(),
                "variables=" << table.variables.size() << " weights=" << table.weight.size()
                             << " targets=" << table.target.size());
  for (const auto& column : table.variables)
    DEMECAL_CHECK(column.size() == table.target.size(), column.size() << " rows of " << table.target.size());
}

double Fitness::operator()(const Tree& tree) {
  const std::span<const double> values = evaluate_(tree);
  double sum = 0.0;
  for (std::size_t row = 0; row < values.size(); ++row)
    sum += table_.weight[row] * std::abs(table_.target[row] - values[row]);
  // A row that is not finite makes the sum infinite or no number, even where its weight is zero.
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace demecal

#include <algorithm>
#include <cmath>
#include <functional>

#include "protocol/faults.hpp"

namespace demecal {
namespace {

constexpr std::size_t kMostVariables = 255;

Fault size_fault(const GpParameters& p) {
  if (p.population_size > kMostIndividuals) return "more individuals than are believed";
  if (p.number_generations > kMostGenerations) return "more generations than are believed";
  if (p.invalid_attempts > kMostAttempts) return "more attempts at an offspring than are believed";
  return std::nullopt;
}

Fault archipelago_fault(const Archipelago& a) {
  if (a.joints.empty() || a.joints.size() > kMostJoints) return "no joints, or too many";
  if (std::adjacent_find(a.joints.begin(), a.joints.end(), std::greater_equal<>()) != a.joints.end())
    return "joints are not ascending";
  if (a.joints.back() >= kMostJoints) return "a joint's number is too high";
  if (a.demes_per_joint < 1 || a.demes_per_joint > kMostDemes) return "no demes, or too many";
  if (a.topology != Topology::none && a.topology != Topology::ring && a.topology != Topology::full)
    return "unknown topology";
  if (a.replacement != Replacement::worst && a.replacement != Replacement::random) return "unknown replacement";
  if (!(a.spread >= 0.0 && a.spread <= 1.0)) return "a spread outside 0 to 1";
  if (a.migration_interval < 1) return "migration interval is 0";
  return std::nullopt;
}

bool is_finite_column(const std::vector<double>& column, std::size_t rows) {
  return column.size() == rows && std::all_of(column.begin(), column.end(), [](double x) { return std::isfinite(x); });
}

Fault table_fault(const TrainingTable& table, const GpParameters& parameters) {
  const std::size_t rows = table.target.size();
  if (rows == 0 || rows > kMostRows) return "a table without rows, or with too many";
  if (table.variables.empty() || table.variables.size() > kMostVariables)
    return "a table without variables, or with too many";
  for (const auto& column : table.variables)
    if (!is_finite_column(column, rows)) return "a column of variables is not finite, or of another length";
  if (!is_finite_column(table.target, rows)) return "a target is not finite";
  if (!is_finite_column(table.weight, rows)) return "a weight is not finite, or there is not one per row";
  if (std::any_of(table.weight.begin(), table.weight.end(), [](double w) { return w < 0.0 || w > 1.0; }))
    return "a weight lies outside 0 to 1";
  if (table.loss != Loss::absolute && table.loss != Loss::squared) return "an unknown loss";
  if (table.seeds.size() > static_cast<std::size_t>(parameters.population_size)) return "more seeds than individuals";
  const auto variables = static_cast<int>(table.variables.size());
  if (!std::all_of(table.seeds.begin(), table.seeds.end(), [&](const Tree& seed) { return is_valid(seed, variables); }))
    return "a seed is no complete formula";
  if (!(table.limit >= 0.0)) return "a limit that is no size";
  if (variables > 1 && std::isfinite(table.limit)) return "a limit on formulas of several variables";
  return std::nullopt;
}

}  // namespace

Fault find_fault(const CalibrationData& data) {
  if (data.run == 0) return "run 0 names no run";
  if (const auto fault = find_fault(data.parameters)) return fault->key + " = " + fault->value + " " + fault->rule;
  if (auto fault = size_fault(data.parameters)) return fault;
  if (auto fault = archipelago_fault(data.archipelago)) return fault;
  if (data.archipelago.migrants > static_cast<std::uint32_t>(data.parameters.population_size))
    return "more migrants than individuals";
  if (data.tables.size() != data.archipelago.joints.size()) return "not one table per joint";
  for (const TrainingTable& table : data.tables)
    if (auto fault = table_fault(table, data.parameters)) return fault;
  return std::nullopt;
}

}  // namespace demecal

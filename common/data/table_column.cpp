#include "data/table_column.hpp"

#include "data/lower_case.hpp"
#include "data/nearest_name.hpp"

namespace demecal {
namespace {

std::size_t index_of(const CsvTable& table, const ColumnName& name) {
  if (const auto index = table.find(name.name)) return *index;
  throw InputError(
      name.where, name.name,
      "is no column of " + table.file + "; the nearest is '" + nearest_name(name.name, table.columns) + "'");
}

std::string why_no_number(const std::string& text) {
  if (text.empty()) return "is empty where a number is expected";
  const std::string lower = lower_case(text);
  if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos)
    return "must be a finite number";
  return "is not a number";
}

}  // namespace

TableColumn::TableColumn(const CsvTable& table, const ColumnName& name, UnitConversion to_inside)
    : file_(table.file), name_(name.name), index_(index_of(table, name)), to_inside_(to_inside) {}

TableColumn::TableColumn(const CsvTable& table, const ColumnName& name, Quantity quantity, const AssumedUnits& units)
    : TableColumn(table, name, unit_of(name, quantity, units).to_inside) {}

double TableColumn::number(const CsvRow& row) const {
  const auto value = parse_number(text(row));
  if (!value) fail(row, why_no_number(text(row)));
  return to_inside_ ? to_inside_(*value) : *value;
}

void TableColumn::fail(const CsvRow& row, const std::string& rule) const {
  throw InputError({file_, row.line}, text(row), "column " + name_ + " " + rule);
}

}  // namespace demecal

// One column of a table as what it holds: numbers in SI units, signs or words.
#pragma once

#include <string>

#include "data/column_map.hpp"
#include "data/column_unit.hpp"
#include "data/csv.hpp"

namespace demecal {

/// A column found in a table.
class TableColumn {
 public:
  /// Throws InputError naming the nearest column where the table has none of this name.
  TableColumn(const CsvTable& table, const ColumnName& name, UnitConversion to_inside = nullptr);
  /// The same for a quantity, with its unit.
  TableColumn(const CsvTable& table, const ColumnName& name, Quantity quantity, const AssumedUnits& units);

  const std::string& text(const CsvRow& row) const { return row.fields[index_]; }
  /// The row's number, converted. Throws InputError where the field writes none.
  double number(const CsvRow& row) const;
  [[noreturn]] void fail(const CsvRow& row, const std::string& rule) const;

 private:
  std::string file_;
  std::string name_;
  std::size_t index_;
  UnitConversion to_inside_;
};

}  // namespace demecal

#include "data/columns.hpp"

#include <algorithm>
#include <array>

#include "data/text.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline data {
namespace {

double unchanged(double value) {
  return value;
}

constexpr std::array<ColumnUnit, 9> kUnits{{
    {"deg", Quantity::angle, radians},
    {"rad", Quantity::angle, unchanged},
    {"mm", Quantity::length, metres},
    {"m", Quantity::length, unchanged},
    {"kg", Quantity::mass, unchanged},
    {"celsius", Quantity::temperature, unchanged},
    {"s", Quantity::time, unchanged},
    {"nm", Quantity::torque, unchanged},
    {"n", Quantity::force, unchanged},
}};

double from_centimetres(double value) {
  return value * 1e-2;
}
double from_micrometres(double value) {
  return value * 1e-6;
}
double from_inches(double value) {
  return value * 25.4e-3;
}
double from_gons(double value) {
  return radians(0.9 * value);
}
double from_thousandths(double value) {
  return value * 1e-3;
}
double from_kelvin(double value) {
  return value - 273.15;
}
double from_fahrenheit(double value) {
  return (value - 32.0) / 1.8;
}

/// Units that headings give in brackets, beside those above; names end in those of masses and temperatures too.
constexpr std::array<ColumnUnit, 32> kHeadingUnits{{
    {"°", Quantity::angle, radians},
    {"degree", Quantity::angle, radians},
    {"degrees", Quantity::angle, radians},
    {"radian", Quantity::angle, unchanged},
    {"radians", Quantity::angle, unchanged},
    {"mrad", Quantity::angle, from_thousandths},
    {"gon", Quantity::angle, from_gons},
    {"millimeter", Quantity::length, metres},
    {"millimeters", Quantity::length, metres},
    {"meter", Quantity::length, unchanged},
    {"meters", Quantity::length, unchanged},
    {"cm", Quantity::length, from_centimetres},
    {"um", Quantity::length, from_micrometres},
    {"µm", Quantity::length, from_micrometres},
    {"in", Quantity::length, from_inches},
    {"inch", Quantity::length, from_inches},
    {"inches", Quantity::length, from_inches},
    {"g", Quantity::mass, from_thousandths},
    {"°c", Quantity::temperature, unchanged},
    {"c", Quantity::temperature, unchanged},
    {"degc", Quantity::temperature, unchanged},
    {"°f", Quantity::temperature, from_fahrenheit},
    {"f", Quantity::temperature, from_fahrenheit},
    {"degf", Quantity::temperature, from_fahrenheit},
    {"fahrenheit", Quantity::temperature, from_fahrenheit},
    {"k", Quantity::temperature, from_kelvin},
    {"kelvin", Quantity::temperature, from_kelvin},
    {"sec", Quantity::time, unchanged},
    {"seconds", Quantity::time, unchanged},
    {"ms", Quantity::time, from_thousandths},
    {"n m", Quantity::torque, unchanged},
    {"n*m", Quantity::torque, unchanged},
}};

/// Units that other programs write; silence about them would be a wrong number.
constexpr std::array<std::string_view, 21> kForeignUnits{
    "degrees", "mrad", "gon", "arcsec", "arcmin", "turns",      "um", "cm", "inch", "in", "ft",
    "g",       "lb",   "k",   "kelvin", "f",      "fahrenheit", "ms", "us", "min",  "h"};

struct Wording {
  std::string_view is;
  std::string_view suffixes;
};
constexpr std::array<Wording, 7> kWording{{
    {"an angle", "_deg or _rad"},
    {"a length", "_mm or _m"},
    {"a mass", "_kg"},
    {"a temperature", "_celsius"},
    {"a time", "_s"},
    {"a torque", "_nm"},
    {"a force", "_n"},
}};
const Wording& wording(Quantity quantity) {
  return kWording[static_cast<std::size_t>(quantity)];
}

std::string suffix_of(std::string_view column) {
  const std::size_t underscore = column.rfind('_');
  return underscore == std::string_view::npos ? "" : lower_case(column.substr(underscore + 1));
}

/// The unit that a name ends in. Masses and temperatures without one are taken for kg and deg C, so that other units at
/// the end are read; angles and lengths without one are asked for, and have few.
std::optional<ColumnUnit> unit_at_end(std::string_view column, Quantity quantity) {
  const std::string suffix = suffix_of(column);
  if (const auto unit = find_unit(suffix)) return unit;
  if (quantity != Quantity::mass && quantity != Quantity::temperature) return std::nullopt;
  const auto unit = find_heading_unit(suffix);
  return unit && unit->quantity == quantity ? unit : std::nullopt;
}

std::string expected_ending(Quantity quantity) {
  return "it is expected to hold " + std::string(wording(quantity).is) + " and end in " +
         std::string(wording(quantity).suffixes);
}

ColumnUnit unit_without_suffix(const ColumnName& column, Quantity quantity, const AssumedUnits& assumed) {
  switch (quantity) {
    case Quantity::mass:
      return *find_unit("kg");
    case Quantity::temperature:
      return *find_unit("celsius");
    case Quantity::time:
      return *find_unit("s");
    case Quantity::torque:
      return *find_unit("nm");
    case Quantity::force:
      return *find_unit("n");
    case Quantity::angle:
    case Quantity::length:
      break;
  }
  const auto& unit = quantity == Quantity::angle ? assumed.angle : assumed.length;
  if (unit) return *unit;
  throw InputError(column.where, column.name,
                   "carries no unit: " + expected_ending(quantity) + ", or `units:` must give the unit");
}

std::size_t numbered_index(const CsvTable& table, const ColumnName& name) {
  if (name.number <= table.columns.size()) return name.number - 1;
  throw InputError(
      name.where, std::to_string(name.number),
      "is the number of no column of " + table.file + ", which has " + std::to_string(table.columns.size()));
}

/// A table of another program may have one name twice, as of nominal and measured coordinates.
void require_single(const CsvTable& table, const ColumnName& name, std::size_t first) {
  for (std::size_t other = first + 1; other < table.columns.size(); ++other) {
    if (table.columns[first] != table.columns[other] || table.find(name.name) != first) continue;
    if (!table.headings.empty() && table.headings[first] != table.headings[other] && name.name == table.headings[first])
      continue;
    throw InputError(name.where, name.name,
                     "is the name of columns " + std::to_string(first + 1) + " and " + std::to_string(other + 1) +
                         " of " + table.file + "; give the number of the one that is meant");
  }
}

std::size_t index_of(const CsvTable& table, const ColumnName& name) {
  if (name.number > 0) return numbered_index(table, name);
  if (const auto index = table.find(name.name)) {
    require_single(table, name, *index);
    return *index;
  }
  throw InputError(
      name.where, name.name,
      "is no column of " + table.file + "; the nearest is '" + nearest_name(name.name, table.columns) + "'");
}

/// The name by which the table calls it, for messages.
std::string shown_name(const CsvTable& table, const ColumnName& name, std::size_t index) {
  return name.number > 0 ? table.columns[index] : name.name;
}

UnitConversion conversion_of(const CsvTable& table, const ColumnName& name, std::size_t index, Quantity quantity,
                             const AssumedUnits& units) {
  const ColumnName shown{shown_name(table, name, index), name.where};
  if (table.units.empty() || table.units[index].empty()) return unit_of(shown, quantity, units).to_inside;
  const std::string& text = table.units[index];
  const auto unit = find_heading_unit(text);
  if (!unit)
    throw InputError(name.where, shown.name,
                     "is headed with the unit '" + text + "', which is not supported; " + expected_ending(quantity));
  if (unit->quantity != quantity) {
    throw InputError(name.where, shown.name,
                     "is headed with '" + text + "', a unit of " + std::string(wording(unit->quantity).is) + "; " +
                         expected_ending(quantity));
  }
  return unit->to_inside;
}

}  // namespace

std::optional<ColumnUnit> find_unit(std::string_view name) {
  const auto found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const ColumnUnit& unit) { return unit.name == name; });
  if (found == kUnits.end()) return std::nullopt;
  return *found;
}

std::optional<ColumnUnit> find_heading_unit(std::string_view text) {
  const std::string lower = lower_case(text);
  if (const auto unit = find_unit(lower)) return unit;
  const auto found = std::ranges::find_if(kHeadingUnits, [&](const ColumnUnit& unit) { return unit.name == lower; });
  if (found == kHeadingUnits.end()) return std::nullopt;
  return *found;
}

ColumnUnit unit_of(const ColumnName& column, Quantity quantity, const AssumedUnits& assumed) {
  if (const auto unit = unit_at_end(column.name, quantity)) {
    if (unit->quantity == quantity) return *unit;
    throw InputError(column.where, column.name,
                     "ends in a unit of " + std::string(wording(unit->quantity).is) + "; " + expected_ending(quantity));
  }
  if (std::ranges::find(kForeignUnits, suffix_of(column.name)) != kForeignUnits.end()) {
    throw InputError(column.where, column.name, "ends in a unit that is not supported; " + expected_ending(quantity));
  }
  return unit_without_suffix(column, quantity, assumed);
}

bool states_unit(const CsvTable& table, std::size_t column, Quantity quantity) {
  if (!table.units.empty() && !table.units[column].empty()) return true;
  return unit_at_end(table.columns[column], quantity).has_value();
}

Quantity angle_or_length(const CsvTable& table, const ColumnName& column) {
  const std::size_t index = index_of(table, column);
  const bool headed = !table.units.empty() && !table.units[index].empty();
  const auto unit =
      headed ? find_heading_unit(table.units[index]) : find_unit(suffix_of(shown_name(table, column, index)));
  return unit && unit->quantity == Quantity::angle ? Quantity::angle : Quantity::length;
}

TableColumn::TableColumn(const CsvTable& table, const ColumnName& name, UnitConversion to_inside)
    : file_(table.file),
      index_(index_of(table, name)),
      table_(name.table),
      decimal_(table.decimal),
      to_inside_(to_inside) {
  name_ = shown_name(table, name, index_);
}

TableColumn::TableColumn(const CsvTable& table, const ColumnName& name, Quantity quantity, const AssumedUnits& units)
    : TableColumn(table, name) {
  to_inside_ = conversion_of(table, name, index_, quantity, units);
  unit_is_stated_ = states_unit(table, index_, quantity);
}

double TableColumn::number(const CsvRow& row) const {
  std::string written = text(row);
  if (decimal_ == ',' && written.find('.') == std::string::npos) std::ranges::replace(written, ',', '.');
  const auto value = decimal_ == ',' && text(row).find('.') != std::string::npos ? std::nullopt : parse_number(written);
  if (!value) fail(row, why_no_number(text(row), decimal_));
  return to_inside_ ? to_inside_(*value) : *value;
}

void TableColumn::fail(const CsvRow& row, const std::string& rule) const {
  throw InputError({file_, row.line}, text(row), "column " + name_ + " " + rule);
}

}  // namespace demecal::inline data

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

constexpr std::array<ColumnUnit, 7> kUnits{{
    {"deg", Quantity::angle, radians},
    {"rad", Quantity::angle, unchanged},
    {"mm", Quantity::length, metres},
    {"m", Quantity::length, unchanged},
    {"kg", Quantity::mass, unchanged},
    {"celsius", Quantity::temperature, unchanged},
    {"s", Quantity::time, unchanged},
}};

/// Units that other programs write; silence about them would be a wrong number.
constexpr std::array<std::string_view, 21> kForeignUnits{
    "degrees", "mrad", "arcsec", "arcmin", "turns", "um",         "cm", "inch", "in",  "ft", "g",
    "lb",      "n",    "k",      "kelvin", "f",     "fahrenheit", "ms", "us",   "min", "h"};

struct Wording {
  std::string_view is;
  std::string_view suffixes;
};
constexpr std::array<Wording, 5> kWording{{
    {"an angle", "_deg or _rad"},
    {"a length", "_mm or _m"},
    {"a mass", "_kg"},
    {"a temperature", "_celsius"},
    {"a time", "_s"},
}};
const Wording& wording(Quantity quantity) {
  return kWording[static_cast<std::size_t>(quantity)];
}

std::string suffix_of(std::string_view column) {
  const std::size_t underscore = column.rfind('_');
  return underscore == std::string_view::npos ? "" : lower_case(column.substr(underscore + 1));
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
    case Quantity::angle:
    case Quantity::length:
      break;
  }
  const auto& unit = quantity == Quantity::angle ? assumed.angle : assumed.length;
  if (unit) return *unit;
  throw InputError(column.where, column.name,
                   "carries no unit: " + expected_ending(quantity) + ", or `units:` must give the unit");
}

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

std::vector<ColumnName> ColumnMap::all() const {
  std::vector<ColumnName> names;
  for (const auto* group : {&joints, &position, &orientation, &distances, &approach}) {
    names.insert(names.end(), group->begin(), group->end());
  }
  for (const auto* single : {&payload, &temperature, &time, &set, &pose, &target, &contact}) {
    if (*single) names.push_back(**single);
  }
  return names;
}

std::optional<ColumnUnit> find_unit(std::string_view name) {
  const auto found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const ColumnUnit& unit) { return unit.name == name; });
  if (found == kUnits.end()) return std::nullopt;
  return *found;
}

ColumnUnit unit_of(const ColumnName& column, Quantity quantity, const AssumedUnits& assumed) {
  const std::string suffix = suffix_of(column.name);
  if (const auto unit = find_unit(suffix)) {
    if (unit->quantity == quantity) return *unit;
    throw InputError(column.where, column.name,
                     "ends in a unit of " + std::string(wording(unit->quantity).is) + "; " + expected_ending(quantity));
  }
  if (std::find(kForeignUnits.begin(), kForeignUnits.end(), suffix) != kForeignUnits.end()) {
    throw InputError(column.where, column.name, "ends in a unit that is not supported; " + expected_ending(quantity));
  }
  return unit_without_suffix(column, quantity, assumed);
}

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

}  // namespace demecal::inline data

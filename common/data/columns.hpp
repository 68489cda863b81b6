// The columns of a table: which hold which quantities, in which units, and their values.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline data {

/// A column's name and where the user wrote it.
struct ColumnName {
  std::string name;
  InputError::Where where;
  std::size_t number = 0;  ///< of the column in its table, from 1, where it is meant by that; 0: by its name
  std::size_t table = 0;   ///< among those that the poses are read from
};

/// The columns of one key: none, one or several.
template <typename Column>
std::span<const Column> columns_in(const std::vector<Column>& list) {
  return list;
}
template <typename Column>
std::span<const Column> columns_in(const std::optional<Column>& single) {
  return single ? std::span<const Column>(&*single, 1) : std::span<const Column>();
}

template <typename Column>
void add_column(std::vector<Column>& list, Column column) {
  list.push_back(std::move(column));
}
template <typename Column>
void add_column(std::optional<Column>& single, Column column) {
  single = std::move(column);
}

/// What columns may hold of poses; a `Column` is a name, an index, or a column found.
template <typename Column>
struct PoseColumns {
  std::vector<Column> joints;       ///< one per joint
  std::vector<Column> position;     ///< x, y, z, or none
  std::vector<Column> orientation;  ///< w, x, y, z of a unit quaternion, or none
  std::vector<Column> sigma;        ///< of the position: one for all axes, x, y, z, or range and two angles; or none
  std::vector<Column> distances;
  std::vector<Column> approach;  ///< one per joint, or none
  std::vector<Column> torque;    ///< one per joint, or none
  std::optional<Column> payload, temperature, time, set, pose, target, contact;

  /// Calls `visit(key, member)` for each of them, a list or a single column, with its key under `columns:`.
  template <typename Visit>
  static void for_each_key(const Visit& visit) {
    visit("joints", &PoseColumns::joints);
    visit("position", &PoseColumns::position);
    visit("orientation", &PoseColumns::orientation);
    visit("sigma", &PoseColumns::sigma);
    visit("distances", &PoseColumns::distances);
    visit("approach", &PoseColumns::approach);
    visit("torque", &PoseColumns::torque);
    visit("payload", &PoseColumns::payload);
    visit("temperature", &PoseColumns::temperature);
    visit("time", &PoseColumns::time);
    visit("set", &PoseColumns::set);
    visit("pose", &PoseColumns::pose);
    visit("target", &PoseColumns::target);
    visit("contact", &PoseColumns::contact);
  }

  /// All columns that there are, in the order above.
  std::vector<Column> all() const {
    std::vector<Column> columns;
    for_each_key([&](std::string_view, auto member) {
      for (const Column& column : columns_in(this->*member)) columns.push_back(column);
    });
    return columns;
  }
};

/// Which columns the user says hold what.
struct ColumnMap : PoseColumns<ColumnName> {
  InputError::Where where;  ///< of the whole map
};

enum class Quantity { angle, length, mass, temperature, time, torque, force };

/// A unit in which users may give a quantity.
struct ColumnUnit {
  std::string_view name;  ///< as names end in it, without the underscore: "deg"
  Quantity quantity;
  UnitConversion to_inside;  ///< to SI and radians; temperatures stay in celsius
};

/// The unit of that name, among: deg rad mm m kg celsius s nm n. Nothing for any other.
std::optional<ColumnUnit> find_unit(std::string_view name);

/// The unit that a heading gives apart from its name, as in "X [mm]": those of find_unit(), and what other programs
/// write (degrees, in, um, ms, ...). Nothing where it is not known.
std::optional<ColumnUnit> find_heading_unit(std::string_view text);

/// What `units:` says of columns whose names carry no unit.
struct AssumedUnits {
  std::optional<ColumnUnit> angle;
  std::optional<ColumnUnit> length;
};

/// The unit of a column that holds `quantity`: that in which its name ends, else the assumed one. Masses, temperatures,
/// times, torques and forces have one unit each that is taken where the name has none; masses and temperatures may end
/// in those of find_heading_unit() too. Throws InputError where an angle or length
/// has no unit, or where the name ends in a unit of something else or one that is not supported.
ColumnUnit unit_of(const ColumnName& column, Quantity quantity, const AssumedUnits& assumed);

/// Whether the table itself says the column's unit, at the end of its name or beside it.
bool states_unit(const CsvTable& table, std::size_t column, Quantity quantity);

/// Angle where the column's name or its heading gives a unit of that, else length.
Quantity angle_or_length(const CsvTable& table, const ColumnName& column);

/// A column found in a table.
class TableColumn {
 public:
  /// Throws InputError naming the nearest column where the table has none of this name.
  TableColumn(const CsvTable& table, const ColumnName& name, UnitConversion to_inside = nullptr);
  /// The same for a quantity, with its unit.
  TableColumn(const CsvTable& table, const ColumnName& name, Quantity quantity, const AssumedUnits& units);

  std::size_t table() const { return table_; }  ///< ColumnName::table
  std::size_t index() const { return index_; }
  /// Of a column of a quantity: by states_unit().
  bool unit_is_stated() const { return unit_is_stated_; }
  const std::string& text(const CsvRow& row) const { return row.fields[index_]; }
  /// The row's number, converted. Throws InputError where the field writes none.
  double number(const CsvRow& row) const;
  [[noreturn]] void fail(const CsvRow& row, const std::string& rule) const;

 private:
  std::string file_;
  std::string name_;
  std::size_t index_;
  std::size_t table_ = 0;
  char decimal_ = '.';
  bool unit_is_stated_ = false;
  UnitConversion to_inside_;
};

}  // namespace demecal::inline data

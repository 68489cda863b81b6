// The unit of a column, from the end of its name.
#pragma once

#include <optional>
#include <string_view>

#include "data/column_map.hpp"
#include "data/number.hpp"

namespace demecal {

enum class Quantity { angle, length, mass, temperature, time };

/// A unit in which users may give a quantity.
struct ColumnUnit {
  std::string_view name;  ///< as names end in it, without the underscore: "deg"
  Quantity quantity;
  UnitConversion to_inside;  ///< to SI and radians; temperatures stay in celsius
};

/// The unit of that name, among: deg rad mm m kg celsius s. Nothing for any other.
std::optional<ColumnUnit> find_unit(std::string_view name);

/// What `units:` says of columns whose names carry no unit.
struct AssumedUnits {
  std::optional<ColumnUnit> angle;
  std::optional<ColumnUnit> length;
};

/// The unit of a column that holds `quantity`: that in which its name ends, else the assumed one. Masses, temperatures
/// and times have one unit each and need none in the name. Throws InputError where an angle or length has no unit, or
/// where the name ends in a unit of something else or one that is not supported.
ColumnUnit unit_of(const ColumnName& column, Quantity quantity, const AssumedUnits& assumed);

}  // namespace demecal

// Which columns of a table hold which quantities, as the user named them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "errors/input_error.hpp"

namespace demecal {

/// A column's name and where the user wrote it.
struct ColumnName {
  std::string name;
  InputError::Where where;
};

struct ColumnMap {
  InputError::Where where;              ///< of the whole map
  std::vector<ColumnName> joints;       ///< one per joint
  std::vector<ColumnName> position;     ///< x, y, z, or none
  std::vector<ColumnName> orientation;  ///< w, x, y, z of a unit quaternion, or none
  std::vector<ColumnName> distances;
  std::vector<ColumnName> approach;  ///< one per joint, or none
  std::optional<ColumnName> payload, temperature, time, set, pose, target;

  /// All columns named, in the order above.
  std::vector<ColumnName> all() const;
};

}  // namespace demecal

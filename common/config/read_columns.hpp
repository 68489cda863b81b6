// Which columns of its table a data set file names, and in which units.
#pragma once

#include "config/yaml_node.hpp"
#include "data/column_map.hpp"
#include "data/column_unit.hpp"

namespace demecal {

/// What stands under `columns`.
ColumnMap read_column_map(const YamlNode& node);

/// What stands under `units`; nothing is assumed where the key is missing (null).
AssumedUnits read_units(const YamlNode* node);

}  // namespace demecal

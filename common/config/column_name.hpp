// How files name one column of a table.
#pragma once

#include "data/columns.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// A column by its name or, where that is a whole number, by its place from 1.
ColumnName read_column(const YamlNode& node);

}  // namespace demecal::inline config

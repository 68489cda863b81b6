#include "data/column_map.hpp"

namespace demecal {

std::vector<ColumnName> ColumnMap::all() const {
  std::vector<ColumnName> names;
  for (const auto* group : {&joints, &position, &orientation, &distances, &approach}) {
    names.insert(names.end(), group->begin(), group->end());
  }
  for (const auto* single : {&payload, &temperature, &time, &set, &pose, &target}) {
    if (*single) names.push_back(**single);
  }
  return names;
}

}  // namespace demecal

#include "fitting/median.hpp"

#include <algorithm>

#include "errors/check.hpp"

namespace demecal {

double median(std::vector<double> values) {
  DEMECAL_CHECK(!values.empty(), "the median of nothing");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace demecal

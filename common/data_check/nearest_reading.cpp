#include "data_check/nearest_reading.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kinematics/units.hpp"

namespace demecal::inline data_check {

std::vector<AlikeReading> nearest_to_description(const std::vector<Explanation>& alike,
                                                 const std::function<double(const Explanation&)>& distance_m,
                                                 double same_m) {
  std::vector<AlikeReading> readings;
  double least_m = std::numeric_limits<double>::infinity();
  for (const Explanation& change : alike) {
    const double one_m = distance_m(change);
    if (!std::isfinite(one_m)) continue;
    readings.push_back({change, one_m});
    least_m = std::min(least_m, one_m);
  }
  const auto is_farther = [&](const AlikeReading& one) { return one.distance_m > least_m + same_m; };
  if (least_m <= same_m) std::erase_if(readings, is_farther);
  std::ranges::stable_sort(readings, {},
                           [&](const AlikeReading& one) { return is_farther(one) ? one.distance_m : least_m; });
  return readings;
}

std::vector<std::string> as_well_sentences(const std::vector<AlikeReading>& readings, double same_m) {
  std::vector<std::string> sentences;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const double first_m = readings.front().distance_m, other_m = readings[i].distance_m;
    const std::string where =
        other_m <= first_m + same_m
            ? ""
            : fmt::format("; tool and base then stand {:.1f} mm from their description, by the one above {:.1f} mm",
                          millimetres(other_m), millimetres(first_m));
    sentences.push_back("As well, and these poses cannot tell which, it fits if " + readings[i].change.clause + where +
                        ".");
  }
  return sentences;
}

}  // namespace demecal::inline data_check

#include "cost_model.hpp"

namespace demecal::bench {

CostModel fit(const std::vector<EpochTime>& times) {
  const auto count = static_cast<double>(times.size());
  double mean_islands = 0.0, mean_s = 0.0, squares = 0.0, products = 0.0;
  for (const EpochTime& time : times) {
    mean_islands += time.islands / count;
    mean_s += time.beyond_ideal_s / count;
  }
  for (const EpochTime& time : times) {
    squares += (time.islands - mean_islands) * (time.islands - mean_islands);
    products += (time.islands - mean_islands) * (time.beyond_ideal_s - mean_s);
  }
  const double slope = squares > 0.0 ? products / squares : 0.0;
  return {mean_s - slope * mean_islands, slope};
}

}  // namespace demecal::bench

#include "updating/waves.hpp"

#include <cmath>

namespace demecal::inline updating {

double wave_share(int n) {
  constexpr double kWaveDecay = 25.0;  ///< cycles a turn beyond which they get rarer
  static const double whole = [] {
    double sum = 0.0;
    for (int k = 1; k <= kHighestWave; ++k) sum += 1.0 / (1.0 + std::pow(k / kWaveDecay, 2.0));
    return sum;
  }();
  return 1.0 / (1.0 + std::pow(n / kWaveDecay, 2.0)) / whole;
}

}  // namespace demecal::inline updating

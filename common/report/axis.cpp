#include "report/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

/// Every second one, as often as it takes to leave no more than `most`.
std::vector<double> thinned(std::vector<double> values, std::size_t most) {
  while (values.size() > most) {
    for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
    values.resize((values.size() + 1) / 2);
  }
  return values;
}

/// 1, 2, 5 or 10 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> linear_ticks(const Axis& axis, int wanted) {
  const double least = (axis.upper - axis.lower) / wanted;
  const double step = round_step(axis.whole ? std::max(1.0, least) : least);
  const double first = std::ceil(axis.lower / step - 1e-9);
  const double last = std::floor(axis.upper / step + 1e-9);
  std::vector<double> found;
  for (double k = first; k <= last; ++k) found.push_back(k * step);
  return found;
}

std::vector<double> logarithmic_ticks(const Axis& axis, const std::vector<double>& factors) {
  std::vector<double> found;
  const int last = static_cast<int>(std::floor(std::log10(axis.upper)));
  for (int decade = static_cast<int>(std::floor(std::log10(axis.lower))); decade <= last; ++decade) {
    for (const double factor : factors) {
      const double tick = factor * std::pow(10.0, decade);
      if (tick >= axis.lower && tick <= axis.upper) found.push_back(tick);
    }
  }
  return found;
}

}  // namespace

double Axis::operator()(double value) const {
  const double share = logarithmic ? std::log(std::max(value, lower) / lower) / std::log(upper / lower)
                                   : (value - lower) / (upper - lower);
  return from_px + share * (to_px - from_px);
}

std::vector<double> ticks(const Axis& axis, int wanted) {
  if (!axis.logarithmic) return linear_ticks(axis, wanted);
  const auto most = static_cast<std::size_t>(2 * wanted);
  std::vector<double> found = logarithmic_ticks(axis, {1.0, 2.0, 5.0});
  if (found.size() > most) found = thinned(logarithmic_ticks(axis, {1.0}), most);
  return found.size() < 3 ? linear_ticks(axis, wanted) : found;
}

std::string tick_text(double value) {
  return fmt::format("{:.6g}", value + 0.0);
}

}  // namespace demecal

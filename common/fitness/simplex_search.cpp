#include "fitness/constant_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace demecal::inline fitness {
namespace {

double finite_or_worst(double value) {
  return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

}  // namespace

void SimplexSearch::start(const Function& function, std::span<const double> point, double value) {
  unknowns_ = point.size();
  corners_.resize((unknowns_ + 1) * unknowns_);
  values_.assign(unknowns_ + 1, std::numeric_limits<double>::infinity());
  centre_.resize(unknowns_);
  trial_.resize(unknowns_);
  for (std::size_t i = 0; i <= unknowns_; ++i) std::copy(point.begin(), point.end(), corner(i).begin());
  values_[0] = value;
  for (std::size_t i = 0; i < unknowns_ && left_ > 0; ++i, --left_) {
    corner(i + 1)[i] += 0.1 * (1.0 + std::abs(point[i]));
    values_[i + 1] = finite_or_worst(function(corner(i + 1)));
  }
}

// The value on the line from the worst corner through the centre of the others: 0 at the centre, -1 at the corner.
double SimplexSearch::try_at(const Function& function, double from_centre) {
  for (std::size_t k = 0; k < unknowns_; ++k) trial_[k] = centre_[k] + from_centre * (centre_[k] - corner(worst_)[k]);
  --left_;
  return finite_or_worst(function(trial_));
}

void SimplexSearch::replace_worst(double value) {
  std::copy(trial_.begin(), trial_.end(), corner(worst_).begin());
  values_[worst_] = value;
}

void SimplexSearch::shrink(const Function& function, std::size_t best) {
  for (std::size_t i = 0; i <= unknowns_ && left_ > 0; ++i) {
    if (i == best) continue;
    for (std::size_t k = 0; k < unknowns_; ++k) corner(i)[k] = 0.5 * (corner(i)[k] + corner(best)[k]);
    values_[i] = finite_or_worst(function(corner(i)));
    --left_;
  }
}

void SimplexSearch::move(const Function& function) {
  const std::size_t best = least();
  double second = -std::numeric_limits<double>::infinity();
  worst_ = static_cast<std::size_t>(std::max_element(values_.begin(), values_.end()) - values_.begin());
  for (std::size_t i = 0; i <= unknowns_; ++i)
    if (i != worst_) second = std::max(second, values_[i]);
  for (std::size_t k = 0; k < unknowns_; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i <= unknowns_; ++i)
      if (i != worst_) sum += corner(i)[k];
    centre_[k] = sum / static_cast<double>(unknowns_);
  }
  const double reflected = try_at(function, 1.0);
  if (reflected < values_[best]) {
    replace_worst(reflected);
    // From the corner just replaced, the centre lies on the other side.
    const double expanded = left_ > 0 ? try_at(function, -2.0) : reflected;
    if (expanded < reflected) replace_worst(expanded);
  } else if (reflected < second) {
    replace_worst(reflected);
  } else {
    if (reflected < values_[worst_]) replace_worst(reflected);
    const double contracted = left_ > 0 ? try_at(function, -0.5) : values_[worst_];
    if (contracted < values_[worst_])
      replace_worst(contracted);
    else
      shrink(function, best);
  }
}

std::size_t SimplexSearch::least() const {
  return static_cast<std::size_t>(std::min_element(values_.begin(), values_.end()) - values_.begin());
}

double SimplexSearch::operator()(const Function& function, std::span<double> point, double value, int evaluations) {
  left_ = evaluations;
  if (point.empty() || evaluations < 1) return value;
  start(function, point, value);
  while (left_ > 0) move(function);
  const std::size_t best = least();
  std::copy(corner(best).begin(), corner(best).end(), point.begin());
  return values_[best];
}

}  // namespace demecal::inline fitness

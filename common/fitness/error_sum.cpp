#include "fitness/fitness.hpp"
#include "primitives/columns.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "errors/check.hpp"
#include "primitives/elementary.hpp"

namespace demecal::inline fitness {
namespace {

DEMECAL_FOR_EACH_VECTOR_UNIT
void add_errors(ErrorSum::Lanes& sums, const double* target, const double* weight, const double* values,
                std::size_t rows) {
  ErrorSum::Lanes lanes = sums;
  for (std::size_t row = 0; row < rows; row += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes[lane] += weight[row + lane] * std::abs(target[row + lane] - values[row + lane]);
  sums = lanes;
}

DEMECAL_FOR_EACH_VECTOR_UNIT
void add_squares(ErrorSum::Lanes& sums, const double* target, const double* weight, const double* values,
                 std::size_t rows) {
  ErrorSum::Lanes lanes = sums;
  for (std::size_t row = 0; row < rows; row += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double error = target[row + lane] - values[row + lane];
      lanes[lane] += weight[row + lane] * (error * error);
    }
  sums = lanes;
}

}  // namespace

ErrorSum::ErrorSum(const std::vector<double>& target, const std::vector<double>& weight, Loss loss)
    : target_(target.begin(), target.end()), weight_(weight.begin(), weight.end()), loss_(loss) {
  DEMECAL_CHECK(target.size() == weight.size(), "targets=" << target.size() << " weights=" << weight.size());
  target_.resize(padded(target.size()), 0.0);
  weight_.resize(padded(weight.size()), 0.0);
}

void ErrorSum::add(Lanes& sums, std::size_t begin, const double* values, std::size_t rows) const {
  const double *const target = target_.data() + begin, *const weight = weight_.data() + begin;
  if (loss_ == Loss::absolute)
    add_errors(sums, target, weight, values, rows);
  else
    add_squares(sums, target, weight, values, rows);
}

double ErrorSum::total(const Lanes& s) {
  const double sum = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  // A row that is not finite makes the sum infinite or no number, even where its weight is zero.
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace demecal::inline fitness

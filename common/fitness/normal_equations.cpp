#include "fitness/constant_fit.hpp"
#include "primitives/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "primitives/elementary.hpp"

namespace demecal::inline fitness {
namespace {

using Lanes = std::array<double, kLanes>;

DEMECAL_FOR_EACH_VECTOR_UNIT
void weigh(const double* column, const double* weight, double* out, std::size_t rows) {
  DEMECAL_ROWS_APART
  for (std::size_t i = 0; i < rows / kLanes * kLanes; ++i) out[i] = column[i] * weight[i];
}

// Adds the products of one column with each of several.
DEMECAL_FOR_EACH_VECTOR_UNIT
void add_products(const double* column, const double* const* others, std::size_t count, Lanes* sums, std::size_t rows) {
  for (std::size_t other = 0; other < count; ++other) {
    const double* const factor = others[other];
    Lanes lanes = sums[other];
    for (std::size_t row = 0; row < rows; row += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        lanes[lane] = std::fma(column[row + lane], factor[row + lane], lanes[lane]);
    sums[other] = lanes;
  }
}

DEMECAL_FOR_EACH_VECTOR_UNIT
void end_sums(const Lanes* sums, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Lanes& s = sums[i];
    out[i] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  }
}

constexpr std::size_t triangle(std::size_t rows) {
  return rows * (rows + 1) / 2;
}

// L D L': row i of the upper triangle becomes column i of L times D.
DEMECAL_FOR_EACH_VECTOR_UNIT
bool solve_in_place(double* matrix, double* inverse_diagonal, double* step, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const double* const pivot = matrix + i * n;
    if (!(pivot[i] > 0.0)) return false;
    inverse_diagonal[i] = 1.0 / pivot[i];
    for (std::size_t j = i + 1; j < n; ++j) {
      const double factor = pivot[j] * inverse_diagonal[i];
      double* const row = matrix + j * n;
      DEMECAL_ROWS_APART
      for (std::size_t k = j; k < n; ++k) row[k] = std::fma(-factor, pivot[k], row[k]);
      step[j] = std::fma(-factor, step[i], step[j]);
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = step[i];
    for (std::size_t j = i + 1; j < n; ++j) sum = std::fma(-matrix[i * n + j], step[j], sum);
    step[i] = sum * inverse_diagonal[i];
    if (!std::isfinite(step[i])) return false;
  }
  return true;
}

}  // namespace

void DampedNormalEquations::clear(std::size_t unknowns) {
  unknowns_ = unknowns;
  const std::size_t count = triangle(unknowns) + unknowns;
  if (sums_.size() < count) {
    sums_.resize(count);
    products_.resize(count);
  }
  if (factor_.size() < unknowns * unknowns) factor_.resize(unknowns * unknowns);
  if (diagonal_.size() < unknowns) diagonal_.resize(unknowns);
  std::fill_n(sums_.begin(), count, Lanes{});
}

void DampedNormalEquations::add(std::span<const double* const> slopes, const double* error, const double* weight,
                                std::size_t rows) {
  alignas(64) Strip weighted;
  for (std::size_t i = 0; i < unknowns_; ++i) {
    weigh(slopes[i], weight, weighted.data(), rows);
    add_products(weighted.data(), slopes.data(), i + 1, sums_.data() + triangle(i), rows);
  }
  weigh(error, weight, weighted.data(), rows);
  add_products(weighted.data(), slopes.data(), unknowns_, sums_.data() + triangle(unknowns_), rows);
}

bool DampedNormalEquations::finish() {
  const std::size_t count = triangle(unknowns_) + unknowns_;
  end_sums(sums_.data(), products_.data(), count);
  return std::all_of(products_.begin(), products_.begin() + static_cast<std::ptrdiff_t>(count),
                     [](double sum) { return std::isfinite(sum); });
}

bool DampedNormalEquations::solve(double damping, std::span<double> step) {
  const std::size_t n = unknowns_;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) factor_[j * n + i] = products_[triangle(i) + j];
  for (std::size_t i = 0; i < n; ++i) {
    double& own = factor_[i * n + i];
    step[i] = own > 0.0 ? products_[triangle(n) + i] : 0.0;
    own = own > 0.0 ? own + damping * own : 1.0;
  }
  return solve_in_place(factor_.data(), diagonal_.data(), step.data(), n);
}

}  // namespace demecal::inline fitness

#include "machine_rates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fitness/fitness.hpp"
#include "primitives/columns.hpp"
#include "primitives/elementary.hpp"
#include "thread_seconds.hpp"

namespace demecal::bench::engine {
namespace {

constexpr std::size_t kRows = 256;
constexpr int kTries = 40;  // the best counts, since others use the machine too

volatile double sink = 0.0;  // keeps the compiler from leaving the work out

template <class Work>
double best_per_s(double units, Work work) {
  double best = 0.0;
  for (int i = 0; i < kTries; ++i) {
    const double begin = thread_seconds();
    work();
    best = std::max(best, units / (thread_seconds() - begin));
  }
  return best;
}

// As many sums as hide the latency of two vector units, of the widest vectors.
constexpr std::size_t kSums = 96;
constexpr int kTurns = 20000;

DEMECAL_FOR_EACH_VECTOR_UNIT
void multiply_and_add(std::array<double, kSums>& sums, double factor, double term) {
  std::array<double, kSums> kept = sums;
  for (int turn = 0; turn < kTurns; ++turn)
    for (std::size_t i = 0; i < kSums; ++i) kept[i] = std::fma(kept[i], factor, term);
  sums = kept;
}

std::vector<double> angles() {
  std::vector<double> column(kRows);
  for (std::size_t i = 0; i < kRows; ++i) column[i] = -3.0 + 6.0 * static_cast<double>(i) / kRows;
  return column;
}

}  // namespace

double measured_fma_per_s() {
  std::array<double, kSums> sums{};
  return best_per_s(static_cast<double>(kSums) * kTurns, [&] {
    multiply_and_add(sums, 0.999, 1e-3);
    sink = sums[0];
  });
}

double measured_sin_per_s() {
  constexpr int kRepeats = 1000;
  const AlignedColumn in = [] {
    const std::vector<double> column = angles();
    return AlignedColumn(column.begin(), column.end());
  }();
  AlignedColumn out(kRows);
  const std::array<ColumnStep, 1> step{make_step(Primitive::sine, {in.data(), 0.0, true}, out.data(), true)};
  return best_per_s(static_cast<double>(kRows) * kRepeats, [&] {
    for (int i = 0; i < kRepeats; ++i) run(step, 0, kRows);
    sink = out[0];
  });
}

double measured_library_sin_per_s() {
  const std::vector<double> in = angles();
  constexpr int kRepeats = 100;
  return best_per_s(static_cast<double>(kRows) * kRepeats, [&] {
    double sum = 0.0;
    for (int i = 0; i < kRepeats; ++i)
      for (const double angle : in) sum += std::sin(angle);
    sink = sum;
  });
}

double measured_error_rows_per_s() {
  constexpr int kRepeats = 1000;
  const ErrorSum errors(angles(), std::vector<double>(kRows, 1.0));
  const AlignedColumn values(kRows, 0.5);
  ErrorSum::Lanes sums{};
  return best_per_s(static_cast<double>(kRows) * kRepeats, [&] {
    for (int i = 0; i < kRepeats; ++i) errors.add(sums, 0, values.data(), kRows);
    sink = sums[0];
  });
}

}  // namespace demecal::bench::engine

// What one core of this machine can do at most, measured beside what the engine does.
#pragma once

namespace demecal::bench::engine {

/// Fused multiply-adds of doubles per second, from registers.
double measured_fma_per_s();
/// Sines per second of a column in the first-level cache, by the engine's own kernel.
double measured_sin_per_s();
/// Sines per second one by one by the C library.
double measured_library_sin_per_s();
/// Rows per second that a sum of absolute errors takes in, from the first-level cache.
double measured_error_rows_per_s();

}  // namespace demecal::bench::engine

// How soon the engine finds a smooth law in few noisy rows, and whether it overfits when it goes on.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"

namespace demecal::bench::engine {

/// y = 0.003 sin t + 0.0012 cos 2t - 0.0008 t and normal noise of 1e-4, t uniform in [-2.5, 2.5].
struct AccuracyLesson {
  static constexpr double kScale = 1e-3;  ///< of the targets, as calibrations scale theirs
  TrainingTable training;                 ///< 30 rows
  TrainingTable validation;               ///< 30 rows
  TrainingTable unseen;                   ///< 1000 rows that have no part in anything
};
AccuracyLesson accuracy_lesson(std::uint64_t seed);

/// Small islands one after the other, whose formulas are scaled and inherit fitted constants.
GpParameters accuracy_parameters();

struct AccuracyFigures {
  static constexpr double kTarget = 1.3e-4;  ///< root mean square of the validation errors
  std::uint64_t seed = 0;
  double seconds = 0.0;
  double ms_to_target = 0.0;     ///< processor time; not a number where it was never reached
  double validation_rmse = 0.0;  ///< of the model chosen when all seconds are over
  double unseen_rmse = 0.0;      ///< of the same model
  double law_rmse = 0.0;         ///< on the validation rows, of the law itself fitted to the training rows
  std::size_t nodes = 0;         ///< of the model
};

/// Evolves for `seconds` of processor time.
AccuracyFigures measure_accuracy(std::uint64_t seed, double seconds);

}  // namespace demecal::bench::engine

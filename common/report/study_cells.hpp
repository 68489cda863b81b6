// The figures of a study's cell over its seeds.
#pragma once

#include <optional>

#include "fitting/median_interval.hpp"
#include "report/study.hpp"

namespace demecal {

struct StudyCell {
  std::size_t runs = 0;
  /// Nothing where there is no run, or one without such poses.
  std::optional<MedianInterval> calibration_mm, validation_mm, accept_mm, nodes, evaluations, wall_s;
};

/// One for every cell, in their order.
std::vector<StudyCell> study_cells(const Study& study);

}  // namespace demecal

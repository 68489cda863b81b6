#include "report/study_cells.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

template <class Figure>
std::optional<MedianInterval> interval_of(const std::vector<StudyRun>& runs, Figure StudyRun::*figure) {
  std::vector<double> values;
  for (const StudyRun& run : runs) values.push_back(static_cast<double>(run.*figure));
  const bool all = std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (values.empty() || !all) return std::nullopt;
  return median_interval(std::move(values));
}

}  // namespace

std::vector<StudyCell> study_cells(const Study& study) {
  std::vector<StudyCell> cells;
  for (std::size_t i = 0; i < study.cells.size(); ++i) {
    std::vector<StudyRun> runs;
    for (const StudyRun& run : study.runs) {
      if (run.cell == i) runs.push_back(run);
    }
    cells.push_back({runs.size(), interval_of(runs, &StudyRun::calibration_mm),
                     interval_of(runs, &StudyRun::validation_mm), interval_of(runs, &StudyRun::accept_mm),
                     interval_of(runs, &StudyRun::nodes), interval_of(runs, &StudyRun::evaluations),
                     interval_of(runs, &StudyRun::wall_s)});
  }
  return cells;
}

}  // namespace demecal

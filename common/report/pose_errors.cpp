#include "report/pose_errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "effects/measurement.hpp"
#include "fitting/median.hpp"
#include "kinematics/units.hpp"

namespace demecal {
std::vector<PoseErrorLine> pose_errors(const DataSet& data, const CalibratedModel& model, const CorrectedRobot& robot,
                                       const CorrectedRobot* before) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<PoseErrorLine> lines;
  for (const MeasuredPose& pose : data.poses) {
    PoseErrorLine line{.id = pose.pose_id, .target = pose.target, .set = std::string(to_string(pose.set))};
    line.before_mm = before == nullptr ? kUnknown : millimetres(tool_error_m(*before, data, pose));
    line.after_mm = millimetres(tool_error_m(robot, data, pose));
    line.interval95_mm = model.posterior && model.interval
                             ? millimetres(radius95_m(*model.interval, *model.posterior, robot, data, pose))
                             : kUnknown;
    lines.push_back(std::move(line));
  }
  return lines;
}

IntervalCoverage coverage_of(const std::vector<PoseErrorLine>& lines) {
  IntervalCoverage coverage;
  std::vector<double> radii_mm;
  for (const PoseErrorLine& line : lines) {
    if (line.set != to_string(PoseSet::accept) || !std::isfinite(line.after_mm) || !std::isfinite(line.interval95_mm))
      continue;
    ++coverage.poses;
    coverage.inside += line.after_mm <= line.interval95_mm ? 1 : 0;
    radii_mm.push_back(line.interval95_mm);
  }
  if (!radii_mm.empty()) coverage.median_mm = median(radii_mm);
  return coverage;
}

std::string sentence_of(const PredictionInterval& interval) {
  constexpr std::size_t kFewest = 19;
  const std::string poses =
      fmt::format("{} distinct {} poses", interval.poses, interval.fitted ? "calibration" : "validation");
  std::string text = interval.fitted ? "no validation poses: the intervals come from " + poses +
                                           ", to which the model was fitted, and may be too narrow"
                                     : "the intervals come from " + poses + " while they were unseen";
  if (interval.poses < kFewest) text += "; too few for an empirical quantile: normal errors are assumed";
  if (interval.gross_errors > 0)
    text += fmt::format("; {} far out left out: intervals hold for poses measured without gross errors",
                        interval.gross_errors);
  return text;
}

}  // namespace demecal

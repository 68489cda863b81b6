// What preparation yields besides the data set: how far the robot is off before calibration, and where to send it
// uncorrected so that it arrives all the same.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/measurement.hpp"
#include "preparation/prepared.hpp"

namespace demecal::inline preparation {

/// The errors of a set as one frame shows them.
struct FrameFigures {
  ErrorFigures error{};                                          ///< of the distances, mm
  Eigen::Vector3d mean_difference_mm = Eigen::Vector3d::Zero();  ///< measured - nominal, base axes
};

struct SetStatistic {
  PoseSet set = PoseSet::calibration;
  std::size_t poses = 0, readings = 0;
  std::optional<double> spread_mm{};          ///< of one reading about its pose's mean; where poses have several
  std::optional<double> standard_error_mm{};  ///< of a point by the cords' own, root mean square; where that is stated
  std::optional<FrameFigures> three_points, best_fit;
};

struct FrameDifference {
  double mean_mm = 0.0, max_mm = 0.0;  ///< distances of the measured points as the two frames place them
  double turn_deg = 0.0;               ///< between the frames
};

struct ErrorStatistic {
  std::vector<SetStatistic> sets{};  ///< those that have poses
  std::optional<FrameDifference> apart;
  std::optional<double> taught_difference_mm{};  ///< largest, of the distances between the three points
  bool fitted_to_calibration = true;
};

ErrorStatistic error_statistic(const RawMeasurements& raw, const Prepared& prepared);

/// A table of both frames side by side, and sentences about what they differ by; at most 100 columns.
std::string statistic_table(const ErrorStatistic& statistic, const std::string& name);

/// One JSON object on one line: {"name", "frame", "sets": {"calibration": {"poses", "readings", "spread_mm",
/// "three_points": {"mean", "rms", "p95", "max", "mean_difference"}, "best_fit": ...}}, "frames_apart", "files"}; what
/// does not exist is null. `frame` is the data set's.
std::string statistic_json(const ErrorStatistic& statistic, const std::string& name, const std::string& frame,
                           const std::vector<std::string>& files);

/// A file to be written beside the data set.
struct WrittenFile {
  std::string name;
  std::string text;
};

/// False targets: nominal - (measured - nominal). Of sets whose programmed poses stand in a VAL II file, that file with
/// their translations replaced, in its own scale and rounding, all else kept: "corrected.v2", and for further files
/// "corrected-SET.v2" (with a number where that is taken). Of all other sets the positions, as "corrected.csv".
std::vector<WrittenFile> false_targets(const RawMeasurements& raw, const Prepared& prepared, FrameKind kind);

/// "errors.csv": of every pose nominal, measured and measured - nominal in base axes, the distance, how many readings,
/// their spread, and, where the cords' standard error is stated, that of x, y, z in the instrument's frame; mm.
WrittenFile errors_file(const Prepared& prepared, FrameKind kind);

}  // namespace demecal::inline preparation

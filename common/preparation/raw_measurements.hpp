// Everything that preparation starts from, as read from its files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "preparation/named_points.hpp"
#include "preparation/taught_points.hpp"

namespace demecal {

/// One run through a program's points while the instrument read.
struct RawSet {
  PoseSet set = PoseSet::calibration;
  PointFile joints;
  std::string points;              ///< the array of precision points; empty: all
  std::optional<PointFile> poses;  ///< the programmed poses, where they are in a file of their own
  std::string pose_points;         ///< their array; empty: all
  Readings readings;
};

/// What becomes of several readings of one pose.
enum class Repeats {
  average,  ///< one row with their mean
  keep      ///< a row each, repeats of one pose: the data set then has a noise floor
};

struct RawMeasurements {
  std::string name;
  std::string file;  ///< the preparation file, as named to the user
  Robot robot;
  std::optional<TaughtPoints> local_frame;
  Repeats repeats = Repeats::average;
  std::vector<RawSet> sets;  ///< one at least
};

}  // namespace demecal

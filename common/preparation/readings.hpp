// What an instrument read, as points in its own frame: cord lengths or coordinates, several readings of a pose
// averaged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "preparation/trilateration.hpp"

namespace demecal {

/// Three cords, each made of what its unit measures and of a top cord of fixed length between that and the tool.
struct CordInstrument {
  CordCorners corners;
  PlaneSide side = PlaneSide::above;
  Eigen::Vector3d top_cords_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> counts_per_m;            ///< of the encoders, from the calibration bar
  Eigen::Vector3d zero_counts = Eigen::Vector3d::Zero();  ///< where nothing of the cord is out
  std::optional<double> standard_error_m;                 ///< of a cord's length
};

/// One row of a file of readings.
struct Reading {
  std::string pose{};  ///< as the file names it; empty where it has no column for that
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> standard_error_m{};  ///< of x, y, z; where the cords' is known
  std::size_t line = 0;
};

struct Readings {
  std::string file;
  std::vector<Reading> rows;
  bool named = false;  ///< whether there is a column that says which pose
};

/// The readings of a table with one of a_counts, b_counts, c_counts; a_mm, b_mm, c_mm (what the units measured, without
/// the top cords); or x_mm, y_mm, z_mm; and, where rows are named, a column pose, pose_id or point. `cords` is needed
/// for the first two. Throws InputError where columns are missing or of two kinds, a cell is no number, a length is not
/// positive, or cords do not meet.
Readings read_readings(const CsvTable& table, const std::optional<CordInstrument>& cords);

/// Several readings of one pose.
struct AveragedReading {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< their mean
  double squares_m2 = 0.0;                            ///< sum of squared distances from it
  std::optional<Eigen::Vector3d> standard_error_m{};  ///< of the mean
  std::vector<std::size_t> rows;                      ///< in Readings::rows, in their order

  /// sqrt(squares / (n - 1)): how far one reading is off; nothing where there is one alone.
  std::optional<double> spread_m() const;
};

/// `rows` has one at least.
AveragedReading average(const Readings& readings, const std::vector<std::size_t>& rows);

}  // namespace demecal

// What an instrument read, as points in its own frame: coordinates, or the lengths of three cords, which three spheres
// bring together (thesis A.1); several readings of a pose averaged.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"

namespace demecal::inline preparation {

/// The sides of the triangle of the three places where the cords come out, m.
struct CordTriangle {
  double ab_m = 0.0, bc_m = 0.0, ca_m = 0.0;
};

/// The triangle in the instrument's frame: A in the origin, B on the positive x axis, C at positive y, z = 0.
struct CordCorners {
  double b_x_m = 0.0;  ///< B = (b_x, 0, 0)
  double c_x_m = 0.0;  ///< C = (c_x, c_y, 0); the thesis's g and h
  double c_y_m = 0.0;
};

/// Nothing where the sides make no triangle, or one whose height over AB is below a thousandth of its longest side.
std::optional<CordCorners> cord_corners(const CordTriangle& triangle);

/// On which side of the triangle's plane the point is: positive or negative z.
enum class PlaneSide { above, below };

struct CordPoint {
  double height_squared_m2 = 0.0;                        ///< z^2; not positive: the cords do not meet off the plane
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();     ///< in the instrument's frame
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();  ///< of x, y, z (rows) by the lengths of a, b, c (columns)

  bool meets() const { return height_squared_m2 > 0.0; }
};

/// The point at distances `cords_m` from A, B and C. With (g, h) = C and l = |AB|, the three spheres (thesis A.1 to
/// A.3)
///   a^2 = x^2 + y^2 + z^2,  b^2 = (l - x)^2 + y^2 + z^2,  c^2 = (x - g)^2 + (h - y)^2 + z^2
/// give x from the first two, y from the first and the third, and z from what is left of the first. Where z^2 is not
/// positive (a point in the plane itself has no derivative), only `height_squared_m2` is set.
CordPoint trilaterate(const CordCorners& corners, const Eigen::Vector3d& cords_m, PlaneSide side);

/// The distances of a point from A, B and C, m.
Eigen::Vector3d cord_lengths(const CordCorners& corners, const Eigen::Vector3d& point_m);

/// Covariance of x, y, z, m^2, where every cord has the standard error `cord_m`, independently of the others.
Eigen::Matrix3d covariance_of(const CordPoint& point, double cord_m);

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
struct InstrumentReading {
  std::string pose{};  ///< as the file names it; empty where it has no column for that
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> standard_error_m{};  ///< of x, y, z; where the cords' is known
  std::size_t line = 0;
};

struct Readings {
  std::string file;
  std::vector<InstrumentReading> rows;
  bool named = false;  ///< whether there is a column that says which pose
};

/// Columns of points that a table of another program has by other names than those of read_readings().
struct PointColumns {
  std::vector<ColumnName> position{};  ///< x, y, z, or none
  std::optional<ColumnName> pose{};
  AssumedUnits units{};  ///< of a position whose headings state none
};

/// The readings of a table with one of a_counts, b_counts, c_counts; a_mm, b_mm, c_mm (what the units measured, without
/// the top cords); or x_mm, y_mm, z_mm; and, where rows are named, a column pose, pose_id or point. `cords` is needed
/// for the first two. Throws InputError where columns are missing or of two kinds, a cell is no number, a length is not
/// positive, or cords do not meet. `other`: what is read where columns of these names are missing.
Readings read_readings(const CsvTable& table, const std::optional<CordInstrument>& cords,
                       const PointColumns& other = {});

/// Whether the table has one of the columns of read_readings() for what was read.
bool has_columns_of_readings(const CsvTable& table);

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

/// The text of a table with the names in quotes where every row begins with one, as in "#cp[3],1,2,3"; the text itself
/// where none does. Throws InputError where some rows do: they may be readings, or rows that were taken out.
std::string with_marked_names(const std::string& text, const std::string& file);

}  // namespace demecal::inline preparation

#include "preparation/readings.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "data/columns.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline preparation {
namespace {

constexpr double kFlattest = 1e-3;  // of the longest side

Eigen::Vector3d corner_b(const CordCorners& corners) {
  return {corners.b_x_m, 0.0, 0.0};
}
Eigen::Vector3d corner_c(const CordCorners& corners) {
  return {corners.c_x_m, corners.c_y_m, 0.0};
}

/// By the implicit function theorem: each sphere's gradient at the point, over its radius, is the direction of its
/// cord, so that the derivative is the inverse of the matrix of these directions.
Eigen::Matrix3d derivative_at(const CordCorners& corners, const Eigen::Vector3d& point_m) {
  Eigen::Matrix3d directions;
  directions.row(0) = point_m.normalized();
  directions.row(1) = (point_m - corner_b(corners)).normalized();
  directions.row(2) = (point_m - corner_c(corners)).normalized();
  return directions.inverse();
}

enum class ReadingKind { counts, cords, points };
struct ReadingColumns {
  ReadingKind kind;
  std::array<const char*, 3> names;
};
constexpr std::array<ReadingColumns, 3> kReadingColumns{{{ReadingKind::counts, {"a_counts", "b_counts", "c_counts"}},
                                                         {ReadingKind::cords, {"a_mm", "b_mm", "c_mm"}},
                                                         {ReadingKind::points, {"x_mm", "y_mm", "z_mm"}}}};
constexpr std::array<const char*, 3> kPoseColumns{"pose", "pose_id", "point"};

/// The kind of readings whose columns the table has; `other` are none of these.
const ReadingColumns& kind_of(const CsvTable& table, const PointColumns& other) {
  const ReadingColumns* found = nullptr;
  for (const ReadingColumns& kind : kReadingColumns) {
    for (const char* name : kind.names) {
      if (!table.find(name) || found == &kind) continue;
      if (found != nullptr) {
        throw InputError({table.file, table.header_line}, name,
                         std::string("stands beside ") + found->names[0] +
                             "; readings are counts, cord lengths or coordinates, not two of these");
      }
      found = &kind;
    }
  }
  if (found != nullptr) return *found;
  if (!other.position.empty()) return kReadingColumns.back();
  throw InputError({table.file, table.header_line}, "",
                   "the header has none of the columns of readings: a_counts, b_counts, c_counts; a_mm, b_mm, c_mm; "
                   "or x_mm, y_mm, z_mm (or x, y, z with a unit)");
}

class ReadingTable {
 public:
  ReadingTable(const CsvTable& table, const std::optional<CordInstrument>& cords, const PointColumns& other)
      : table_(table), cords_(cords), kind_(kind_of(table, other)), by_others_(!has_columns_of_readings(table)) {
    const InputError::Where header{table.file, table.header_line};
    for (std::size_t i = 0; i < kind_.names.size(); ++i) {
      by_others_ ? columns_.emplace_back(table, other.position[i], Quantity::length, other.units)
                 : columns_.emplace_back(table, ColumnName{kind_.names[i], header});
    }
    for (const char* name : kPoseColumns) {
      if (!pose_ && table.find(name)) pose_.emplace(table, ColumnName{name, header});
    }
    if (!pose_ && other.pose) pose_.emplace(table, *other.pose);
    if (kind_.kind == ReadingKind::points) return;
    if (!cords_) {
      throw InputError(header, kind_.names[0], "is of a cord, but the preparation file describes no instrument.cords");
    }
    if (kind_.kind == ReadingKind::counts && !cords_->counts_per_m) {
      throw InputError(header, kind_.names[0],
                       "is in counts, but the preparation file has no instrument.cords.encoders");
    }
  }

  Readings read() const {
    Readings readings{table_.file, {}, pose_.has_value()};
    for (const CsvRow& row : table_.rows) readings.rows.push_back(read(row));
    return readings;
  }

 private:
  InstrumentReading read(const CsvRow& row) const {
    InstrumentReading reading{.line = row.line};
    if (pose_) {
      reading.pose = pose_->text(row);
      if (reading.pose.empty()) pose_->fail(row, "is empty where the name or number of a pose is expected");
    }
    Eigen::Vector3d values;
    for (Eigen::Index i = 0; i < 3; ++i) values[i] = columns_[static_cast<std::size_t>(i)].number(row);
    if (kind_.kind == ReadingKind::points) {
      reading.point_m = by_others_ ? values : Eigen::Vector3d(metres(1.0) * values);
    } else {
      trilaterate_row(row, values, reading);
    }
    return reading;
  }

  /// Lengths of the whole cords, m.
  Eigen::Vector3d whole_cords(const CsvRow& row, const Eigen::Vector3d& values) const {
    Eigen::Vector3d lengths_m = metres(1.0) * values;
    if (kind_.kind == ReadingKind::counts)
      lengths_m = (values - cords_->zero_counts).cwiseQuotient(*cords_->counts_per_m);
    lengths_m += cords_->top_cords_m;
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (lengths_m[i] > 0.0) continue;
      columns_[static_cast<std::size_t>(i)].fail(
          row, fmt::format("makes a cord of {:.6g} mm; its length must be positive", millimetres(lengths_m[i])));
    }
    return lengths_m;
  }

  void trilaterate_row(const CsvRow& row, const Eigen::Vector3d& values, InstrumentReading& reading) const {
    const Eigen::Vector3d lengths_m = whole_cords(row, values);
    const CordPoint point = trilaterate(cords_->corners, lengths_m, cords_->side);
    if (!point.meets()) {
      const Eigen::Vector3d mm = 1e3 * lengths_m;
      throw InputError({table_.file, row.line}, "",
                       fmt::format("cords of {:.6g}, {:.6g} and {:.6g} mm do not meet above or below the triangle: z^2 "
                                   "would be {:.6g} mm^2 and must be positive",
                                   mm[0], mm[1], mm[2], 1e6 * point.height_squared_m2));
    }
    reading.point_m = point.point_m;
    if (cords_->standard_error_m) {
      reading.standard_error_m = covariance_of(point, *cords_->standard_error_m).diagonal().cwiseSqrt();
    }
  }

  const CsvTable& table_;
  const std::optional<CordInstrument>& cords_;
  const ReadingColumns& kind_;
  bool by_others_;  ///< columns of points in their own unit
  std::vector<TableColumn> columns_;
  std::optional<TableColumn> pose_;
};

/// The length of "#name[i]" that a line begins with and a separator follows; 0 where there is none.
std::size_t marked_name(std::string_view line) {
  const std::size_t end = line.find_first_of(",;\t");
  if (!line.starts_with('#') || end == std::string_view::npos) return 0;
  const std::string_view name = line.substr(0, end);
  const bool indexed = name.ends_with(']') && name.find('[') > 1 && name.find_first_of(" \t\"") == name.npos;
  return indexed ? end : 0;
}

}  // namespace

std::optional<CordCorners> cord_corners(const CordTriangle& triangle) {
  const double ab = triangle.ab_m, bc = triangle.bc_m, ca = triangle.ca_m;
  const double longest = std::max({ab, bc, ca});
  if (!(ab > 0.0 && bc > 0.0 && ca > 0.0)) return std::nullopt;
  const double g = (ca * ca - bc * bc + ab * ab) / (2.0 * ab);
  const double h_squared = ca * ca - g * g;
  if (!(h_squared > kFlattest * kFlattest * longest * longest)) return std::nullopt;
  return CordCorners{ab, g, std::sqrt(h_squared)};
}

CordPoint trilaterate(const CordCorners& corners, const Eigen::Vector3d& cords_m, PlaneSide side) {
  const double l = corners.b_x_m, g = corners.c_x_m, h = corners.c_y_m;
  const Eigen::Vector3d squares = cords_m.cwiseAbs2();
  const double x = (squares[0] - squares[1] + l * l) / (2.0 * l);
  const double y = (squares[0] - squares[2] - 2.0 * g * x + g * g + h * h) / (2.0 * h);
  CordPoint found{.height_squared_m2 = squares[0] - x * x - y * y};
  if (!found.meets()) return found;
  const double z = std::sqrt(found.height_squared_m2);
  found.point_m = {x, y, side == PlaneSide::above ? z : -z};
  found.derivative = derivative_at(corners, found.point_m);
  return found;
}

Eigen::Vector3d cord_lengths(const CordCorners& corners, const Eigen::Vector3d& point_m) {
  return {point_m.norm(), (point_m - corner_b(corners)).norm(), (point_m - corner_c(corners)).norm()};
}

Eigen::Matrix3d covariance_of(const CordPoint& point, double cord_m) {
  return cord_m * cord_m * point.derivative * point.derivative.transpose();
}

bool has_columns_of_readings(const CsvTable& table) {
  return std::ranges::any_of(kReadingColumns, [&](const ReadingColumns& kind) {
    return std::ranges::any_of(kind.names, [&](const char* name) { return table.find(name).has_value(); });
  });
}

Readings read_readings(const CsvTable& table, const std::optional<CordInstrument>& cords, const PointColumns& other) {
  return ReadingTable(table, cords, other).read();
}

std::optional<double> AveragedReading::spread_m() const {
  if (rows.size() < 2) return std::nullopt;
  return std::sqrt(squares_m2 / static_cast<double>(rows.size() - 1));
}

AveragedReading average(const Readings& readings, const std::vector<std::size_t>& rows) {
  DEMECAL_CHECK(!rows.empty(), "nothing to average");
  const auto count = static_cast<double>(rows.size());
  AveragedReading mean{.rows = rows};
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();
  bool stated = true;
  for (const std::size_t row : rows) {
    mean.point_m += readings.rows[row].point_m / count;
    stated = stated && readings.rows[row].standard_error_m;
    if (stated) variances += readings.rows[row].standard_error_m->cwiseAbs2() / (count * count);
  }
  for (const std::size_t row : rows) mean.squares_m2 += (readings.rows[row].point_m - mean.point_m).squaredNorm();
  if (stated) mean.standard_error_m = variances.cwiseSqrt();
  return mean;
}

std::string with_marked_names(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  std::string quoted;
  std::size_t number = 0, first_marked = 0, plain = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (const std::size_t name = marked_name(line); name > 0) {
      if (first_marked == 0) first_marked = number;
      line.insert(name, "\"").insert(0, "\"");
    } else if (line.find_first_not_of(" \t\r") != std::string::npos && line[0] != '#') {
      ++plain;
    }
    quoted += line + '\n';
  }
  if (first_marked == 0) return text;
  if (plain <= 1) return quoted;  // the header
  throw InputError({file, first_marked}, "",
                   "begins with # as comments do, and other rows do not; leave the # of its name out, or put a space "
                   "after it where a comment is meant");
}

}  // namespace demecal::inline preparation

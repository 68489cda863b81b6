#include "preparation/readings.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "data/columns.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

enum class Kind { counts, cords, points };
struct KindColumns {
  Kind kind;
  std::array<const char*, 3> names;
};
constexpr std::array<KindColumns, 3> kKinds{{{Kind::counts, {"a_counts", "b_counts", "c_counts"}},
                                             {Kind::cords, {"a_mm", "b_mm", "c_mm"}},
                                             {Kind::points, {"x_mm", "y_mm", "z_mm"}}}};
constexpr std::array<const char*, 3> kPoseColumns{"pose", "pose_id", "point"};

/// The kind of readings whose columns the table has.
const KindColumns& kind_of(const CsvTable& table) {
  const KindColumns* found = nullptr;
  for (const KindColumns& kind : kKinds) {
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
  throw InputError({table.file, table.header_line}, "",
                   "the header has none of the columns of readings: a_counts, b_counts, c_counts; a_mm, b_mm, c_mm; "
                   "or x_mm, y_mm, z_mm");
}

class ReadingRows {
 public:
  ReadingRows(const CsvTable& table, const std::optional<CordInstrument>& cords)
      : table_(table), cords_(cords), kind_(kind_of(table)) {
    const InputError::Where header{table.file, table.header_line};
    for (const char* name : kind_.names) columns_.emplace_back(table, ColumnName{name, header});
    for (const char* name : kPoseColumns) {
      if (!pose_ && table.find(name)) pose_.emplace(table, ColumnName{name, header});
    }
    if (kind_.kind == Kind::points) return;
    if (!cords_) {
      throw InputError(header, kind_.names[0], "is of a cord, but the preparation file describes no instrument.cords");
    }
    if (kind_.kind == Kind::counts && !cords_->counts_per_m) {
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
  Reading read(const CsvRow& row) const {
    Reading reading{.line = row.line};
    if (pose_) {
      reading.pose = pose_->text(row);
      if (reading.pose.empty()) pose_->fail(row, "is empty where the name or number of a pose is expected");
    }
    Eigen::Vector3d values;
    for (Eigen::Index i = 0; i < 3; ++i) values[i] = columns_[static_cast<std::size_t>(i)].number(row);
    if (kind_.kind == Kind::points) {
      reading.point_m = metres(1.0) * values;
    } else {
      meet(row, values, reading);
    }
    return reading;
  }

  /// Lengths of the whole cords, m.
  Eigen::Vector3d whole_cords(const CsvRow& row, const Eigen::Vector3d& values) const {
    Eigen::Vector3d lengths_m = metres(1.0) * values;
    if (kind_.kind == Kind::counts) lengths_m = (values - cords_->zero_counts).cwiseQuotient(*cords_->counts_per_m);
    lengths_m += cords_->top_cords_m;
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (lengths_m[i] > 0.0) continue;
      columns_[static_cast<std::size_t>(i)].fail(
          row, fmt::format("makes a cord of {:.6g} mm; its length must be positive", millimetres(lengths_m[i])));
    }
    return lengths_m;
  }

  void meet(const CsvRow& row, const Eigen::Vector3d& values, Reading& reading) const {
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
  const KindColumns& kind_;
  std::vector<TableColumn> columns_;
  std::optional<TableColumn> pose_;
};

}  // namespace

Readings read_readings(const CsvTable& table, const std::optional<CordInstrument>& cords) {
  return ReadingRows(table, cords).read();
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

}  // namespace demecal

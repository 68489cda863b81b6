// Rows of several tables that tell of one pose, put together: by the name of the point, in their order, or by time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "data/read_poses.hpp"

namespace demecal::inline tables {

enum class JoinBy { name, order, time };

/// What to do with rows that have no partner.
enum class Unmatched { refuse, leave_out };

struct JoinRule {
  JoinBy by = JoinBy::name;
  Unmatched unmatched = Unmatched::refuse;
  double within_s = 0.0;                 ///< how far apart the times of one pose may be
  std::optional<double> offset_s = 0.0;  ///< to add to the other tables' times; nothing: it is found
};

/// What a table is joined by, one a row; empty where it does not take part.
struct JoinKeys {
  std::vector<std::string> names;
  std::vector<double> times_s;
};

/// What the arm and the instrument say of the rows, m: by it an unknown offset of clocks is found. Empty where a table
/// does not say it.
struct JoinPoints {
  std::vector<Eigen::Vector3d> measured_m;           ///< of the leading table
  std::vector<Eigen::Isometry3d> flanges;            ///< of the table with the joints, by the nominal arm, base frame
  Eigen::Vector3d tool_m = Eigen::Vector3d::Zero();  ///< as the arm's file has it, flange frame
};

/// An offset of clocks that was found.
struct ClockOffset {
  double offset_s = 0.0;
  double misfit_m = 0.0;                                     ///< that measured and predicted points are left with
  double rival_m = std::numeric_limits<double>::infinity();  ///< the same at the best offset that gives other joints
  std::optional<Eigen::Vector3d> tool_m{};                   ///< where it had to be fitted, flange frame
};

struct JoinedRows {
  std::vector<std::vector<std::size_t>> rows;  ///< per pose: its row in each table
  std::string sentence;                        ///< how they were joined, for people
};

/// One pose for every row of table `lead`. Throws InputError at the first row that does not fit.
JoinedRows join_by_name(const std::vector<CsvTable>& tables, const std::vector<JoinKeys>& keys, std::size_t lead,
                        Unmatched unmatched);
JoinedRows join_by_order(const std::vector<CsvTable>& tables, std::size_t lead);
/// Every row of the leading table takes the row of each other table that is nearest in time.
JoinedRows join_by_time(const std::vector<CsvTable>& tables, const std::vector<JoinKeys>& keys, std::size_t lead,
                        const JoinRule& rule, double offset_s);

/// Whole days to add to the times of another table, both being of clocks without dates: where more rows of the leading
/// one then have a partner than as the times stand, -1 or 1, with how many.
struct WholeDays {
  int days = 0;
  std::size_t partners = 0, as_given = 0;  ///< rows of the leading table that have one with these days, and without
};
WholeDays find_whole_days(const JoinKeys& lead, const JoinKeys& other, double within_s, double offset_s);

/// The offset by which distances between measured points are those between the points that the arm predicts at the
/// joints of the rows nearest in time; where its tool does not suit, that by which base and tool of least squares bring
/// the flanges nearest to the points. Throws InputError where no offset fits, or several do that would give other
/// joints.
ClockOffset find_offset(const CsvTable& lead, const JoinKeys& lead_keys, const CsvTable& other,
                        const JoinKeys& other_keys, const JoinPoints& points, double within_s);

}  // namespace demecal::inline tables

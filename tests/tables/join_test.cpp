// Rows of several tables put together: every measured row gets its partner, or the first that has none is named.
#include "tables/join.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../errors/complaint.hpp"
#include "random/random_stream.hpp"
#include "tables/read_table.hpp"
#include "tables/time_stamp.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

CsvTable table_of_rows(const std::string& file, std::size_t rows) {
  CsvTable table{.file = file, .header_line = 1, .columns = {"a"}, .rows = {}};
  for (std::size_t row = 0; row < rows; ++row) table.rows.push_back({row + 2, {"0"}});
  return table;
}

/// Two tables of the same names, the second in another order.
struct NamedPair {
  std::vector<CsvTable> tables;
  std::vector<JoinKeys> keys{2};
};

NamedPair shuffled_pair(RandomStream& random, std::size_t rows) {
  NamedPair pair{{table_of_rows("m.txt", rows), table_of_rows("j.csv", rows)}};
  for (std::size_t row = 0; row < rows; ++row) pair.keys[0].names.push_back("P" + std::to_string(row));
  pair.keys[1].names = pair.keys[0].names;
  for (std::size_t i = rows; i > 1; --i) std::swap(pair.keys[1].names[i - 1], pair.keys[1].names[random.index(i)]);
  return pair;
}

TEST(JoinByName, FindsTheRowOfTheSameNameInWhateverOrder) {
  RandomStream random{81};
  for (int trial = 0; trial < 20; ++trial) {
    const NamedPair pair = shuffled_pair(random, 2 + random.index(30));
    const JoinedRows joined = join_by_name(pair.tables, pair.keys, 0, Unmatched::refuse);
    ASSERT_EQ(joined.rows.size(), pair.tables[0].rows.size());
    for (const auto& pose : joined.rows) EXPECT_EQ(pair.keys[0].names[pose[0]], pair.keys[1].names[pose[1]]);
  }
}

TEST(JoinByName, LetsRepeatsOfAMeasurementShareARow) {
  NamedPair pair{{table_of_rows("m.txt", 3), table_of_rows("j.csv", 2)}};
  pair.keys[0].names = {"A", "B", "A"};
  pair.keys[1].names = {"B", "A"};
  const JoinedRows joined = join_by_name(pair.tables, pair.keys, 0, Unmatched::refuse);
  EXPECT_EQ(joined.rows[0][1], 1u);
  EXPECT_EQ(joined.rows[2][1], 1u);
}

TEST(JoinByName, RefusesTheFirstRowWithoutAPartnerOrLeavesItOut) {
  NamedPair pair{{table_of_rows("m.txt", 3), table_of_rows("j.csv", 3)}};
  pair.keys[0].names = {"P1", "P2", "Q3"};
  pair.keys[1].names = {"P1", "P2", "P3"};
  EXPECT_THAT(complaint([&] { join_by_name(pair.tables, pair.keys, 0, Unmatched::refuse); }),
              HasSubstr("m.txt:4: 'Q3': is the name of no point of j.csv; the nearest is 'P3'"));
  EXPECT_EQ(join_by_name(pair.tables, pair.keys, 0, Unmatched::leave_out).rows.size(), 2u);
  pair.keys[0].names = {"P1", "P2", "P2"};
  EXPECT_THAT(complaint([&] { join_by_name(pair.tables, pair.keys, 0, Unmatched::refuse); }),
              HasSubstr("j.csv:4: 'P3': is the name of no point of m.txt"));
  pair.keys[1].names = {"P1", "P2", "P2"};
  EXPECT_THAT(complaint([&] { join_by_name(pair.tables, pair.keys, 0, Unmatched::refuse); }),
              HasSubstr("j.csv:4: 'P2': names the point of line 3 again"));
}

TEST(JoinByName, NamesThePointThatStandsTwiceWhereOneIsMissing) {
  NamedPair pair{{table_of_rows("m.txt", 3), table_of_rows("j.csv", 3)}};
  pair.keys[0].names = {"P11", "P7", "P11"};
  pair.keys[1].names = {"P7", "P11", "P12"};
  EXPECT_THAT(complaint([&] { join_by_name(pair.tables, pair.keys, 0, Unmatched::refuse); }),
              HasSubstr("'P12': is the name of no point of m.txt; the nearest is 'P11'. 'P11' stands there twice, on "
                        "lines 2 and 4: is one of these the point?"));
  EXPECT_EQ(join_by_name(pair.tables, pair.keys, 0, Unmatched::leave_out).sentence,
            "3 rows joined by name; 1 row has no partner and is left out: 'P12' (j.csv:4)");
}

TEST(JoinByOrder, RefusesTheFirstRowTooMany) {
  const std::vector<CsvTable> tables{table_of_rows("m.txt", 4), table_of_rows("j.csv", 3)};
  EXPECT_THAT(complaint([&] { join_by_order(tables, 0); }), HasSubstr("m.txt:5: is row 4, but j.csv has only 3"));
  const std::vector<CsvTable> alike{table_of_rows("m.txt", 3), table_of_rows("j.csv", 3)};
  EXPECT_EQ(join_by_order(alike, 0).rows[2][1], 2u);
}

/// A log of an arm that goes from pose to pose and stands for a while at each, and measurements while it stands.
struct LoggedArm {
  std::vector<CsvTable> tables;
  std::vector<JoinKeys> keys{2};
  JoinPoints points;
  std::vector<std::size_t> pose_of_log_row;  ///< the pose it stands at; of a moving arm the next one
};

Eigen::Isometry3d between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double way) {
  Eigen::Isometry3d there = Eigen::Isometry3d::Identity();
  there.linear() = Eigen::Quaterniond(from.linear()).slerp(way, Eigen::Quaterniond(to.linear())).toRotationMatrix();
  there.translation() = (1.0 - way) * from.translation() + way * to.translation();
  return there;
}

/// The point that is measured lies `tool_m` from the flange, which the arm's file does not know.
LoggedArm logged_arm(RandomStream& random, std::size_t poses, double offset_s,
                     const Eigen::Vector3d& tool_m = Eigen::Vector3d::Zero()) {
  constexpr int kRowsPerPose = 20;
  constexpr double kStep_s = 0.1;
  std::vector<Eigen::Isometry3d> stops;
  for (std::size_t i = 0; i < poses; ++i) {
    stops.emplace_back(Eigen::Translation3d(random.real(), random.real(), random.real()));
    const Eigen::Vector4d turn(random.normal(), random.normal(), random.normal(), random.normal());
    stops.back().linear() = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
  }
  LoggedArm arm;
  double time_s = 0.0;
  for (std::size_t pose = 0; pose < poses; ++pose) {
    const Eigen::Isometry3d from = pose > 0 ? stops[pose - 1] : stops[0];
    for (int row = 0; row < kRowsPerPose; ++row, time_s += kStep_s) {
      const double way = std::min(1.0, row / 8.0);
      arm.keys[1].times_s.push_back(time_s);
      arm.points.flanges.push_back(between(from, stops[pose], way));
      arm.pose_of_log_row.push_back(pose);
    }
    arm.keys[0].times_s.push_back(time_s - 6.3 * kStep_s + offset_s);
    arm.points.measured_m.push_back(stops[pose] * tool_m +
                                    1e-4 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  }
  arm.tables = {table_of_rows("m.txt", poses), table_of_rows("j.csv", arm.keys[1].times_s.size())};
  return arm;
}

TEST(JoinByTime, FindsTheOffsetOfTheClocksByTheArmsMotion) {
  RandomStream random{82};
  for (const double offset_s : {0.0, 3.7, -41.2, 1.7e5}) {
    const LoggedArm arm = logged_arm(random, 12, offset_s);
    const double found_s =
        find_offset(arm.tables[0], arm.keys[0], arm.tables[1], arm.keys[1], arm.points, 0.1).offset_s;
    EXPECT_NEAR(found_s, offset_s, 0.7);  // the arm stands for 1.2 s
    const JoinedRows joined = join_by_time(arm.tables, arm.keys, 0, {.by = JoinBy::time, .within_s = 0.1}, found_s);
    for (std::size_t pose = 0; pose < joined.rows.size(); ++pose) {
      const std::size_t row = joined.rows[pose][1];
      EXPECT_LT((arm.points.flanges[row].translation() - arm.points.measured_m[pose]).norm(), 1e-3)
          << offset_s << ' ' << pose;
    }
  }
}

TEST(JoinByTime, FindsTheOffsetWhereTheToolIsUnknown) {
  RandomStream random{84};
  const Eigen::Isometry3d base(Eigen::Translation3d(2.0, -1.0, 0.3) * Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitZ()));
  for (const double offset_s : {0.0, -5.3, 4.1e4}) {
    const Eigen::Vector3d tool_m(0.12, -0.08, 0.21);
    LoggedArm arm = logged_arm(random, 14, offset_s, tool_m);
    for (Eigen::Vector3d& point : arm.points.measured_m) point = base * point;
    const ClockOffset found = find_offset(arm.tables[0], arm.keys[0], arm.tables[1], arm.keys[1], arm.points, 0.1);
    EXPECT_NEAR(found.offset_s, offset_s, 0.7);
    ASSERT_TRUE(found.tool_m);
    EXPECT_LT((*found.tool_m - tool_m).norm(), 1e-3);
    EXPECT_LT(found.misfit_m, 1e-3);
    EXPECT_GT(found.rival_m, 1e-2);
    const JoinedRows joined =
        join_by_time(arm.tables, arm.keys, 0, {.by = JoinBy::time, .within_s = 0.1}, found.offset_s);
    for (std::size_t pose = 0; pose < joined.rows.size(); ++pose)
      EXPECT_EQ(arm.pose_of_log_row[joined.rows[pose][1]], pose);
  }
}

TEST(JoinByTime, FitsNoToolToPointsOfAnotherMeasurement) {
  RandomStream random{85};
  const LoggedArm arm = logged_arm(random, 14, 0.0), other = logged_arm(random, 14, 0.0, {0.1, 0.1, 0.1});
  EXPECT_THAT(complaint([&] {
                find_offset(other.tables[0], other.keys[0], arm.tables[1], arm.keys[1],
                            {other.points.measured_m, arm.points.flanges}, 0.1);
              }),
              HasSubstr("at no offset of the clocks"));
}

TEST(JoinByTime, RefusesOffsetsThatCannotBeTold) {
  RandomStream random{83};
  LoggedArm arm = logged_arm(random, 8, 0.0);
  for (std::size_t i = 0; i < arm.points.flanges.size(); ++i)
    arm.points.flanges[i] = Eigen::Translation3d(0.2 * static_cast<double>(arm.pose_of_log_row[i]), 0.0, 0.0);
  // Of three of eight stops of equal distances any three in a row may be meant.
  for (std::size_t i = 0; i < 3; ++i)
    arm.points.measured_m[i] = Eigen::Vector3d(0.2 * static_cast<double>(i), 0.0, 0.0);
  arm.points.measured_m.resize(3);
  arm.keys[0].times_s.resize(3);
  arm.tables[0] = table_of_rows("m.txt", 3);
  EXPECT_THAT(complaint([&] { find_offset(arm.tables[0], arm.keys[0], arm.tables[1], arm.keys[1], arm.points, 0.1); }),
              HasSubstr("both fit alike"));
  const LoggedArm other = logged_arm(random, 8, 0.0);
  EXPECT_THAT(complaint([&] {
                find_offset(other.tables[0], other.keys[0], arm.tables[1], arm.keys[1],
                            {other.points.measured_m, arm.points.flanges}, 0.1);
              }),
              HasSubstr("at no offset of the clocks"));
}

TEST(JoinByTime, FindsTheDayOfClocksWithoutDates) {
  JoinKeys lead, other;
  lead.times_s = {86390.0, 86400.0 + 20.0, 86400.0 + 30.0};  // past midnight
  other.times_s = {25.0, 15.0, 700.0};                       // begun behind it
  EXPECT_EQ(find_whole_days(lead, other, 6.0, 0.0).days, 1);
  EXPECT_EQ(find_whole_days(lead, other, 6.0, 0.0).partners, 2u);
  EXPECT_EQ(find_whole_days(other, lead, 6.0, 0.0).days, -1);
  EXPECT_EQ(find_whole_days(lead, lead, 6.0, 0.0).days, 0);
  EXPECT_EQ(find_whole_days(lead, other, 6.0, 5000.0).days, 0) << "no day helps";
  EXPECT_EQ(find_whole_days(lead, {}, 6.0, 0.0).days, 0);
}

TEST(JoinByTime, RefusesTheFirstRowWithoutOneInTime) {
  std::vector<JoinKeys> keys(2);
  keys[0].times_s = {1.0, 2.0, 9.0};
  keys[1].times_s = {1.1, 2.1};
  const std::vector<CsvTable> tables{table_of_rows("m.txt", 3), table_of_rows("j.csv", 2)};
  const JoinRule rule{.by = JoinBy::time, .within_s = 0.5};
  EXPECT_THAT(complaint([&] { join_by_time(tables, keys, 0, rule, 0.0); }),
              HasSubstr("m.txt:4: '9 s': has no row of j.csv within 0.5 s: the nearest, line 3, is 6.9 s away"));
  JoinRule leaving = rule;
  leaving.unmatched = Unmatched::leave_out;
  EXPECT_EQ(join_by_time(tables, keys, 0, leaving, 0.0).rows.size(), 2u);
}

TEST(TimeStamps, AreSecondsWhateverTheirForm) {
  const double noon = parse_time_stamp("2026-11-24T12:00:00Z")->seconds;
  EXPECT_EQ(parse_time_stamp("2026-11-24 12:00:01.25Z")->seconds, noon + 1.25);
  EXPECT_EQ(parse_time_stamp("2026-11-24T13:00:00,5+01:00")->seconds, noon + 0.5);
  EXPECT_EQ(parse_time_stamp("24.11.2026 12:00:02")->seconds, noon + 2.0);
  EXPECT_EQ(parse_time_stamp("12:00:01.5")->seconds, 43201.5);
  EXPECT_EQ(parse_time_stamp("11:50:29.449 PM")->seconds, 23 * 3600.0 + 50 * 60.0 + 29.449);
  EXPECT_EQ(parse_time_stamp("12:00:01AM")->seconds, 1.0);
  EXPECT_EQ(parse_time_stamp("2026-11-24 12:00:03 pm")->seconds, noon + 3.0);
  EXPECT_EQ(parse_time_stamp("1970-01-02 00:00:00")->seconds, 86400.0);
  for (const char* wrong : {"", "12", "12:00", "24:00:00", "2026-13-01 00:00:00", "2026-11-24", "12:00:00 h", "1:2:3",
                            "13:00:00 PM", "00:00:00 AM", "11:00:00 PMs"})
    EXPECT_FALSE(parse_time_stamp(wrong)) << wrong;
}

TEST(TimeStamps, OfTwelveHoursAreReadBesideDecimalCommas) {
  CsvTable table = read_table("t;x;y\n11:59:59.449 PM;1,5;2,5\n12:00:02.449 AM;2,5;3,5\n", "p").table;
  std::optional<double> origin_s;
  EXPECT_TRUE(write_times_as_seconds(table, 0, origin_s).stamps);
  const TableColumn column(table, {"t", {}}, Quantity::time, {});
  EXPECT_NEAR(column.number(table.rows[1]) - column.number(table.rows[0]), 3.0, 1e-9);
}

TEST(TimeStamps, BecomeAColumnOfSecondsSinceMidnight) {
  CsvTable table = read_table("t;x\n2026-11-24 00:00:01,5;1\n2026-11-25 00:00:02;2,5\n", "p").table;
  std::optional<double> origin_s;
  const TimeColumn found = write_times_as_seconds(table, 0, origin_s);
  EXPECT_TRUE(found.stamps && found.dated && !found.zoned);
  const TableColumn column(table, {"t", {}}, Quantity::time, {});
  EXPECT_EQ(column.number(table.rows[0]), 1.5);
  EXPECT_EQ(column.number(table.rows[1]), 86402.0);
}

TEST(TimeStamps, CountOnWhereAClockWithoutDatesPassesMidnightAndNowhereElse) {
  CsvTable table = read_table("t;x\n23:59:59;1\n23:59:58,5;2\n00:00:01;3\n06:00:00;4\n00:00:02;5\n", "p").table;
  std::optional<double> origin_s;
  const TimeColumn found = write_times_as_seconds(table, 0, origin_s);
  EXPECT_THAT(found.remark, HasSubstr("in line 4 the clock falls to 00:00:01: it is taken to have passed midnight"));
  const TableColumn column(table, {"t", {}}, Quantity::time, {});
  const double day_s = 86400.0;
  for (const auto& [row, time_s] : {std::pair{0, day_s - 1.0}, {1, day_s - 1.5}, {2, day_s + 1.0}, {4, day_s + 2.0}})
    EXPECT_EQ(column.number(table.rows[static_cast<std::size_t>(row)]), time_s) << "rows that are out of order stay so";
}

}  // namespace
}  // namespace demecal

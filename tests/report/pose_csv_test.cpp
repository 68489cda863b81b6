// pose-errors.csv has every pose with what is known of it, and reads back.
#include "report/history.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "data/csv.hpp"
#include "made_up_report.hpp"
#include "measured_report.hpp"

namespace demecal {
namespace {

TEST(PoseCsv, ReadsBackEveryPose) {
  Report report = with_measured_poses(made_up_report(), 12);
  report.pose_errors[3].id = "a \"name\", with all";
  report.pose_errors[4].place.temperature_celsius.reset();
  std::istringstream text(pose_errors_csv(report));
  const CsvTable table = read_csv(text, "pose-errors.csv");
  ASSERT_EQ(table.rows.size(), 12U);
  EXPECT_EQ(table.columns.size(), 7U + 6U + 9U + 2U);
  const auto cell = [&](std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (table.columns[i] == column) return table.rows[row].fields[i];
    }
    return std::string("no such column");
  };
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(cell(i, "id"), report.pose_errors[i].id);
    EXPECT_EQ(std::stod(cell(i, "after_mm")), *report.pose_errors[i].after_mm);
    EXPECT_EQ(std::stod(cell(i, "q3_deg")), report.pose_errors[i].place.joints[2]);
  }
  EXPECT_EQ(cell(4, "temperature_celsius"), "");
}

TEST(PoseCsv, HasNoColumnsForWhatNoPoseHas) {
  Report report;
  report.pose_errors = {{"P1", "", "accept", {}, 0.1, {}}};
  EXPECT_EQ(pose_errors_csv(report),
            "id,target,set,before_mm,after_mm,interval95_mm,flags\nP1,\"\",accept,\"\",0.1,\"\",\"\"\n");
}

}  // namespace
}  // namespace demecal

// The parameters of the page: those that the poses show, and those that they do not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "html/page.hpp"
#include "page_reading.hpp"
#include "report/made_up_report.hpp"

namespace demecal {
namespace {

using ::testing::SizeIs;

TEST(DetailsPage, SaysThatANumberIsNotDetermined) {
  Report report = made_up_report();
  report.parameters = {{"joint 4 d_mm", 600.0, 600.0, 5.0},    {"joint 4 a_mm", 0.0, 0.3, 0.1},
                       {"base_z_mm", 0.0, 299.998, 5.0},       {"base_y_mm", 0.0, 200.3, 2.84},
                       {"tool_x_mm", 1.0, 3.0, 4.4},           {"joint 6 a_mm", 0.0, 0.0011, 1.384},
                       {"joint 6 alpha_deg", 90.0, 90.2, 0.9}, {"joint 16 a_mm", 0.0, 3.0, 1.384}};
  report.unidentified = {
      "base_y_mm and joint 6 a_mm have the same effect in these poses: only their combination is "
      "identified (1 : -1 by effect)"};
  auto rows = table_of(report_html(report, {}), "parameters");
  std::erase_if(rows, [](const std::vector<std::string>& row) { return row.size() == 1; });
  ASSERT_THAT(rows, SizeIs(8));
  for (const auto& row : rows) {
    const bool is_known = row[0] == "joint 4 a_mm" || row[0] == "joint 16 a_mm";
    EXPECT_EQ(row[2] == "not determined", !is_known) << row[0];
    EXPECT_EQ(row[4] == "–", !is_known) << row[0];
  }
}

}  // namespace
}  // namespace demecal

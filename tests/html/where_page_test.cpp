// The part of the page on single poses: every pose is in it, its data are JSON, and nothing in them ends the script.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "html/page.hpp"
#include "html/sections.hpp"
#include "page_reading.hpp"
#include "report/made_up_report.hpp"
#include "report/measured_report.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using Json = nlohmann::ordered_json;

TEST(WherePage, IsOneWellFormedPieceWithItsScript) {
  const std::string page = report_html(with_measured_poses(made_up_report(), 40), {});
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_THAT(all_between(page, "<script", ">"), SizeIs(2)) << "data and what reads them";
  for (const char* const word : {"http", "<link", "@import", "url(", "src=", "fetch(", "eval("})
    EXPECT_THAT(page, Not(HasSubstr(word)));
}

TEST(WherePage, HoldsTheErrorsOfTheReport) {
  const Report report = with_measured_poses(made_up_report(), 40);
  const Json data = Json::parse(pose_data(report));
  ASSERT_THAT(data["id"], SizeIs(40));
  ASSERT_THAT(data["p"], SizeIs(3 * 40));
  ASSERT_THAT(data["q"], SizeIs(6 * 40));
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(data["id"][i], report.pose_errors[i].id);
    EXPECT_NEAR(data["after"][i], *report.pose_errors[i].after_mm, 5.1e-5);
    const double x = data["ea"][3 * i], y = data["ea"][3 * i + 1], z = data["ea"][3 * i + 2];
    EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), *report.pose_errors[i].after_mm, 2e-4);
  }
}

TEST(WherePage, HasRowsForReadersWithoutScriptsTheLargestErrorFirst) {
  const Report report = with_measured_poses(made_up_report(), 40);
  const auto rows = table_of(report_html(report, {}), "pose-errors");
  ASSERT_THAT(rows, SizeIs(40));
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_GE(std::stod(rows[i - 1][3]), std::stod(rows[i][3]));
}

TEST(WherePage, SaysWhereRadiiComeFrom) {
  Report report = with_measured_poses(made_up_report(), 40);
  report.prediction_interval.reset();
  EXPECT_THAT(report_html(report, {}), Not(HasSubstr("id=\"radii\"")));
  report.prediction_interval = PredictionEntry{};
  report.prediction_interval->remark = "the poses follow each other along a path & more";
  EXPECT_THAT(report_html(report, {}), HasSubstr("95 %: the poses follow each other along a path &amp; more.</p>"));
}

TEST(WherePage, NamesTheStagesThatErrorsAreOf) {
  Report report = with_measured_poses(made_up_report(), 40);
  const auto said = [&report] { return words_of(report_html(report, {})); };
  EXPECT_THAT(said(),
              HasSubstr("are the same, those of the stage “with joint corrections”: no effect was added to it."));
  report.method = "structural";
  EXPECT_THAT(said(), HasSubstr("those of the stage “with the structure found”"));
  report.method = "direct";
  report.rounds.resize(1);
  report.rounds[0].verdict = "added";
  EXPECT_THAT(said(),
              HasSubstr("Errors before are those of the stage “with joint corrections”, those after of “with the "
                        "effects found”."));
}

TEST(WherePage, CountsPosesAndNotTheTargetsThatMeasuredThem) {
  Report report = made_up_report();
  report.poses.calibration = 120;
  report.poses.validation = 60;
  report.poses.accept = 60;
  report.pose_errors.clear();
  for (int pose = 0; pose < 80; ++pose) {
    const std::string set = pose < 40 ? "calibration" : pose < 60 ? "validation" : "accept";
    for (const char* const target : {"A", "B", "C"})
      report.pose_errors.push_back({"P" + std::to_string(pose), target, set, 0.3, 0.1, {}});
  }
  const std::string words = words_of(report_html(report, {}));
  for (const char* const count :
       {"40 calibration poses of 3 targets", "20 accept poses of 3 targets", "largest errors of 80 poses of 3 targets"})
    EXPECT_THAT(words, HasSubstr(count));
  for (const char* const rows : {"240 poses", "120 calibration", "60 accept", "(120)"})
    EXPECT_THAT(words, Not(HasSubstr(rows)));
}

TEST(WherePage, TakesNoNameForMarkup) {
  Report report = with_measured_poses(made_up_report(), 3);
  const std::string evil = "</script><script>alert('x')</script>\"]}\\ \x01 <!--";
  report.pose_errors[0].id = report.pose_errors[1].target = report.arm->joints[0].type = evil;
  const std::string page = report_html(report, {});
  EXPECT_THAT(all_between(page, "<script", ">"), SizeIs(2));
  EXPECT_EQ(Json::parse(pose_data(report))["id"][0], evil);
  EXPECT_EQ(unbalanced(page), "");
}

TEST(WherePage, LeavesOutWhatAReportDoesNotSay) {
  Report report = made_up_report();
  report.pose_errors = {{"P1", "", "accept", {}, 0.1, {}}, {"P2", "", "accept", {}, {}, {}}};
  const Json data = Json::parse(pose_data(report));
  EXPECT_THAT(data["p"], SizeIs(0));
  EXPECT_TRUE(data["arm"].is_null());
  EXPECT_TRUE(data["after"][1].is_null());
}

}  // namespace
}  // namespace demecal

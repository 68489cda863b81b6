// What a draft of a data set takes for granted, it says; its name is its folder's.
#include "drafting/draft_data_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "../config/temporary_folder.hpp"
#include "../errors/complaint.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kHeadings[] = "q1_deg,q2_deg,x_mm,y_mm,z_mm,target\n";

DataSetDraft draft_of(const TemporaryFolder& folder, const std::filesystem::path& into, const std::string& rows) {
  const auto table = folder.write("points.csv", kHeadings + rows);
  return draft_data_sets(read_given_tables({table}, 2, {}), into, "robot.yaml", 2, {}).front();
}

TEST(Drafts, SayThatTargetsAreTakenForOne) {
  const TemporaryFolder folder;
  const auto two = draft_of(folder, folder.path(), "1,2,3,4,5,left\n2,3,4,5,6,right\n");
  EXPECT_THAT(two.assumed, Contains(HasSubstr("all points are taken to be of one target: if target of ")));
  EXPECT_THAT(two.text, Not(HasSubstr("target:")));
  const auto one = draft_of(folder, folder.path(), "1,2,3,4,5,left\n2,3,4,5,6,left\n");
  EXPECT_THAT(one.assumed, Not(Contains(HasSubstr("of one target"))));
}

/// What is assumed of two poses with further columns.
std::vector<std::string> assumed_with(const std::string& headings, const std::string& values) {
  const TemporaryFolder folder;
  const auto table = folder.write("points.csv", "q1_deg,q2_deg,y axis,x_mm,y_mm,z_mm," + headings + "\n1,2,0,3,4,5," +
                                                    values + "\n2,3,0,4,5,6," + values + "\n");
  return draft_data_sets(read_given_tables({table}, 2, {}), folder.path(), "robot.yaml", 2, {}).front().assumed;
}

TEST(Drafts, SayTheUnitsOfTemperatureAndPayloadWhereHeadingsDoNot) {
  const auto silent = assumed_with("temp,payload", "20,3");
  EXPECT_THAT(silent,
              Contains(AllOf(HasSubstr("temp of "), HasSubstr("is taken to be the arm's temperature in deg C"))));
  EXPECT_THAT(silent, Contains(AllOf(HasSubstr("payload of "), HasSubstr("is taken to be the payload in kg"))));
  for (const char* headings : {"Temp_F,payload_g", "temperature_degF,payload_kg", "temp [K],payload [g]", "T_C,load"})
    EXPECT_THAT(assumed_with(headings, "70,3"), Not(Contains(HasSubstr(" is taken to be the ")))) << headings;
}

TEST(Drafts, NameTheColumnsThatNothingReads) {
  EXPECT_THAT(assumed_with("temp_f,target_q1", "70,3"), Contains(HasSubstr("not used: columns y axis, target_q1 of ")));
  const TemporaryFolder folder;
  EXPECT_THAT(draft_of(folder, folder.path(), "1,2,3,4,5,a\n2,3,4,5,6,a\n").assumed,
              Not(Contains(HasSubstr("not used"))));
  std::string headings, values;
  for (int i = 0; i < 40; ++i) {
    headings += (i == 0 ? "" : ",") + std::string("channel") + std::to_string(i);
    values += i == 0 ? "1" : ",1";
  }
  EXPECT_THAT(assumed_with(headings, values), Contains(HasSubstr("channel10 and 29 more of ")));
}

TEST(Drafts, JoinByNameAloneWhereMostNamesAgree) {
  const auto ways = [](const std::string& last) {
    const TemporaryFolder folder;
    const auto joints = folder.write("joints.csv", "name,q1_deg,q2_deg\np1,1,2\np2,2,3\np3,4,5\n");
    const auto points = folder.write("points.csv", "name,x_mm,y_mm,z_mm\np3,3,4,5\np1,4,5,6\n" + last + ",5,6,7\n");
    return draft_data_sets(read_given_tables({joints, points}, 2, {}), folder.path(), "robot.yaml", 2, {});
  };
  for (const char* last : {"p2", "p22"}) {
    ASSERT_EQ(ways(last).size(), 1U) << last;
    EXPECT_THAT(ways(last).front().text, HasSubstr("join: {by: name}"));
  }
}

TEST(Drafts, JoinByNameAloneWhereANameStandsTwice) {
  for (const char* heading : {"name", "Bezeichnung"}) {
    const TemporaryFolder folder;
    const auto joints =
        folder.write("joints.csv", std::string(heading) + ",q1_deg,q2_deg\np1,1,2\np2,2,3\np2,4,5\np4,5,6\n");
    const auto points =
        folder.write("points.csv", std::string(heading) + ",x_mm,y_mm,z_mm\np1,3,4,5\np2,4,5,6\np3,5,6,7\np4,6,7,8\n");
    const auto drafts = draft_data_sets(read_given_tables({joints, points}, 2, {}), folder.path(), "robot.yaml", 2, {});
    ASSERT_EQ(drafts.size(), 1U) << heading << ": joined by order, the mistake would be hidden";
    EXPECT_THAT(drafts.front().text, HasSubstr("join: {by: name}"));
  }
}

TEST(Drafts, TakeNoTimesThatTwoClocksShareForNamesOfPoints) {
  for (const std::string day : {"", "2026-04-03 ", "03.04.2026 "}) {
    std::string logged = "Time,q1_deg,q2_deg\n", measured = "Time,x_mm,y_mm,z_mm\n";
    for (int second = 10; second < 40; ++second) logged += day + "09:00:" + std::to_string(second) + ",1,2\n";
    for (int second = 12; second < 40; second += 5) measured += day + "09:00:" + std::to_string(second) + ",3,4,5\n";
    const TemporaryFolder folder;
    const auto joints = folder.write("joints.csv", logged), points = folder.write("points.csv", measured);
    const auto drafts = draft_data_sets(read_given_tables({joints, points}, 2, {}), folder.path(), "robot.yaml", 2, {});
    ASSERT_FALSE(drafts.empty()) << day;
    EXPECT_THAT(drafts.front().text, AllOf(HasSubstr("join: {by: time"), Not(HasSubstr("pose: Time")))) << day;
  }
}

TEST(Drafts, TakeTheUnitOfARailFromWhatItDrives) {
  const auto draft = [](const std::string& headings, const std::string& rows) {
    const TemporaryFolder folder;
    const auto table = folder.write("log.csv", headings + "\n" + rows);
    return draft_data_sets(read_given_tables({table}, 3, {}, {}, 1), folder.path(), "robot.yaml", 3, {}, 1).front();
  };
  const std::string rows = "1.5,10,20,700,800,900\n2.5,11,90,701,700,800\n";
  const auto headed = draft("E1_m,A1,A2,x_mm,y_mm,z_mm", rows);
  EXPECT_THAT(headed.text, HasSubstr("joints: [E1_m, A1, A2]"));
  EXPECT_THAT(headed.text, AllOf(HasSubstr("  angle: deg\n"), Not(HasSubstr("  length: "))));
  EXPECT_THAT(draft("E1,A1,A2,x_mm,y_mm,z_mm", rows).text, AllOf(HasSubstr("angle: deg"), HasSubstr("length: m\n")));
  EXPECT_THAT(complaint([&] { draft("E1,A1,A2,x,y,z", rows); }),
              AllOf(HasSubstr("log.csv:1"), HasSubstr("Write the unit of the rail into its heading, as in `E1 [m]`")));
}

TEST(Drafts, NameColumnsAsTheFileDoes) {
  const TemporaryFolder folder;
  const auto table = folder.write("points.csv", "q1_deg,q2_deg,x,y,z\n1,2,300,4,5\n2,3,400,5,6\n");
  const auto draft = draft_data_sets(read_given_tables({table}, 2, {}), folder.path(), "robot.yaml", 2, {}).front();
  EXPECT_THAT(draft.assumed, Contains(HasSubstr("units of x, y, z are taken to be mm")));
  EXPECT_THAT(draft.text, HasSubstr("[x, \"y\", z]"));
}

TEST(Drafts, TakeWhatWasMeasuredRatherThanWhatAControllerComputed) {
  const TemporaryFolder folder;
  const auto robot = folder.write("robot.csv", "name,q1_deg,q2_deg,x_mm,y_mm,z_mm\nA,1,2,3,4,5\nB,2,3,4,5,6\n");
  const auto tracker = folder.write("tracker.csv", "name,x_mm,y_mm,z_mm\nA,3,4,5.5\nB,4,5,6.5\n");
  for (const auto& files : {std::vector{robot, tracker}, std::vector{tracker, robot}}) {
    const auto draft = draft_data_sets(read_given_tables(files, 2, {}), folder.path(), "robot.yaml", 2, {}).front();
    EXPECT_THAT(draft.assumed,
                Contains(AllOf(HasSubstr("positions are those of "), HasSubstr("tracker.csv, not of "))));
  }
  const auto both = folder.write("both.csv",
                                 "q1_deg,q2_deg,x_mm,y_mm,z_mm,x_actual_mm,y_actual_mm,z_actual_mm\n"
                                 "1,2,3,4,5,3,4,5.5\n2,3,4,5,6,4,5,6.5\n");
  EXPECT_THAT(draft_data_sets(read_given_tables({both}, 2, {}), folder.path(), "robot.yaml", 2, {}).front().text,
              HasSubstr("x_actual_mm"));
}

TEST(Drafts, AreCalledAsTheirFolder) {
  const TemporaryFolder folder;
  const std::string rows = "1,2,3,4,5,a\n2,3,4,5,6,a\n";
  const auto cell = folder.path() / "cell";
  std::filesystem::create_directory(cell);
  for (const auto& into : {cell, cell / "", cell / ".", cell / "jobs" / ".."})
    EXPECT_THAT(draft_of(folder, into, rows).text, HasSubstr("\nname: cell\n")) << into;
}

}  // namespace
}  // namespace demecal

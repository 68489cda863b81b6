// Columns are found by the names that controllers and loggers give joints and rails.
#include "tables/guess_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tables/read_table.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The joints found in a table with these headings, tabs between them.
std::vector<std::size_t> joints_under(const std::string& headings, std::size_t joints, std::size_t rails = 0) {
  std::string row;
  for (std::size_t tab = 0; tab != std::string::npos; tab = headings.find('\t', tab + 1))
    row += row.empty() ? "1.5" : "\t2.5";
  return guess_columns(read_table(headings + '\n' + row + '\n' + row + '\n', "log.txt").table, joints, {}, rails)
      .joints;
}

TEST(GuessedColumns, KnowJointsUnderTheNamesOfControllers) {
  for (const char* headings :
       {"t\tq1\tq2\tq3", "t\tJ1 Angle\tJ2 Angle\tJ3 Angle", "Zeit\tAchse 1\tAchse 2\tAchse 3", "t\trax_1\trax_2\trax_3",
        "t\tJoint 1 Angle [deg]\tJoint 2 Angle [deg]\tJoint 3 Angle [deg]", "t\tJ1_pos\tJ2_pos\tJ3_pos",
        "t\trobax_1\trobax_2\trobax_3"})
    EXPECT_THAT(joints_under(headings, 3), ElementsAre(1, 2, 3)) << headings;
  EXPECT_THAT(joints_under("t\tJ1 Speed\tJ2 Speed\tJ3 Speed", 3), IsEmpty());
}

TEST(GuessedColumns, TakeCommandedJointsBeforeMeasuredOnes) {
  for (const char* headings :
       {"actual_q_0\tactual_q_1\ttarget_q_0\ttarget_q_1", "q1\tq2\tq1_cmd\tq2_cmd",
        "J1 [deg]\tJ2 [deg]\tJ1_cmd [deg]\tJ2_cmd [deg]", "joint_1\tjoint_2\tcommanded_joint_1\tcommanded_joint_2",
        "Achse 1\tAchse 2\tAchse 1 Soll\tAchse 2 Soll", "q_act_1\tq_act_2\tq_ref_1\tq_ref_2"})
    EXPECT_THAT(joints_under(headings, 2), ElementsAre(2, 3)) << headings;
  EXPECT_THAT(joints_under("q1\tq2\ttarget_qd_0\ttarget_qd_1", 2), ElementsAre(0, 1)) << "speeds";
}

TEST(GuessedColumns, PutRailsBeforeTheArmThatTheyCarry) {
  for (const char* headings : {"A1\tA2\tA3\tE1 [mm]", "rax_1\trax_2\trax_3\teax_a", "J1\tJ2\tJ3\tE1",
                               "Achse 1\tAchse 2\tAchse 3\tZusatzachse 1", "q1\tq2\tq3\trail [m]"}) {
    EXPECT_THAT(joints_under(headings, 4, 1), ElementsAre(3, 0, 1, 2)) << headings;
    EXPECT_THAT(joints_under(headings, 3), ElementsAre(0, 1, 2))
        << headings << ": it carries nothing that is asked for";
    EXPECT_THAT(joints_under(headings, 4), IsEmpty()) << headings << ": the first joint turns";
  }
  EXPECT_THAT(joints_under("E1\tE2\tA1\tA2", 4, 2), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(joints_under("q1\tq2\tq3\tq4\tE1", 4, 1), ElementsAre(0, 1, 2, 3)) << "as the robot file counts them";
}

}  // namespace
}  // namespace demecal

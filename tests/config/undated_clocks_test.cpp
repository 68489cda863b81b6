// Files whose clocks have no dates, joined by time over a midnight that only one of them passes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "data_files/data_set_file.hpp"
#include "kinematics/units.hpp"
#include "sample_files.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(UndatedClocks, MeetOnTheDayOnWhichRowsHavePartners) {
  const TemporaryFolder folder;
  folder.write("robot.yaml", kRobotText);
  folder.write("joints.txt", "t;q1_deg;q2_mm\n23:59:50;10;20\n00:00:10;30,5;40\n00:00:20;50;60\n00:00:30;70,5;80\n");
  folder.write("points.txt", "t;x_mm;y_mm;z_mm\n00:00:10,1;1,5;2;3\n00:00:20,1;4;5;6\n00:00:30,1;7;8;9\n");
  const auto path = folder.write("set.yaml", R"yaml(demecal_dataset: 1
robot: robot.yaml
frame: base
poses:
  - {file: joints.txt, columns: {joints: [q1_deg, q2_mm], time: t}}
  - {file: points.txt, columns: {position: [x_mm, y_mm, z_mm], time: t}}
join: {by: time, within_s: 0.5}
)yaml");
  const DescribedDataSet read = load_described_data_set(path);
  ASSERT_EQ(read.data.poses.size(), 3U);
  EXPECT_DOUBLE_EQ(read.data.poses[0].joints[0], radians(30.5));
  EXPECT_DOUBLE_EQ(read.data.poses[2].joints[0], radians(70.5));
  EXPECT_THAT(read.recognised,
              Contains(HasSubstr("joints.txt: without dates its times are taken to be a day earlier")));
  EXPECT_THAT(read.recognised, Contains(HasSubstr("so 3 of 3 rows there have a partner, and 0 as they stand")));
}

}  // namespace
}  // namespace demecal

// What a CELL.yaml may say of an arm's surroundings, and what is refused with file, line, value and rule.
#include "config/cell_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_files/robot_file.hpp"
#include "sample_files.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class StatedCell : public testing::Test {
 protected:
  CellFile load(const std::string& text) {
    files_.write("robot.yaml", kRobotText);
    return load_cell(files_.write("cell.yaml", "demecal_cell: 1\n" + text), load_robot(files_.path() / "robot.yaml"));
  }
  std::string complaint(const std::string& text) {
    return demecal::complaint([&] { load(text); });
  }

  TemporaryFolder files_;
};

TEST_F(StatedCell, RefusesRadiiThatNoArmHas) {
  EXPECT_THAT(complaint("link_radius_mm: 0.05\n"), AllOf(HasSubstr("cell.yaml:2"), HasSubstr("'0.05'"),
                                                         HasSubstr("must be 5 mm or more"), HasSubstr("metres")));
  EXPECT_THAT(complaint("noise_mm: 0.03\nlink_radius_mm: [60, 50, 4.9]\n"),
              AllOf(HasSubstr("cell.yaml:3"), HasSubstr("'4.9'")));
  EXPECT_THAT(complaint("link_radius_mm: [0, 50, 10]\n"), HasSubstr("'0'"));
}

TEST_F(StatedCell, TakesRadiiThatArmsHave) {
  EXPECT_THAT(load("link_radius_mm: 5\n").cell.radii_m, testing::Each(5e-3));
  EXPECT_THAT(load("link_radius_mm: [60, 50, 8]\n").cell.radii_m,
              testing::ElementsAre(testing::DoubleEq(0.06), testing::DoubleEq(0.05), testing::DoubleEq(8e-3)));
}

TEST_F(StatedCell, RefusesObstaclesInMetres) {
  const std::string pole = "  - {from_mm: [0.45, 0, 0], to_mm: [0.45, 0, 1.2], radius_mm: 0.1}\n";
  const std::string thin = "  - {from_mm: [450, 0, 0], to_mm: [450, 0, 1200], radius_mm: 0}\n";
  EXPECT_THAT(complaint("obstacles:\n" + thin + pole),
              AllOf(HasSubstr("cell.yaml:4"), HasSubstr("obstacles[2]"), HasSubstr("metres")));
  EXPECT_EQ(complaint("obstacles:\n" + thin), "");
}

TEST_F(StatedCell, KnowsWhereItsRulesStand) {
  const CellFile file = load("noise_mm: 0.03\ntool_box_mm: {lower: [0, 0, 0], upper: [1, 1, 1]}\n");
  ASSERT_TRUE(file.stated.contains(Obstruction::tool_box));
  EXPECT_EQ(file.stated.at(Obstruction::tool_box).where.line, 3u);
  EXPECT_THAT(file.stated.at(Obstruction::tool_box).where.file, HasSubstr("cell.yaml"));
  EXPECT_EQ(file.stated.at(Obstruction::tool_box).key, "tool_box_mm");
  EXPECT_FALSE(file.stated.contains(Obstruction::itself));
}

}  // namespace
}  // namespace demecal

// What `robot show` prints of an arm: poses in the frame that they count in.
#include "coordinator/shown_robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "data_files/robot_file.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ShownRobot, StandsInTheFrameThatItsPosesCountIn) {
  const std::string arm =
      "name: arm\nconvention: urdf\ntool_mm: [0, 0, 0]\njoints:\n"
      "  - {name: A1, type: revolute, xyz_mm: [0, 0, 400], axis: [0, 0, 1], limits_deg: [-60, 60]}\n";
  const std::string table =
      "positioner:\n  - {name: turn, type: revolute, xyz_mm: [900, 0, 0], axis: [0, 0, 1], limits_deg: [-9, 9]}\n";
  for (const bool positioner : {false, true}) {
    const Robot robot = read_robot(parse_yaml(positioner ? arm + table : arm, "robot.yaml"));
    const LinkInertias none;
    const ShownRobot shown{robot, none, JointVector::Zero(robot.chain.size()), {}};
    const std::string frame = positioner ? "workpiece" : "base", other = positioner ? "base" : "workpiece";
    EXPECT_THAT(shown_json(shown), HasSubstr("\"frame\":\"" + frame + "\""));
    ::testing::internal::CaptureStdout();
    print_shown(shown);
    const std::string printed = ::testing::internal::GetCapturedStdout();
    EXPECT_THAT(printed, HasSubstr("flange in the " + frame + " frame, mm"));
    EXPECT_THAT(printed, HasSubstr("tool point in the " + frame + " frame, mm"));
    EXPECT_THAT(printed, Not(HasSubstr("in the " + other + " frame")));
  }
}

}  // namespace
}  // namespace demecal

// What files may say of an arm before a positioner: nothing of weight, and where an exported URDF begins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "../errors/complaint.hpp"
#include "config/model_export.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

const std::string kArmJoints = R"yaml(demecal_robot: 1
name: two joints
convention: urdf
joints:
  - {name: A1, type: revolute, xyz_mm: [0, 0, 400], axis: [0, 0, 1], limits_deg: [-60, 60]}
  - {name: A2, type: revolute, xyz_mm: [50, 0, 0], axis: [0, 1, 0], limits_deg: [-60, 40]}
tool_mm: [300, 20, 120]
)yaml";

const std::string kTable =
    "positioner:\n  - {name: turn, type: revolute, xyz_mm: [900, 0, 0], axis: [0, 0, 1], limits_deg: [-170, 170]}\n";

std::string refused_scenario(const std::string& robot, const std::string& rest) {
  const TemporaryFolder folder;
  folder.write("cell.yaml", robot);
  const auto file = folder.write(
      "scenario.yaml", "demecal_scenario: 1\nrobot: cell.yaml\nposes: {calibration: 3}\njoint_ranges: {}\n" + rest);
  return complaint([&] { load_scenario(file); });
}

TEST(PositionerScenario, HasNoEffectsOfWeight) {
  for (const char* rest :
       {"measurement: {torque_log: {noise_nm: 0.1}}\n", "errors:\n  compliance: [{joint: 1, rad_per_nm: 1e-6}]\n",
        "errors:\n  balancer: [{joint: 1, fixed_m: 0.1, moving_m: 0.3, rad_per_nm: 1e-6}]\n",
        "errors:\n  link_bending: [{joint: 1, x_rad_per_nm: 1e-6}]\n",
        "errors:\n  hysteresis: [{joint: 1, friction_rad: 1e-5, per_nm: 0.1}]\n"}) {
    EXPECT_EQ(refused_scenario(kArmJoints, rest), "") << rest;
    EXPECT_THAT(refused_scenario(kArmJoints + kTable, rest),
                AllOf(HasSubstr("turns with the workpiece that a positioner carries"), HasSubstr("scenario.yaml:")))
        << rest;
  }
  EXPECT_EQ(refused_scenario(kArmJoints + kTable, "errors:\n  hysteresis: [{joint: 1, friction_rad: 1e-5}]\n"), "");
}

TEST(PositionerDataSet, HasNoTorques) {
  const TemporaryFolder folder;
  folder.write("cell.yaml", kArmJoints + kTable);
  folder.write("poses.csv",
               "pose_id,q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm,t1_nm,t2_nm,t3_nm\na,1,2,3,100,200,300,1,2,3\n");
  const auto file = folder.write("dataset.yaml", R"yaml(demecal_dataset: 1
name: torques
robot: cell.yaml
frame: base
poses: poses.csv
columns: {joints: [q1_deg, q2_deg, q3_deg], position: [x_mm, y_mm, z_mm], torque: [t1_nm, t2_nm, t3_nm]}
)yaml");
  EXPECT_THAT(complaint([&] { load_data_set(file); }),
              AllOf(HasSubstr("t1_nm"), HasSubstr("turns with the workpiece that a positioner carries")));
}

TEST(PositionerUrdf, SaysThatItBeginsInTheWorkpiece) {
  const TemporaryFolder folder;
  for (const bool table : {false, true}) {
    CalibratedModel model;
    model.nominal = load_robot(folder.write("cell.yaml", kArmJoints + (table ? kTable : "")));
    DataSet none;
    none.robot = model.nominal;
    model.robot = nominal_robot(none);
    const auto begins = Contains(HasSubstr("link base is the workpiece on the positioner"));
    if (table) {
      EXPECT_THAT(calibrated_urdf(model, "").notes, begins);
    } else {
      EXPECT_THAT(calibrated_urdf(model, "").notes, Not(begins));
    }
  }
}

}  // namespace
}  // namespace demecal

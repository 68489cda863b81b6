// An arm before a positioner, measured from the workpiece: calibrated, corrected by a table of joints, and kept from
// programs that do not say where the positioner stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "data_files/robot_file.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCell = R"yaml(demecal_robot: 1
name: an arm before a table that tilts and turns
convention: urdf
joints:
  - {name: A1, type: revolute, xyz_mm: [0, 0, 400], axis: [0, 0, 1], limits_deg: [-60, 60]}
  - {name: A2, type: revolute, xyz_mm: [50, 0, 0], axis: [0, 1, 0], limits_deg: [-60, 40]}
  - {name: A3, type: revolute, xyz_mm: [0, 0, 500], axis: [0, 1, 0], limits_deg: [-40, 80]}
  - {name: A4, type: revolute, xyz_mm: [200, 0, 40], axis: [1, 0, 0], limits_deg: [-150, 150]}
  - {name: A5, type: revolute, xyz_mm: [300, 0, 0], axis: [0, 1, 0], limits_deg: [-100, 100]}
  - {name: A6, type: revolute, xyz_mm: [80, 0, 0], axis: [1, 0, 0], limits_deg: [-170, 170]}
positioner:
  - {name: tilt, type: revolute, xyz_mm: [1200, 0, 600], axis: [0, 1, 0], direction: -1, limits_deg: [-70, 70]}
  - {name: turn, type: revolute, xyz_mm: [0, 0, 150], axis: [0, 0, 1], limits_deg: [-170, 170]}
workpiece: {xyz_mm: [0, 0, 40], rpy_deg: [0, 0, 30]}
tool_mm: [60, 20, 120]
)yaml";

/// Joint 2 of the chain is the table's tilt.
constexpr const char* kMeasured = R"yaml(demecal_scenario: 1
robot: cell.yaml
seed: 431
poses: {calibration: 90, validation: 40}
joint_ranges: {}
measurement: {sensor_from_base: {translation_mm: [300, -200, 150], rotation_deg: [4, -7, 115]}, noise_mm: 0.02}
errors:
  geometry:
    - {joint: 2, theta_deg: 0.1, a_mm: 0.8}
    - {joint: 3, d_mm: 0.5}
    - {joint: 4, theta_deg: -0.12}
    - {joint: 5, a_mm: 0.6}
)yaml";

TEST(PositionerCell, IsCalibratedInTheFrameOfTheWorkpieceAndCorrectedByJointsAlone) {
  const SmallJob job;
  std::ofstream(job.path("cell.yaml")) << kCell;
  std::ofstream(job.path("measured.yaml")) << kMeasured;
  ASSERT_EQ(run("demecal", {"simulate", job.path("measured.yaml"), "--out", job.path("cell")}).code, 0);
  const std::string data = job.path("cell/dataset.yaml"), model = job.path("result/model.yaml");
  const Ended fitted = run("demecal", {"diagnose", data, "--declare", "registration,tool,joint_offset,geometry",
                                       "--max-effects", "0", "--out", job.path("result")});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const auto report = nlohmann::json::parse(job.text("result/report.json"));
  EXPECT_GT(report["error_mm"]["registered"]["validation"]["rms"].get<double>(), 1.0);
  EXPECT_LT(report["error_mm"]["after"]["validation"]["rms"].get<double>(), 0.02 * 2.5);

  std::ofstream(job.path("joints.csv")) << "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,q7_deg,q8_deg\n"
                                           "40,-20,10,-15,30,20,45,10\n";
  const Ended applied = run("demecal", {"apply", model, job.path("joints.csv"), "--out", job.path("corrected.csv")});
  EXPECT_EQ(applied.code, 0) << applied.err;
  EXPECT_THAT(applied.out, HasSubstr("1 target"));

  std::ofstream(job.path("p.src")) << "DEF p()\nPTP {A1 10,A2 -20,A3 30,A4 20,A5 50,A6 5,E1 10,E2 20}\nEND\n";
  std::ofstream(job.path("p.script")) << "def p():\n  movej([0.1,-0.2,0.3,0.4,0.5,0.6])\nend\n";
  std::ofstream(job.path("poses.csv")) << "x_mm,y_mm,z_mm,qw,qx,qy,qz\n100,50,300,1,0,0,0\n";
  for (const char* program : {"p.src", "p.script", "poses.csv"}) {
    const Ended refused = run("demecal", {"apply", model, job.path(program), "--out", job.path("no")});
    EXPECT_EQ(refused.code, 11) << program << refused.out;
    EXPECT_THAT(refused.err, HasSubstr("positioner")) << program;
  }
}

}  // namespace
}  // namespace demecal

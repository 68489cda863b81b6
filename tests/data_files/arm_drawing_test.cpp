// Robots that are drawn otherwise than by plain rows: read, written again, and refused where they make no sense.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../config/temporary_folder.hpp"
#include "data_files/robot_file.hpp"
#include "kinematics/forward.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

const std::string kDrawn = R"yaml(demecal_robot: 1
name: Drawn
convention: CONVENTION
base: {xyz_mm: [0, 0, 400], rpy_deg: [180, 0, 0]}
joints:
  - {name: A1, type: continuous, ROW1, direction: -1}
  - {type: revolute, ROW2, offset_deg: 30, limits_deg: [-100, 100]}
  - {type: revolute, ROW2, direction: -1, offset_deg: -12.5, limits_deg: [-100, 100]}
  - {type: prismatic, ROW1, offset_mm: 7, limits_mm: [0, 200]}
flange: {xyz_mm: [0, 10, 80], rpy_deg: [0, 90, 0]}
couplings: [{joint: 3, from: 2, factor: -0.5}]
tool_mm: [1, 2, 3]
links:
  - {mass_kg: 4, com_mm: [10, 20, 30]}
  - {mass_kg: 3, com_mm: [10, 20, 30]}
  - {mass_kg: 2, com_mm: [10, 20, 30]}
  - {mass_kg: 1, com_mm: [10, 20, 30]}
urdf: {file: arm.urdf, base: a, tip: b}
home_deg: [1, 2, 3, 4]
)yaml";

std::string with_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string drawn_text(const std::string& convention) {
  const bool axes = convention == "urdf";
  std::string text = with_all(kDrawn, "CONVENTION", convention);
  text = with_all(text, "ROW1",
                  axes ? "xyz_mm: [0, 10, 300], rpy_deg: [0, 0, 20], axis: [0, 0, 1]"
                       : "alpha_deg: 90, a_mm: 20, d_mm: 300, theta_offset_deg: 20");
  return with_all(text, "ROW2",
                  axes ? "xyz_mm: [400, 10, 0], rpy_deg: [90, 0, 0], axis: [0, 1, 1]"
                       : "alpha_deg: 0, a_mm: 400, d_mm: 10, beta_deg: 0.5");
}

Robot robot_of(const std::string& text) {
  return read_robot(parse_yaml(text, "/folder/robot.yaml"));
}

class DrawnRobots : public ::testing::TestWithParam<const char*> {};

TEST_P(DrawnRobots, AreWrittenAsTheyWereReadAndMoveTheSameAgain) {
  const Robot robot = robot_of(drawn_text(GetParam()));
  const std::string text = "demecal_robot: 1\n" + robot_text(robot);
  const Robot again = robot_of(text);
  EXPECT_EQ("demecal_robot: 1\n" + robot_text(again), text);
  EXPECT_EQ(again.urdf->file, "/folder/arm.urdf");
  EXPECT_EQ(again.drawing->joints[0].name, "A1");
  for (int i = 0; i < 20; ++i) {
    const JointVector q = 0.1 * i * JointVector::Ones(4);
    EXPECT_LT((forward(again.chain, q).matrix() - forward(robot.chain, q).matrix()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((again.masses[1].centre_m - robot.masses[1].centre_m).norm(), 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(Conventions, DrawnRobots, ::testing::Values("standard_dh", "modified_dh", "urdf"));

/// Where the centre of mass of link 2 is in the base frame, by the arm cut off behind it.
Eigen::Vector3d centre_by_rows(std::string text, const JointVector& q) {
  Robot robot = robot_of(text);
  robot.drawing->joints.resize(2);
  robot.drawing->couplings.clear();
  robot.drawing->flange = {};
  return forward(equivalent_chain(*robot.drawing).chain, q.head(2)) * Eigen::Vector3d(0.01, 0.02, 0.03);
}

TEST_P(DrawnRobots, HaveTheirMassesWhereTheFileHasThem) {
  const Robot robot = robot_of(drawn_text(GetParam()));
  const JointVector q = (JointVector(4) << 0.3, -0.4, 0.5, 0.1).finished();
  Chain part = robot.chain;  // up to link 2
  part.joints.resize(2);
  part.couplings.clear();
  part.flange.setIdentity();
  const Eigen::Vector3d by_chain = forward(part, q.head(2)) * robot.masses[1].centre_m;
  EXPECT_LT((by_chain - centre_by_rows(drawn_text(GetParam()), q)).norm(), 1e-12);
}

TEST(DrawnRobots, AreRefusedWhereTheyMakeNoSense) {
  const auto complaint_about = [](const std::string& from, const std::string& to) {
    const std::string text = drawn_text("urdf");
    return complaint([&] { robot_of(with_all(text, from, to)); });
  };
  EXPECT_THAT(complaint_about("axis: [0, 0, 1]", "axis: [0, 0, 0]"), HasSubstr("axis must not be zero"));
  EXPECT_THAT(complaint_about("direction: -1", "direction: 0"), HasSubstr("direction must be 1 or -1"));
  EXPECT_THAT(complaint_about("direction: -1", "direction: 2"), HasSubstr("direction"));
  EXPECT_THAT(complaint_about("offset_deg: 30", "offset_mm: 30"), HasSubstr("a revolute joint has offset_deg"));
  EXPECT_THAT(complaint_about("direction: -1}", "limits_deg: [-1, 1]}"), HasSubstr("is not for a continuous joint"));
  EXPECT_THAT(complaint_about("from: 2", "from: 3"), HasSubstr("nearer to the base"));
  EXPECT_THAT(complaint_about("joint: 3, from: 2", "joint: 4, from: 2"), HasSubstr("of the same type"));
  EXPECT_THAT(complaint_about("rpy_deg: [180,", "rpy_deg: [3.14159,"), HasSubstr("looks like radians"));
}

}  // namespace
}  // namespace demecal

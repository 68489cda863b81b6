// With a positioner the tool stands where the workpiece sees it, by the product of the two chains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../errors/complaint.hpp"
#include "data/text.hpp"
#include "data_files/robot_file.hpp"
#include "kinematics/forward.hpp"
#include "random/random_stream.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// To a thousandth, as people write them.
std::string rounded(RandomStream& random, double size) {
  return number_text(std::round(1e3 * random.real(-size, size)) / 1e3);
}

std::string three(RandomStream& random, double size) {
  return "[" + rounded(random, size) + ", " + rounded(random, size) + ", " + rounded(random, size) + "]";
}

std::string place_text(RandomStream& random) {
  return "xyz_mm: " + three(random, 800.0) + ", rpy_deg: " + three(random, 170.0);
}

/// Every third slides.
std::string joint_lines(RandomStream& random, int count, const std::string& name) {
  std::string text;
  for (int joint = 1; joint <= count; ++joint) {
    const bool slides = joint % 3 == 0;
    text += "  - {name: " + name + std::to_string(joint) + ", type: " + (slides ? "prismatic" : "revolute") + ", " +
            place_text(random) + ", axis: " + three(random, 1.0) + ", direction: " + (joint % 2 == 0 ? "1" : "-1") +
            (slides ? ", offset_mm: " : ", offset_deg: ") + rounded(random, 40.0) +
            (slides ? ", limits_mm: [-900, 900]}\n" : ", limits_deg: [-170, 170]}\n");
  }
  return text;
}

Robot robot_of_lines(const std::string& lines) {
  return read_robot(parse_yaml("name: cell\nconvention: urdf\ntool_mm: [10, 20, 150]\n" + lines, "robot.yaml"));
}

class Positioners : public ::testing::TestWithParam<int> {};

TEST_P(Positioners, LeadFromTheWorkpieceBackwardsToTheBaseAndOnToTheTool) {
  RandomStream random{907};
  const int axes = GetParam();
  for (int trial = 0; trial < 10; ++trial) {
    const std::string base = "base: {" + place_text(random) + "}\n", arm = "joints:\n" + joint_lines(random, 6, "A"),
                      axes_text = joint_lines(random, axes, "E"), workpiece = "{" + place_text(random) + "}\n";
    const Robot whole = robot_of_lines(base + arm + "positioner:\n" + axes_text + "workpiece: " + workpiece);
    // The two chains by themselves, both from the base.
    const Robot alone = robot_of_lines(base + arm),
                carrier = robot_of_lines("joints:\n" + axes_text + "flange: " + workpiece);
    ASSERT_EQ(whole.chain.size(), axes + 6);
    EXPECT_EQ(whole.drawing->joints.front().name, "E" + std::to_string(axes)) << "which is nearest to the workpiece";
    EXPECT_EQ(whole.gravity_mps2, Eigen::Vector3d::Zero()) << "it turns with the workpiece";
    JointVector q(axes + 6);
    for (double& value : q) value = random.real(-2.5, 2.5);
    const JointVector carried = q.head(axes).reverse();
    const Eigen::Isometry3d expected = forward(carrier.chain, carried).inverse() * forward(alone.chain, q.tail(6));
    EXPECT_LT((forward(whole.chain, q).matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-12);
    // Models keep it as it was drawn.
    const std::string text = robot_text(whole);
    const Robot again = read_robot(parse_yaml(text, "model.yaml"));
    EXPECT_EQ(robot_text(again), text);
    EXPECT_THAT(text, HasSubstr("positioner:\n  - {name: E1, "));
    EXPECT_LT((forward(again.chain, q).matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(again.chain.positioner, axes);
  }
}

INSTANTIATE_TEST_SUITE_P(OfAxes, Positioners, ::testing::Values(1, 2, 3));

TEST(Positioner, IsRefusedWhereItWouldBeMisunderstood) {
  RandomStream random{908};
  const std::string six = "joints:\n" + joint_lines(random, 6, "A");
  const std::string turn = "positioner:\n" + joint_lines(random, 1, "E");
  const auto refusal = [](const std::string& lines) { return complaint([&] { robot_of_lines(lines); }); };
  EXPECT_EQ(refusal(six + turn), "");
  EXPECT_THAT(refusal(six + turn + "links: []\n"), HasSubstr("links"));
  EXPECT_THAT(refusal(six + "positioner:\n" + joint_lines(random, 1, "A")), HasSubstr("is the name of two joints"));
  EXPECT_THAT(refusal(six + turn + "gravity_mps2: [0, 0, -9.81]\n"), HasSubstr("turns with the workpiece"));
  EXPECT_EQ(refusal(six + turn + "gravity_mps2: [0, 0, 0]\n"), "");
  EXPECT_THAT(refusal(six + "workpiece: {xyz_mm: [1, 2, 3]}\n"), HasSubstr("positioner"));
  EXPECT_THAT(refusal(six + "positioner:\n" + joint_lines(random, 4, "E")), HasSubstr("1 to 9"));
  EXPECT_THAT(complaint([&] {
                read_robot(
                    parse_yaml("name: cell\nconvention: standard_dh\ntool_mm: [0, 0, 0]\njoints:\n  - {type: revolute, "
                               "alpha_deg: 0, a_mm: 100, d_mm: 0, limits_deg: [-1, 1]}\n" +
                                   turn,
                               "r"));
              }),
              HasSubstr("convention: urdf"));
}

}  // namespace
}  // namespace demecal

// The picture of an arm: points stand where the kinematics have them, to one scale in all views, whatever the arm.
#include "html/arm_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// The points that an expression with two numbers finds, one a view.
std::vector<Eigen::Vector2d> found(const std::string& svg, const std::string& expression) {
  const std::regex regex(expression);
  std::vector<Eigen::Vector2d> points;
  for (std::sregex_iterator match(svg.begin(), svg.end(), regex), end; match != end; ++match)
    points.emplace_back(std::stod((*match)[1]), std::stod((*match)[2]));
  return points;
}

TEST(ArmPicture, ShowsTheToolAsTheViewsAgreeAndTheKinematicsHaveIt) {
  RandomStream stream{4401};
  for (int trial = 0; trial < 20; ++trial) {
    Robot robot;
    robot.name = "any <arm> & \"name\"";
    robot.chain = random_arm(stream, 2 + trial % 6, trial % 2 == 0 ? Convention::standard_dh : Convention::modified_dh);
    const JointVector q = random_joints(stream, robot.chain);
    const std::string svg = arm_picture(robot, q);
    EXPECT_THAT(svg, HasSubstr("any &lt;arm&gt; &amp; "));
    const std::vector<Eigen::Vector2d> points = found(svg, "class=\"tool-point\" cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\"");
    ASSERT_EQ(points.size(), 4u);
    EXPECT_NEAR(points[0].y(), points[1].y(), 0.11);          // both show z upwards
    EXPECT_NEAR(points[0].x(), points[2].x(), 0.11);          // both show x to the right
    EXPECT_NEAR(points[1].x(), 440.0 - points[2].y(), 0.11);  // y to the right, and upwards
    for (const Eigen::Vector2d& point : points) {
      EXPECT_GT(point.minCoeff(), 0.0);
      EXPECT_LT(point.maxCoeff(), 440.0);
    }
    const std::vector<Eigen::Vector2d> base = found(svg, "class=\"base-x\" x1=\"([-0-9.]+)\" y1=\"([-0-9.]+)\"");
    const Eigen::Vector3d tool = tool_position(robot.chain, q);
    const double scale = (points[0] - base[0]).norm() / Eigen::Vector2d(tool.x(), tool.z()).norm();
    EXPECT_NEAR((points[0] - base[0]).x(), scale * tool.x(), 0.2);
    EXPECT_NEAR((points[0] - base[0]).y(), -scale * tool.z(), 0.2);
    EXPECT_NEAR((points[1] - base[1]).x(), scale * tool.y(), 0.2);
  }
}

TEST(ArmPicture, IsTheSameEveryTime) {
  RandomStream stream{4402};
  Robot robot;
  robot.name = "arm";
  robot.chain = random_arm(stream, 6, Convention::standard_dh);
  const JointVector q = random_joints(stream, robot.chain);
  EXPECT_EQ(arm_picture(robot, q), arm_picture(robot, q));
}

}  // namespace
}  // namespace demecal

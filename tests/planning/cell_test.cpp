// Where an arm may go in its cell: what is checked of its body, its targets and its way.
#include "planning/cell.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/planned_arm.hpp"

namespace demecal {
namespace {

/// A pole as thin as a wire, upright beside the arm.
WorkCell with_pole(WorkCell cell, double x_m) {
  cell.obstacles.push_back({{x_m, 0.0, 0.0}, {x_m, 0.0, 2.0}, 0.0});
  return cell;
}

TEST(FeasibleSpace, GivesTheArmTheAssumedRadiiWhereACellStatesNone) {
  const Robot robot = planned_arm();
  WorkCell unstated, stated;
  stated.radii_m = assumed_radii(robot.chain);
  const FeasibleSpace space(robot, with_pole(unstated, 0.4)), twin(robot, with_pole(stated, 0.4));
  EXPECT_EQ(space.cell().radii_m, stated.radii_m);
  RandomStream random{9301};
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const JointVector joints = space.draw(random);
    EXPECT_EQ(space.obstruction(joints), twin.obstruction(joints));
    if (space.obstruction(joints) == Obstruction::obstacle) ++met;
  }
  EXPECT_GT(met, 20);
}

TEST(AssumedRadii, AreNeverThinnerThanAnyArm) {
  Chain small = planned_arm().chain;
  for (Joint& joint : small.joints) {
    joint.a_m *= 0.05;
    joint.d_m *= 0.05;
  }
  for (const double radius_m : assumed_radii(small)) EXPECT_GE(radius_m, kLeastRadius_m);
}

TEST(AssumedRadii, AreNoLargerOnARail) {
  const Chain arm = planned_arm().chain;
  Chain on_rail = arm;
  on_rail.joints.insert(on_rail.joints.begin(), Joint{.type = JointType::prismatic, .lower = 0.0, .upper = 10.0});
  std::vector<double> with_rail = assumed_radii(on_rail);
  with_rail.erase(with_rail.begin());
  EXPECT_EQ(with_rail, assumed_radii(arm));
}

/// A cell that refuses some postures for every reason there is.
WorkCell narrow_cell(const Robot& robot) {
  WorkCell cell = with_pole(assumed_cell(robot), 0.7);
  cell.tool_box = Eigen::AlignedBox3d(Eigen::Vector3d(-1.0, -1.0, 0.1), Eigen::Vector3d(1.0, 1.0, 1.5));
  cell.tool_cone = ToolCone{.half_angle_rad = 2.6};
  cell.instrument = Instrument{.position_m = {2.5, 0.5, 1.0},
                               .nearest_m = 1.6,
                               .farthest_m = 3.2,
                               .target_direction = Eigen::Vector3d::UnitX(),
                               .half_angle_rad = 2.2};
  return cell;
}

/// What is refused of one target alone is refused of several, and nothing else.
TEST(FeasibleSpace, HoldsEveryTargetToTheCell) {
  Robot robot = planned_arm();
  const WorkCell cell = [&] {
    WorkCell narrow = narrow_cell(robot);
    narrow.radii_m = assumed_radii(robot.chain);
    return narrow;
  }();
  const std::vector<Eigen::Vector3d> targets_m{{0.0, 0.0, 0.35}, {0.0, 0.25, 0.3}};
  const FeasibleSpace both(robot, cell, targets_m);
  robot.chain.tool_m = targets_m[0];
  const FeasibleSpace first(robot, cell);
  robot.chain.tool_m = targets_m[1];
  const FeasibleSpace second(robot, cell);
  RandomStream random{9302};
  int feasible = 0, of_second_alone = 0;
  for (int i = 0; i < 4000; ++i) {
    const JointVector joints = both.draw(random);
    const bool one = first.obstruction(joints) == Obstruction::none;
    const bool other = second.obstruction(joints) == Obstruction::none;
    EXPECT_EQ(both.obstruction(joints) == Obstruction::none, one && other);
    feasible += one && other ? 1 : 0;
    of_second_alone += one && !other ? 1 : 0;
  }
  EXPECT_GT(feasible, 20);
  EXPECT_GT(of_second_alone, 20);
}

TEST(FeasibleSpace, KeepsToBoxAndStatedRangesInPassingButNotToTheCone) {
  const Robot robot = planned_arm();
  WorkCell cell = narrow_cell(robot);
  cell.ranges.resize(6);
  cell.ranges[0] = Interval{-1.0, 0.5};
  const FeasibleSpace space(robot, cell);
  const FeasibleSpace anywhere(robot, WorkCell{});
  RandomStream random{9303};
  int passed = 0, out_of_cone = 0;
  for (int i = 0; i < 4000; ++i) {
    const JointVector joints = anywhere.draw(random);
    if (space.in_passing(joints) != Obstruction::none) continue;
    ++passed;
    EXPECT_TRUE(cell.tool_box->contains(tool_position(robot.chain, joints)));
    EXPECT_GE(joints[0], -1.0);
    EXPECT_LE(joints[0], 0.5);
    if (space.obstruction(joints) == Obstruction::tool_cone) ++out_of_cone;
  }
  EXPECT_GT(passed, 50);
  EXPECT_GT(out_of_cone, 5);
}

}  // namespace
}  // namespace demecal

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

}  // namespace
}  // namespace demecal

// An arm of six joints on its base plane, whose poses tests plan.
#pragma once

#include "data/data_set.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {

inline Robot planned_arm() {
  Robot robot;
  robot.name = "elbow";
  robot.chain = wrist_arm();
  robot.chain.joints.front().d_m = 0.5;
  robot.chain.tool_m = {0.1, 0.02, 0.08};
  for (Joint& joint : robot.chain.joints) {
    joint.lower = -2.5;
    joint.upper = 2.5;
  }
  return robot;
}

}  // namespace demecal

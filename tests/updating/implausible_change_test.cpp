// A change is told from another robot, however large: zeros, tool and base explain all of it, or it is none.
#include "updating/implausible_change.hpp"

#include <gtest/gtest.h>

#include "kinematics/units.hpp"
#include "lacking_numbers.hpp"

namespace demecal {
namespace {

CalibratedModel model_before_change() {
  return model_of_wrist(measured_wrist(true_wrist(1), 60, 30, 1));
}

constexpr double kOtherRobot_m = 0.01;  ///< that the check of the data finds of this arm's poses, at the least

TEST(ImplausibleChange, OfAZeroBesideABaseIsExplained) {
  for (const int joint : {1, 2, 3}) {
    CorrectedRobot now = true_wrist(1);
    now.sensor_from_base.translation() += Eigen::Vector3d(3e-3, -2e-3, 1e-3);
    now.chain.joints[static_cast<std::size_t>(joint)].theta_rad += radians(30.0);
    const DataSet data = measured_wrist(now, 14, 0, 903);
    const ChangeReport change = find_change(model_before_change(), data);
    EXPECT_TRUE(explains_implausible(change, kOtherRobot_m)) << joint;
    EXPECT_TRUE(is_far_beyond_usual(change)) << joint;
  }
}

TEST(ImplausibleChange, IsNotSeenInAnotherArm) {
  for (const int poses : {7, 14, 40}) {
    CorrectedRobot now = true_wrist(1);
    now.chain.joints[1].a_m += 0.2;
    now.chain.joints[3].d_m += 0.15;
    const DataSet data = measured_wrist(now, poses, 0, 904);
    EXPECT_FALSE(explains_implausible(find_change(model_before_change(), data), kOtherRobot_m)) << poses;
  }
}

ChangeCause cause_of(const char* kind, double size, const char* unit) {
  ChangeCause cause;
  cause.effect.kind = kind;
  cause.effect.joint = 1;
  cause.size = size;
  cause.unit = unit;
  return cause;
}

TEST(ImplausibleChange, IsNoneThatLeavesMuchOrNeedsMoreThanPlaces) {
  ChangeReport change;
  EXPECT_FALSE(explains_implausible(change, 0.02)) << "nothing was found";
  change.verdict = ChangeVerdict::changed;
  change.found = {cause_of("joint_offset", 0.2, "rad")};
  change.left_m = 1e-4;
  EXPECT_TRUE(explains_implausible(change, 0.02));
  change.more = true;
  EXPECT_FALSE(explains_implausible(change, 0.02));
  change.more = false;
  change.left_m = 0.015;
  EXPECT_FALSE(explains_implausible(change, 0.02)) << "noise that is as large explains anything";
  change.left_m = 1e-4;
  change.found.push_back(cause_of("backlash", 0.4, "rad"));
  EXPECT_FALSE(explains_implausible(change, 0.02)) << "no gear has so much";
}

TEST(ImplausibleChange, BeginsAtThreeDegreesOfAZero) {
  ChangeReport change;
  change.found = {cause_of("joint_offset", radians(-2.9), "rad")};
  EXPECT_FALSE(is_far_beyond_usual(change));
  change.found = {cause_of("joint_offset", radians(-3.1), "rad")};
  EXPECT_TRUE(is_far_beyond_usual(change));
  change.found = {cause_of("joint_offset", 0.05, "m")};
  EXPECT_TRUE(is_far_beyond_usual(change));
  change.found = {cause_of("tool", 0.3, "m")};
  EXPECT_FALSE(is_far_beyond_usual(change)) << "as after a tool was exchanged";
  change.implausible = true;
  EXPECT_TRUE(is_far_beyond_usual(change));
}

}  // namespace
}  // namespace demecal

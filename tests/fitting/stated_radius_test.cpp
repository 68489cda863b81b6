// The radius of a sphere is believed as well as it is stated to be known, against all else that the data tell; where a
// wire's length is zero they tell themselves.
#include <gtest/gtest.h>

#include "data/stated_radius.hpp"
#include "prediction/measurement.hpp"
#include "touching_arm.hpp"

namespace demecal {
namespace {

constexpr double kTouchPlay_m = 3e-5, kTrueRadius_m = 0.04;
const Eigen::Vector3d kNearBall(0.45, 0.25, 0.1), kFarBall(0.35, -0.35, 0.35);

KnownArm arm_at_balls(std::uint64_t seed, bool second) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  touch_ball(arm, stream, "near", kNearBall, kTrueRadius_m, 40, kTouchPlay_m);
  if (second) touch_ball(arm, stream, "far", kFarBall, kTrueRadius_m, 40, kTouchPlay_m);
  return arm;
}

double fitted_radius_m(const DataSet& data) {
  const Fit fit = fit_declared(data, poses_of(data, PoseSet::calibration), kAll, nominal_robot(data));
  EXPECT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  return fit.robot.contacts.at({"near", PoseSet::calibration}).radius_m;
}

TEST(StatedRadius, IsKeptWhereNothingElseTellsTheScale) {
  DataSet data = arm_at_balls(9701, false).data;
  const double unstated_m = fitted_radius_m(data);
  data.contacts.distances = {{"near", {}, unstated_m + 1e-3, 1e-5}};
  EXPECT_NEAR(fitted_radius_m(data), unstated_m + 1e-3, 1e-4);
}

TEST(StatedRadius, YieldsToALengthThatIsKnownBetter) {
  DataSet data = arm_at_balls(9702, true).data;
  data.contacts.distances = {{"near", "far", (kNearBall - kFarBall).norm(), 2e-5},
                             {"near", {}, kTrueRadius_m + 2e-4, kRadiusDeviation_m},
                             {"far", {}, kTrueRadius_m + 2e-4, kRadiusDeviation_m}};
  EXPECT_NEAR(fitted_radius_m(data), kTrueRadius_m, 8e-5);
}

TEST(WireZero, IsFoundFromItsLengths) {
  constexpr double kZeroOff_m = 5e-3;
  RandomStream stream{9703};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  arm.data.anchors_m = {{1.5, 0.3, -0.2}, {-0.4, 1.6, 0.1}, {0.2, -0.5, 2.0}};
  measure(arm, stream, {.noise_m = kTouchPlay_m, .position = false}, 80);
  for (MeasuredPose& pose : arm.data.poses) pose.distances_m.front() += kZeroOff_m;
  arm.data.anchors_m.clear();
  arm.data.anchors_unknown = true;
  take_wires_for_contacts(arm.data);
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_NEAR(fit.sigma_position_m, kTouchPlay_m, 0.2 * kTouchPlay_m);
  const auto to_be_added_m = [&](const char* wire) {
    return fit.robot.contacts.at({wire, PoseSet::calibration}).radius_m;
  };
  EXPECT_NEAR(to_be_added_m("anchor 1"), -kZeroOff_m, 1e-3);
  EXPECT_NEAR(to_be_added_m("anchor 2"), 0.0, 1e-3);
}

}  // namespace
}  // namespace demecal

// What lengths tell that are known across planes or of a plate's holes: the arm's scale, as surely as they are known.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "parameters/observation.hpp"
#include "touching_arm.hpp"

namespace demecal {
namespace {

constexpr double kTouch_m = 2e-5, kLarger = 1.004;
const Eigen::Vector3d kBlock(0.45, 0.2, 0.15), kHole(0.35, -0.3, 0.3);

/// An arm that is larger than described by one factor, to the data an arm that touches nothing yet.
KnownArm larger_arm() {
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  for (Joint& joint : arm.truth.chain.joints) {
    joint.a_m *= kLarger;
    joint.d_m *= kLarger;
  }
  arm.truth.tools[""].translation() *= kLarger;
  return arm;
}

/// How much of what the arm is larger by a fit finds, over its links, each weighed as the makers' figures are.
double found_share(const KnownArm& arm, const CorrectedRobot& robot) {
  double found = 0.0, true_m2 = 0.0;
  for (std::size_t joint = 1; joint < robot.chain.joints.size(); ++joint) {
    const Joint &fitted = robot.chain.joints[joint], &described = arm.data.robot.chain.joints[joint],
                &real = arm.truth.chain.joints[joint];
    found += (fitted.d_m - described.d_m) * described.d_m + (fitted.a_m - described.a_m) * described.a_m;
    true_m2 += (real.d_m - described.d_m) * described.d_m + (real.a_m - described.a_m) * described.a_m;
  }
  return found / true_m2;
}

TEST(KnownLengths, OfAGaugeBlockBetweenPlanesGiveTheArmItsScale) {
  RandomStream stream{9301};
  constexpr double kStep_m = 0.1;
  KnownArm arm = larger_arm();
  touch_plate(arm, stream, "table", kBlock, 0.12, 30, kTouch_m);
  touch_plate(arm, stream, "block", kBlock + Eigen::Vector3d(0.0, 0.0, kStep_m), 0.04, 30, kTouch_m);
  touch(arm, stream, "socket", kHole, 20, kTouch_m);
  const double alone = found_share(arm, fit_all(arm, kAll).robot);
  arm.data.contacts.angles = {{"table", "block", false, 1e-4}};
  arm.data.contacts.distances = {{"table", "block", kStep_m, 5e-6}};
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_LT(std::abs(alone), 0.2) << "no length: the scale stays the description's";
  EXPECT_NEAR(found_share(arm, fit.robot), 1.0, 0.2);
  for (const LengthError& one : length_errors(fit.robot, arm.data)) EXPECT_LT(std::abs(one.error_m), 5e-5);
  arm.data.contacts.distances[0].length_m *= 1.004;
  EXPECT_NEAR(found_share(arm, fit_all(arm, kAll).robot), 2.0, 0.25) << "a longer block, a larger arm";
}

TEST(KnownLengths, OfAPointAbovePlaneGiveTheArmItsScale) {
  RandomStream stream{9302};
  KnownArm arm = larger_arm();
  touch_plate(arm, stream, "table", kBlock, 0.12, 40, kTouch_m);
  touch(arm, stream, "socket", kBlock + Eigen::Vector3d(0.05, 0.02, 0.12), 30, kTouch_m);
  arm.data.contacts.distances = {{"socket", "table", 0.12, 5e-6}};
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_NEAR(found_share(arm, fit.robot), 1.0, 0.2);
}

TEST(KnownLengths, AcrossAPlaneThatItsTouchesOnlyPlaceAreNoError) {
  RandomStream stream{9303};
  for (const auto& [touches, expected] : {std::pair{3, 0u}, std::pair{8, 1u}}) {
    KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
    touch_plate(arm, stream, "table", kBlock, 0.12, touches, kTouch_m);
    touch(arm, stream, "socket", kBlock + Eigen::Vector3d(0.05, 0.02, 0.12), 1, kTouch_m);
    arm.data.contacts.distances = {{"socket", "table", 0.12, 5e-6}};
    EXPECT_EQ(length_errors(arm.truth, arm.data).size(), expected) << touches;
  }
}

}  // namespace
}  // namespace demecal

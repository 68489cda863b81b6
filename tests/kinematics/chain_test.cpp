// Link parameters by name, and which neighbouring axes count as parallel.
#include "kinematics/chain.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "random_arm.hpp"

namespace demecal {
namespace {

TEST(Joint, NamesEachParameterOnce) {
  Joint joint;
  for (int i = 0; i < kLinkParameters; ++i) joint.parameter(static_cast<LinkParameter>(i)) = i + 1.0;
  EXPECT_EQ(joint.theta_rad, 1.0);
  EXPECT_EQ(joint.d_m, 2.0);
  EXPECT_EQ(joint.a_m, 3.0);
  EXPECT_EQ(joint.alpha_rad, 4.0);
  EXPECT_EQ(joint.beta_rad, 5.0);
  const Joint& read = joint;
  for (int i = 0; i < kLinkParameters; ++i) EXPECT_EQ(read.parameter(static_cast<LinkParameter>(i)), i + 1.0);
}

TEST(NearParallel, OfThePumaIsItsUpperArmAlone) {
  const Chain puma = wrist_arm();
  for (int joint = 0; joint < puma.size(); ++joint) {
    EXPECT_EQ(near_parallel_to_next(puma, joint, 0.01), joint == 1) << joint;
  }
}

TEST(NearParallel, LooksAtTheTwistThatStandsBetweenTheTwoAxes) {
  for (const double twist : {0.0, 0.005, -0.005, std::numbers::pi, std::numbers::pi - 0.005}) {
    for (const Convention convention : {Convention::standard_dh, Convention::modified_dh}) {
      Chain chain;
      chain.convention = convention;
      chain.joints.resize(3);
      for (Joint& joint : chain.joints) joint.alpha_rad = 1.0;
      chain.joints[1].alpha_rad = twist;
      const bool standard = convention == Convention::standard_dh;
      EXPECT_EQ(near_parallel_to_next(chain, 0, 0.01), !standard);
      EXPECT_EQ(near_parallel_to_next(chain, 1, 0.01), standard);
      EXPECT_EQ(near_parallel_to_next(chain, standard ? 1 : 0, 0.001), std::abs(std::sin(twist)) < 0.001);
    }
  }
}

TEST(NearParallel, IsFalseOfTheLastJointAndOfNone) {
  Chain chain;
  chain.joints.resize(2);
  EXPECT_TRUE(near_parallel_to_next(chain, 0, 0.01));
  EXPECT_FALSE(near_parallel_to_next(chain, 1, 0.01));
  EXPECT_FALSE(near_parallel_to_next(chain, -1, 0.01));
}

}  // namespace
}  // namespace demecal

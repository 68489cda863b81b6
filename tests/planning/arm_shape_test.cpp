// Distances between lines of finite length, against the nearest of many points on them.
#include <gtest/gtest.h>

#include "kinematics/random_arm.hpp"
#include "planning/cell.hpp"

namespace demecal {
namespace {

Eigen::Vector3d random_point(RandomStream& random) {
  return {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
}

TEST(SegmentDistance, IsThatOfTheNearestPoints) {
  RandomStream random{9001};
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d a = random_point(random), b = trial % 5 == 0 ? a : random_point(random);
    const Eigen::Vector3d c = random_point(random);
    const Eigen::Vector3d d = trial % 7 == 0   ? c
                              : trial % 3 == 0 ? Eigen::Vector3d(c + 0.5 * (b - a))
                                               : random_point(random);
    constexpr int kSteps = 200;
    double nearest = 10.0;
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; k <= kSteps; ++k)
        nearest = std::min(nearest, (a + (b - a) * i / kSteps - c - (d - c) * k / kSteps).norm());
    EXPECT_NEAR(segment_distance(a, b, c, d), nearest, 0.02);
    EXPECT_LE(segment_distance(a, b, c, d), nearest + 1e-12);
  }
}

TEST(ArmParts, LeadFromTheBaseToTheToolPoint) {
  RandomStream random{9002};
  for (const Convention convention : kConventions) {
    const Chain chain = random_arm(random, 6, convention);
    const JointVector joints = random_joints(random, chain);
    const auto parts = arm_parts(chain, joints, std::vector<double>(7, 0.01), {chain.tool_m});
    ASSERT_FALSE(parts.empty());
    EXPECT_NEAR(parts.front().body.from_m.norm(), 0.0, 1e-12);
    EXPECT_NEAR((parts.back().body.to_m - tool_position(chain, joints)).norm(), 0.0, 1e-12);
    for (std::size_t i = 1; i < parts.size(); ++i)
      EXPECT_NEAR((parts[i].body.from_m - parts[i - 1].body.to_m).norm(), 0.0, 1e-12);
  }
}

TEST(ArmParts, LeadFromTheFlangeToEveryTarget) {
  RandomStream random{9003};
  const Chain chain = random_arm(random, 6, Convention::standard_dh);
  const JointVector joints = random_joints(random, chain);
  const std::vector<Eigen::Vector3d> targets_m{{0.0, 0.0, 0.3}, {0.0, 0.2, 0.1}};
  const auto parts = arm_parts(chain, joints, std::vector<double>(7, 0.01), targets_m);
  const Eigen::Isometry3d flange = forward(chain, joints);
  ASSERT_GE(parts.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    const ArmPart& part = parts[parts.size() - 2 + i];
    EXPECT_EQ(part.link, 6);
    EXPECT_NEAR((part.body.from_m - flange.translation()).norm(), 0.0, 1e-3);
    EXPECT_NEAR((part.body.to_m - flange * targets_m[i]).norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace demecal

// Single poses whose point was exchanged with another's, or written with a wrong coordinate, on an arm that errs by
// more than its noise in some poses: each is named as what it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "elbow_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "kinematics/units.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// 60 poses of an elbow arm; every sixth is five times as far off as the others.
DataSet measured_unevenly(std::uint64_t seed) {
  RandomStream stream{seed};
  DataSet data;
  data.robot.chain = elbow();
  data.file = "poses.csv";
  for (int i = 0; i < 60; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    const double noise_m = i % 6 == 0 ? 5e-4 : 1e-4;
    pose.position_m = forward(data.robot.chain, pose.joints) * data.robot.chain.tool_m +
                      Eigen::Vector3d(2.0, 0.7, 0.4) +
                      noise_m * Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
    pose.pose_id = "p" + std::to_string(i);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

std::string said_of(const DataSet& data) {
  std::string said;
  for (const Finding& finding : check_data(data).findings) said += finding.sentence + '\n';
  return said;
}

TEST(SinglePoses, ThatWereExchangedAreNamedWhereTheArmErrsByMoreThanNoise) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    DataSet data = measured_unevenly(seed);
    std::swap(data.poses[6].position_m, data.poses[18].position_m);
    EXPECT_THAT(said_of(data), ::testing::HasSubstr("p6 and p18 fit if their measured points are exchanged")) << seed;
  }
}

TEST(SinglePoses, WithAWrongCoordinateAreNamed) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DataSet data = measured_unevenly(seed);
    data.poses[13].position_m->y() *= -1.0;
    std::swap(data.poses[24].position_m->x(), data.poses[24].position_m->z());
    const std::string said = said_of(data);
    EXPECT_THAT(said, ::testing::HasSubstr("p13 fits if its measured y is taken with the other sign")) << seed;
    EXPECT_THAT(said, ::testing::HasSubstr("p24 fits if its measured x and z are exchanged")) << seed;
  }
}

TEST(SinglePoses, WithAJointManyTurnsAwayAreNamedWithoutThem) {
  DataSet data = measured_unevenly(2);
  data.poses[13].joints[2] = radians(1e9);
  const std::string said = said_of(data);
  EXPECT_THAT(said, ::testing::HasSubstr("p13 fits if joint 3 is "));
  EXPECT_THAT(said, ::testing::HasSubstr(" deg in place of 1000000000.000 deg, which is 277777"));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("99999"))) << "turned as often as what was given";
}

TEST(SinglePoses, AreNotNamedOfDataWithoutMistakes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) EXPECT_EQ(said_of(measured_unevenly(seed)), "") << seed;
}

}  // namespace
}  // namespace demecal

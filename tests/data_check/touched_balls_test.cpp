// A pose that touched another ball than it names is named, whatever it does to the sphere through all touches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "data/stated_radius.hpp"
#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr double kTouchPlay_m = 5e-5;

/// Two balls of 25 mm half a metre apart, of a stated distance and stated radii, touched in two sets.
DataSet two_balls(std::uint64_t seed) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.tool = true, .joint_offset = true, .geometry = true});
  const Eigen::Vector3d left_m(0.4, 0.25, 0.2), right_m(0.4, -0.25, 0.2);
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation}) {
    const int count = set == PoseSet::calibration ? 24 : 12;
    touch_ball(arm, stream, "left", left_m, 0.025, count, kTouchPlay_m, set);
    touch_ball(arm, stream, "right", right_m, 0.025, count, kTouchPlay_m, set);
  }
  arm.data.contacts.distances = {{"left", {}, 0.025, kRadiusDeviation_m},
                                 {"right", {}, 0.025, kRadiusDeviation_m},
                                 {"left", "right", (left_m - right_m).norm(), 2e-5}};
  return arm.data;
}

TEST(TouchedBalls, ArePosesNamedOneByOneThatTouchedTheOther) {
  for (const std::uint64_t seed : {9841u, 9842u, 9843u, 9844u, 9845u}) {
    const DataSet right = two_balls(seed);
    EXPECT_TRUE(check_data(right).findings.empty()) << seed;
    for (const std::size_t wrong : {1u, 3u}) {
      DataSet data = right;
      std::set<std::string> exchanged, named;
      for (std::size_t i = 0; i < wrong; ++i) {
        MeasuredPose& pose = data.poses[7 + 20 * i + seed % 5];
        pose.contact = pose.contact == "left" ? "right" : "left";
        exchanged.insert(pose.pose_id);
      }
      const DataCheck check = check_data(data);
      for (const Finding& one : check.findings) {
        EXPECT_EQ(one.kind, FindingKind::wrong_contact) << seed << ": " << one.sentence;
        EXPECT_THAT(one.sentence, HasSubstr("most likely it touched"));
        named.insert(one.poses.begin(), one.poses.end());
      }
      EXPECT_EQ(named, exchanged) << seed;
      EXPECT_EQ(check.verdict(), DataVerdict::suspicious);
    }
  }
}

}  // namespace
}  // namespace demecal

// Readings of pendants that show angles to whole degrees or tenths: a right description agrees, mistakes that go beyond
// the rounding are named, and what it hides is said.
#include "data_check/pendant_rounding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "data_check/pendant.hpp"
#include "elbow_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// What a controller shows, whose arm is `truth`, at joints drawn at random, angles to `step_deg`.
DataSet shown_to(double step_deg, const Chain& truth, const Chain& described, int poses, std::uint64_t seed) {
  const double step = step_deg * std::numbers::pi / 180.0;
  RandomStream stream{seed};
  DataSet data;
  data.robot.chain = described;
  data.frame = Frame::base;
  data.file = "pendant.csv";
  for (int i = 0; i < poses; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, truth);
    const Eigen::Vector3d point = forward(truth, pose.joints) * truth.tool_m;
    pose.position_m = point.unaryExpr([](double value) { return 1e-5 * std::round(value / 1e-5); });
    for (double& angle : pose.joints) angle = step * std::round(angle / step);
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

TEST(PendantRounding, OfAnotherUnitIsAllowedForAsWell) {
  for (const auto& [per_metre, word] : {std::pair(1e-3, "metres"), std::pair(1e-1, "centimetres")}) {
    DataSet data = shown_to(1e-3, elbow(), elbow(), 8, 4471);
    for (MeasuredPose& pose : data.poses)  // three decimals of metres, one of centimetres, headed as millimetres
      pose.position_m =
          per_metre * pose.position_m->unaryExpr([](double value) { return 1e-3 * std::round(1e3 * value); });
    const PendantComparison comparison = compare_with_pendant(data);
    EXPECT_FALSE(comparison.agrees);
    EXPECT_TRUE(comparison.explained);
    EXPECT_THAT(comparison.findings, Contains(HasSubstr(std::string("positions are in ") + word)));
    EXPECT_THAT(comparison.findings, Contains(HasSubstr("rounded (positions to 1 mm)")));
  }
}

Chain mistaken(const std::function<void(Chain&)>& mistake) {
  Chain chain = elbow();
  mistake(chain);
  return chain;
}

TEST(PendantRounding, OfAnglesIsTolerated) {
  for (const double step_deg : {0.1, 1.0}) {
    for (const int poses : {6, 8, 12, 20}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const PendantComparison comparison =
            compare_with_pendant(shown_to(step_deg, elbow(), elbow(), poses, 4400 + seed));
        EXPECT_TRUE(comparison.agrees) << step_deg << ' ' << poses << ' ' << seed;
        EXPECT_THAT(comparison.findings,
                    Contains(HasSubstr(step_deg < 1.0 ? "rounded (angles to 0.1 deg)" : "rounded (angles to 1 deg)")));
      }
    }
  }
}

/// The same poses, angles to thousandths of a radian and positions to millimetres, as metres of three decimals.
DataSet shown_in_rad_and_m(const Chain& described, int poses, std::uint64_t seed) {
  DataSet data = shown_to(1e-6, elbow(), described, poses, seed);
  for (MeasuredPose& pose : data.poses) {
    for (double& angle : pose.joints) angle = 1e-3 * std::round(1e3 * angle);
    pose.position_m = pose.position_m->unaryExpr([](double value) { return 1e-3 * std::round(1e3 * value); });
  }
  return data;
}

TEST(PendantRounding, OfRadiansAndMetresIsTolerated) {
  for (const int poses : {6, 12, 20}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const PendantComparison comparison = compare_with_pendant(shown_in_rad_and_m(elbow(), poses, 4500 + seed));
      EXPECT_TRUE(comparison.agrees) << poses << ' ' << seed;
      EXPECT_THAT(comparison.findings, Contains(HasSubstr("rounded (angles to 0.001 rad, positions to 1 mm)")));
    }
  }
  const Chain longer = mistaken([](Chain& chain) { chain.joints[1].a_m += 0.03; });
  EXPECT_FALSE(compare_with_pendant(shown_in_rad_and_m(longer, 12, 4506)).agrees);
}

TEST(PendantRounding, ToMoreDigitsKeepsTheLimit) {
  const PendantRounding fine(shown_to(0.01, elbow(), elbow(), 8, 4401));
  EXPECT_FALSE(fine.is_coarse());
  EXPECT_DOUBLE_EQ(fine.typical_m(), kPendantRounding_m);
}

TEST(PendantRounding, LeavesLargerMistakesTold) {
  struct MistakenNumber {
    std::function<void(Chain&)> mistake;
    std::string words;
  };
  for (const double step_deg : {0.1, 1.0}) {
    for (const MistakenNumber& one :
         {MistakenNumber{[](Chain& chain) { chain.joints[2].theta_rad += 0.3; }, "joint 3"},
          MistakenNumber{[](Chain& chain) { chain.joints[1].a_m -= 0.2; }, "joint 2 a_mm differs by"},
          MistakenNumber{[](Chain& chain) {
                           chain.tool_m = {0.0, 0.0, 0.02};
                         },
                         "The tool"}}) {
      const PendantComparison comparison =
          compare_with_pendant(shown_to(step_deg, elbow(), mistaken(one.mistake), 16, 4402));
      EXPECT_FALSE(comparison.agrees) << one.words;
      EXPECT_TRUE(comparison.explained) << one.words;
      EXPECT_THAT(comparison.findings, Contains(HasSubstr(one.words)));
      EXPECT_THAT(comparison.findings, Contains(HasSubstr("The readings are rounded")));
    }
    DataSet data = shown_to(step_deg, elbow(), elbow(), 14, 4403);
    for (MeasuredPose& pose : data.poses) pose.joints[2] *= -1.0;
    EXPECT_THAT(compare_with_pendant(data).findings, Contains(HasSubstr("joint 3 is taken with the other sign")));
  }
}

/// Joints that the arm was sent to as whole degrees hide nothing: what does not fit exactly is told as ever.
TEST(PendantRounding, IsNotBelievedOfWholeDegreesThatFitExactly) {
  DataSet sent = shown_to(1.0, elbow(), elbow(), 12, 4404);
  const auto show = [&](const Chain& truth) {
    for (MeasuredPose& pose : sent.poses) pose.position_m = forward(truth, pose.joints) * truth.tool_m;
  };
  show(elbow());
  PendantComparison comparison = compare_with_pendant(sent);
  EXPECT_TRUE(comparison.agrees);
  EXPECT_TRUE(comparison.findings.empty());
  show(mistaken([](Chain& chain) { chain.joints[1].a_m += 0.003; }));
  comparison = compare_with_pendant(sent);
  EXPECT_FALSE(comparison.agrees);
  EXPECT_THAT(comparison.findings, Contains(HasSubstr("joint 2 a_mm differs by 3.00")));
}

TEST(PendantRounding, DoesNotMakeAnotherRobotAgree) {
  const Chain other = mistaken([](Chain& chain) {
    chain.joints[1].a_m = 0.35;
    chain.joints[3].d_m = 0.31;
    chain.joints[0].a_m = 0.0;
    chain.joints[2].alpha_rad = 1.0;
  });
  EXPECT_FALSE(compare_with_pendant(shown_to(0.1, elbow(), other, 12, 4405)).agrees);
}

}  // namespace
}  // namespace demecal

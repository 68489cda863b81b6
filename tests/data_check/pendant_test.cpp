// Poses as a controller shows them, against a description with one mistake: the mistake is named, and a right
// description agrees.
#include "data_check/pendant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "elbow_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// What a controller of `truth` shows at joints drawn at random, to a hundredth of a millimetre and a thousandth of a
/// degree; the description is the data set's robot.
DataSet read_off(const Chain& truth, const Chain& described, int poses) {
  RandomStream stream{3301};
  const auto rounded = [](double value, double step) { return step * std::round(value / step); };
  DataSet data;
  data.robot.chain = described;
  data.frame = Frame::base;
  data.file = "pendant.csv";
  for (int i = 0; i < poses; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, truth);
    for (double& angle : pose.joints) angle = rounded(angle, 1e-3 * std::numbers::pi / 180.0);
    const Eigen::Vector3d shown = forward(truth, pose.joints) * truth.tool_m;
    pose.position_m = shown.unaryExpr([&](double value) { return rounded(value, 1e-5); });
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

/// Whether a finding has the words.
bool says(const PendantComparison& comparison, const std::string& words) {
  return std::ranges::any_of(comparison.findings,
                             [&](const std::string& finding) { return finding.find(words) != std::string::npos; });
}

PendantComparison compared(const std::function<void(Chain&)>& mistake, int poses = 12) {
  Chain described = elbow();
  mistake(described);
  return compare_with_pendant(read_off(elbow(), described, poses));
}

TEST(Pendant, AgreesWithARightDescription) {
  const PendantComparison comparison = compared([](Chain&) {}, 8);
  EXPECT_TRUE(comparison.agrees);
  EXPECT_TRUE(comparison.findings.empty());
}

TEST(Pendant, SaysOfWhichJointsPosesThatAgreeTellNothing) {
  Chain bare = elbow();
  bare.tool_m.setZero();
  DataSet shown = read_off(bare, bare, 8);
  for (int turn = 0; turn < 2; ++turn) {
    const PendantComparison flange = compare_with_pendant(shown);
    EXPECT_TRUE(flange.agrees);
    ASSERT_EQ(flange.findings.size(), 1U);
    EXPECT_TRUE(says(flange, "zero of joint 6:")) << flange.findings.front();
    for (MeasuredPose& pose : shown.poses) pose.joints[5] *= -1.0;  // as a description with the other sign has it
  }
  DataSet few = read_off(elbow(), elbow(), 4);
  EXPECT_TRUE(says(compare_with_pendant(few), "So few poses (4) agree"));
  DataSet still = read_off(elbow(), elbow(), 8);
  for (MeasuredPose& pose : still.poses) {
    pose.joints[3] = 0.0;
    pose.position_m = forward(elbow(), pose.joints) * elbow().tool_m;
  }
  const PendantComparison comparison = compare_with_pendant(still);
  EXPECT_TRUE(comparison.agrees);
  EXPECT_TRUE(says(comparison, "zero of joint 4:")) << ::testing::PrintToString(comparison.findings);
}

TEST(Pendant, NamesAToolThatIsDescribedElsewhere) {
  const PendantComparison other = compared([](Chain& chain) { chain.tool_m = {0.0, 0.0, 0.05}; });
  EXPECT_TRUE(other.explained);
  EXPECT_TRUE(says(other, "The tool")) << ::testing::PrintToString(other.findings);
  EXPECT_TRUE(says(other, "[40, 10, 120] mm")) << ::testing::PrintToString(other.findings);
  Chain bare = elbow();
  bare.tool_m.setZero();
  const PendantComparison flange = compare_with_pendant(read_off(bare, elbow(), 12));
  EXPECT_TRUE(says(flange, "the flange itself"));
}

TEST(Pendant, NamesABaseThatStandsElsewhere) {
  Chain raised = elbow();
  raised.joints[0].d_m -= 0.48;  // counted from the shoulder
  const PendantComparison comparison = compare_with_pendant(read_off(raised, elbow(), 12));
  EXPECT_TRUE(comparison.explained);
  EXPECT_TRUE(says(comparison, "The base")) << ::testing::PrintToString(comparison.findings);
}

TEST(Pendant, NamesEveryJointsSign) {
  for (std::size_t joint = 1; joint < 5; ++joint) {
    DataSet data = read_off(elbow(), elbow(), 14);
    for (MeasuredPose& pose : data.poses) pose.joints[static_cast<Eigen::Index>(joint)] *= -1.0;
    const PendantComparison comparison = compare_with_pendant(data);
    EXPECT_TRUE(comparison.explained) << joint;
    EXPECT_TRUE(says(comparison, "joint " + std::to_string(joint + 1)))
        << ::testing::PrintToString(comparison.findings);
    EXPECT_TRUE(says(comparison, "sign")) << ::testing::PrintToString(comparison.findings);
  }
}

TEST(Pendant, NamesAZeroThatIsElsewhere) {
  const PendantComparison comparison = compared([](Chain& chain) { chain.joints[2].theta_rad += 0.3; });
  EXPECT_TRUE(comparison.explained);
  EXPECT_TRUE(says(comparison, "joint 3")) << ::testing::PrintToString(comparison.findings);
}

TEST(Pendant, NamesALinkOfAnotherLength) {
  const PendantComparison comparison = compared([](Chain& chain) { chain.joints[1].a_m = 0.7; }, 20);
  EXPECT_TRUE(comparison.explained);
  EXPECT_TRUE(says(comparison, "joint 2 a_mm differs by -100")) << ::testing::PrintToString(comparison.findings);
}

TEST(Pendant, NamesALinkOfAnotherLengthByFewPoses) {
  for (const std::size_t joint : {1U, 2U, 3U}) {
    const PendantComparison comparison = compared([&](Chain& chain) { chain.joints[joint].a_m -= 0.01; }, 10);
    EXPECT_TRUE(comparison.explained) << joint;
    EXPECT_TRUE(says(comparison, "joint " + std::to_string(joint + 1) + " a_mm differs by"))
        << ::testing::PrintToString(comparison.findings);
  }
}

TEST(Pendant, NamesAJointThatMovesWithTheOneBefore) {
  DataSet data = read_off(elbow(), elbow(), 14);
  for (MeasuredPose& pose : data.poses) pose.joints[2] += pose.joints[1];
  const PendantComparison comparison = compare_with_pendant(data);
  EXPECT_TRUE(comparison.explained);
  EXPECT_TRUE(says(comparison, "joint 3")) << ::testing::PrintToString(comparison.findings);
}

TEST(Pendant, NamesTheLineOfASinglePoseThatIsWrong) {
  for (const std::size_t wrong : {0U, 5U, 9U}) {
    for (const bool joint : {false, true}) {
      DataSet data = read_off(elbow(), elbow(), 10);
      for (std::size_t i = 0; i < data.poses.size(); ++i) data.poses[i].line = i + 2;
      (joint ? data.poses[wrong].joints[2] : data.poses[wrong].position_m->y()) += 0.1;
      const PendantComparison comparison = compare_with_pendant(data);
      EXPECT_TRUE(comparison.explained);
      ASSERT_EQ(comparison.findings.size(), 1U);
      EXPECT_TRUE(says(comparison, "Line " + std::to_string(wrong + 2) + " (" + std::to_string(wrong + 1) +
                                       "): the other 9 poses agree"))
          << comparison.findings.front();
    }
  }
}

TEST(Pendant, SaysALineThatHasNoOtherNameOnce) {
  DataSet data = read_off(elbow(), elbow(), 10);
  data.poses[4].line = 6;
  data.poses[4].pose_id = "line 6";
  data.poses[4].position_m->x() += 0.1;
  EXPECT_TRUE(says(compare_with_pendant(data), "Line 6: the other 9 poses agree"));
}

TEST(Pendant, BlamesNoLineWhereTwoAreWrong) {
  DataSet data = read_off(elbow(), elbow(), 20);
  for (const std::size_t wrong : {3U, 8U}) data.poses[wrong].position_m->y() += 0.1;
  EXPECT_FALSE(says(compare_with_pendant(data), "the other"));
}

TEST(Pendant, SaysWhatItCannotTell) {
  const PendantComparison few = compared([](Chain& chain) { chain.joints[1].a_m = 0.7; }, 4);
  EXPECT_FALSE(few.explained);
  ASSERT_EQ(few.findings.size(), 1U);
  RandomStream stream{3302};
  DataSet nonsense = read_off(elbow(), elbow(), 30);
  for (MeasuredPose& pose : nonsense.poses)
    pose.position_m = Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
  EXPECT_FALSE(compare_with_pendant(nonsense).explained);
}

}  // namespace
}  // namespace demecal

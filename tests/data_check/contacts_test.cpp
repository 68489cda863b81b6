// A pose that touched another contact than it names is named, whichever it is; data without mistakes name nothing.
#include "data_check/searches.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kPlay_m = 5e-5;

DataSet socket_data(std::uint64_t seed) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  const Eigen::Vector3d left(0.45, 0.25, 0.1), right(0.35, -0.35, 0.35), gauge(0.0, 0.03, 0.04);
  touch(arm, stream, "left-0", left, 15, kPlay_m);
  touch(arm, stream, "left-1", left + gauge, 15, kPlay_m);
  touch(arm, stream, "right-0", right, 15, kPlay_m);
  touch(arm, stream, "right-1", right + gauge, 15, kPlay_m);
  return arm.data;
}

TEST(CheckContacts, SaysNothingOfDataWithoutMistakes) {
  for (const std::uint64_t seed : {9301u, 9302u, 9303u}) EXPECT_THAT(check_data(socket_data(seed)).findings, IsEmpty());
}

TEST(CheckContacts, NamesThePoseThatNamesTheWrongSocket) {
  const DataSet right = socket_data(9304);
  for (std::size_t wrong = 0; wrong < right.poses.size(); wrong += 4) {
    DataSet data = right;
    std::string& contact = data.poses[wrong].contact;
    contact.back() = contact.back() == '0' ? '1' : '0';
    const DataCheck check = check_data(data);
    ASSERT_EQ(check.findings.size(), 1u) << wrong;
    EXPECT_EQ(check.findings[0].kind, FindingKind::wrong_contact);
    EXPECT_THAT(check.findings[0].poses, ElementsAre(data.poses[wrong].pose_id));
    EXPECT_THAT(check.findings[0].sentence, HasSubstr("most likely it touched '" + right.poses[wrong].contact + "'"));
    EXPECT_EQ(check.verdict(), DataVerdict::suspicious);
  }
}

TEST(CheckContacts, NamesThePoseThatWasNotSeated) {
  DataSet data = socket_data(9305);
  data.poses[20].joints[3] += 0.02;
  const DataCheck check = check_data(data);
  ASSERT_EQ(check.findings.size(), 1u);
  EXPECT_EQ(check.findings[0].kind, FindingKind::outlier);
  EXPECT_THAT(check.findings[0].poses, ElementsAre(data.poses[20].pose_id));
}

TEST(CheckContacts, BlamesNoPoseForWhatAnEffectDoesToMany) {
  for (const std::uint64_t seed : {9307u, 9308u}) {
    DataSet data = socket_data(seed);
    for (std::size_t pose = 0; pose < data.poses.size(); pose += 6) data.poses[pose].joints[1] += 1.5e-3;
    EXPECT_THAT(check_data(data).findings, IsEmpty());
  }
}

TEST(CheckContacts, FindsTheJointThatCountsTheOtherWay) {
  DataSet data = socket_data(9306);
  for (MeasuredPose& pose : data.poses) pose.joints[2] = -pose.joints[2];
  const DataCheck check = check_data(data);
  ASSERT_EQ(check.findings.size(), 1u);
  EXPECT_EQ(check.findings[0].kind, FindingKind::joint_sign);
  EXPECT_EQ(check.findings[0].joint, 2);
  EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
}

}  // namespace
}  // namespace demecal

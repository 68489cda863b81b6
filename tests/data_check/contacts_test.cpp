// A pose that touched another contact than it names is named, whichever it is; data without mistakes name nothing.
#include "data_check/searches.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"
#include "kinematics/units.hpp"

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

DataSet with_known_lengths(DataSet data) {
  for (const char* side : {"left", "right"})
    data.contacts.distances.push_back({std::string(side) + "-0", std::string(side) + "-1", 0.05, 5e-5});
  return data;
}

TEST(CheckContacts, SaysNothingOfKnownLengthsThatAreRight) {
  for (const std::uint64_t seed : {9311u, 9312u, 9313u})
    EXPECT_THAT(check_data(with_known_lengths(socket_data(seed))).findings, IsEmpty());
}

TEST(CheckContacts, NamesTheUnitOfKnownLengths) {
  for (const auto& [factor, unit] : {std::pair(1e-3, "metres"), std::pair(0.1, "centimetres"),
                                     std::pair(1 / 25.4, "inches"), std::pair(1e3, "micrometres")}) {
    DataSet data = with_known_lengths(socket_data(9314));
    for (KnownDistance& known : data.contacts.distances) known.length_m *= factor;
    const DataCheck check = check_data(data);
    ASSERT_EQ(check.findings.size(), 2u) << unit;
    for (const Finding& finding : check.findings) {
      EXPECT_EQ(finding.kind, FindingKind::unit);
      EXPECT_THAT(finding.sentence, HasSubstr(std::string("the length fits if it is in ") + unit));
    }
    EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
  }
}

TEST(CheckContacts, NamesAKnownLengthThatIsOfNoUnit) {
  DataSet data = with_known_lengths(socket_data(9315));
  data.contacts.distances[1].length_m *= 3.0;
  const DataCheck check = check_data(data);
  ASSERT_EQ(check.findings.size(), 1u);
  EXPECT_EQ(check.findings[0].kind, FindingKind::wrong_length);
  EXPECT_THAT(check.findings[0].sentence, HasSubstr("'right-0' and 'right-1' are 150 mm apart as given"));
}

TEST(CheckContacts, NamesJointsInAnotherUnit) {
  for (const bool one : {false, true}) {
    DataSet data = with_known_lengths(socket_data(9316));
    for (MeasuredPose& pose : data.poses)
      for (int joint = 0; joint < pose.joints.size(); ++joint)
        if (!one || joint == 3) pose.joints[joint] *= radians(1.0);
    const DataCheck check = check_data(data);
    ASSERT_FALSE(check.findings.empty()) << one;
    EXPECT_EQ(check.findings.front().kind, FindingKind::unit) << check.findings.front().sentence;
    EXPECT_EQ(check.findings.front().joint, one ? 3 : -1);
    EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
  }
}

/// The same touched by validation poses as well.
DataSet validated_data(std::uint64_t seed) {
  DataSet data = with_known_lengths(socket_data(seed));
  for (std::size_t pose = 0; pose < data.poses.size(); pose += 3) data.poses[pose].set = PoseSet::validation;
  return data;
}

TEST(CheckContacts, NamesThePoseThatTouchedAFarSocketAndNotTheLengths) {
  for (std::size_t wrong = 0; wrong < 60; wrong += 7) {
    const DataSet right = validated_data(9317);
    DataSet data = right;
    std::string& contact = data.poses[wrong].contact;
    contact = (wrong < 30 ? "right" : "left") + contact.substr(contact.find('-'));
    const DataCheck check = check_data(data);
    ASSERT_EQ(check.findings.size(), 1u) << wrong;
    EXPECT_EQ(check.findings[0].kind, FindingKind::wrong_contact) << check.findings[0].sentence;
    EXPECT_THAT(check.findings[0].poses, ElementsAre(data.poses[wrong].pose_id));
    EXPECT_THAT(check.findings[0].sentence, HasSubstr("most likely it touched '" + right.poses[wrong].contact + "'"));
  }
}

TEST(CheckContacts, NamesTheSetWhoseSocketsAreExchanged) {
  DataSet data = validated_data(9318);
  EXPECT_THAT(check_data(data).findings, IsEmpty());
  for (MeasuredPose& pose : data.poses) {
    if (pose.set != PoseSet::validation) continue;
    if (pose.contact == "left-0") {
      pose.contact = "right-0";
    } else if (pose.contact == "right-0") {
      pose.contact = "left-0";
    }
  }
  const DataCheck check = check_data(data);
  ASSERT_EQ(check.findings.size(), 2u);
  for (const Finding& finding : check.findings) {
    EXPECT_EQ(finding.kind, FindingKind::wrong_length);
    EXPECT_THAT(finding.sentence, HasSubstr("of the validation poses"));
    EXPECT_THAT(finding.sentence, HasSubstr("'left-0' and 'right-0' are exchanged"));
    EXPECT_EQ(finding.poses.size(), 10u);
  }
}

TEST(CheckContacts, NamesAPoseThatIsAloneAtTheContactItNames) {
  DataSet data = socket_data(9319);
  data.poses[5].contact = "lfet-0";
  for (const bool length : {false, true}) {
    if (length) data.contacts.distances = {{"lfet-0", "left-1", 0.05, 1e-4}};
    const DataCheck check = check_data(data);
    ASSERT_EQ(check.findings.size(), 1u);
    EXPECT_EQ(check.findings[0].kind, FindingKind::wrong_contact);
    EXPECT_THAT(check.findings[0].poses, ElementsAre(data.poses[5].pose_id));
    EXPECT_THAT(check.findings[0].sentence, HasSubstr("nothing can be told of it. Nearest is 'left-0', 0."));
  }
}

TEST(CheckContacts, SaysOnceThatContactsAreTouchedOnceUnlessALengthNeedsThem) {
  RandomStream stream{9325};
  KnownArm arm{socket_data(9325), {}};
  arm.truth = nominal_robot(arm.data);
  const Eigen::Vector3d bar(0.1, 0.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d at_m(-0.3 + 0.12 * i, 0.45, 0.3);
    touch(arm, stream, "once-" + std::to_string(2 * i), at_m, 1, 0.0, PoseSet::accept);
    touch(arm, stream, "once-" + std::to_string(2 * i + 1), at_m + bar, 1, 0.0, PoseSet::accept);
  }
  const DataCheck check = check_data(arm.data);
  ASSERT_EQ(check.findings.size(), 1u);
  EXPECT_EQ(check.findings[0].kind, FindingKind::wrong_contact);
  EXPECT_EQ(check.findings[0].poses.size(), 8u);
  EXPECT_THAT(check.findings[0].sentence, HasSubstr("and so do 7 more at theirs"));
  for (int i = 0; i < 4; ++i)
    arm.data.contacts.distances.push_back(
        {"once-" + std::to_string(2 * i), "once-" + std::to_string(2 * i + 1), 0.1, 1e-4});
  EXPECT_THAT(check_data(arm.data).findings, IsEmpty());
}

TEST(CheckContacts, NamesTheRowFromWhichASocketStandsElsewhere) {
  for (const auto& [seed, from] : {std::pair(9320u, 4), std::pair(9321u, 8), std::pair(9322u, 11)}) {
    RandomStream stream{seed};
    KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
    misbuild(arm, stream, {.joint_offset = true, .geometry = true});
    const Eigen::Vector3d left(0.45, 0.25, 0.1), right(0.35, -0.35, 0.35), slip(0.0, 6e-4, -4e-4);
    touch(arm, stream, "left", left, from, kPlay_m);
    touch(arm, stream, "left", left + slip, 15 - from, kPlay_m);
    touch(arm, stream, "right", right, 25, kPlay_m);
    touch(arm, stream, "back", {-0.3, 0.4, 0.3}, 15, kPlay_m);
    const DataCheck check = check_data(arm.data);
    ASSERT_EQ(check.findings.size(), 1u) << from;
    EXPECT_EQ(check.findings[0].kind, FindingKind::contact_moved) << check.findings[0].sentence;
    EXPECT_EQ(check.findings[0].poses.size(), static_cast<std::size_t>(15 - from));
    EXPECT_THAT(
        check.findings[0].sentence,
        HasSubstr("'left' moved before line " + std::to_string(arm.data.poses[static_cast<std::size_t>(from)].line)));
    EXPECT_EQ(check.verdict(), DataVerdict::suspicious);
  }
}

TEST(CheckContacts, TakesASteadyDriftForNoStep) {
  DataSet data = socket_data(9323);
  for (std::size_t pose = 0; pose < data.poses.size(); ++pose)
    data.poses[pose].joints[1] += 2e-3 * static_cast<double>(pose % 15) / 15.0;
  for (const Finding& finding : check_data(data).findings) EXPECT_NE(finding.kind, FindingKind::contact_moved);
}

TEST(CheckContacts, TakesLostMotionBetweenStatedSidesForNoStep) {
  DataSet data = socket_data(9324);
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    MeasuredPose& pose = data.poses[i];
    const double side = pose.contact == "left-0" && i % 15 < 7 ? 1.0 : -1.0;
    pose.joints[1] += 6e-4 * side;
    pose.approach = ApproachSigns::Constant(pose.joints.size(), side);
  }
  EXPECT_FALSE(check_data(data).has(FindingKind::contact_moved));
  for (MeasuredPose& pose : data.poses) pose.approach.reset();
  EXPECT_TRUE(check_data(data).has(FindingKind::contact_moved)) << "nothing is stated that explains it";
}

TEST(CheckContacts, NamesJointsThatWereComputedAndNotRead) {
  for (const double play_m : {0.0, kPlay_m}) {
    RandomStream stream{9324};
    KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
    touch(arm, stream, "left", {0.45, 0.25, 0.1}, 15, play_m);
    touch(arm, stream, "right", {0.35, -0.35, 0.35}, 15, play_m);
    for (MeasuredPose& pose : arm.data.poses)
      for (double& joint : pose.joints) joint = radians(std::round(degrees(joint) * 1e4) / 1e4);
    const DataCheck check = check_data(arm.data);
    EXPECT_EQ(check.has(FindingKind::computed_positions), play_m == 0.0);
    EXPECT_EQ(check.findings.size(), play_m == 0.0 ? 1u : 0u);
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

// A contact whose kind was forgotten is named with its kind, and the joints are not blamed for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kTouchPlay_m = 4e-5;

/// Two sockets, two plates and a ball.
KnownArm arm_at_surfaces(std::uint64_t seed) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seed % 2 == 0 ? seven_joint_arm() : modified_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  touch(arm, stream, "left", {0.45, 0.25, 0.1}, 10, kTouchPlay_m);
  touch(arm, stream, "right", {0.35, -0.35, 0.35}, 10, kTouchPlay_m);
  touch_plate(arm, stream, "plate", {0.4, 0.05, 0.15}, 0.15, 14, kTouchPlay_m);
  touch_plate(arm, stream, "top", {0.4, 0.05, 0.35}, 0.15, 14, kTouchPlay_m);
  touch_ball(arm, stream, "ball", {0.4, 0.2, 0.2}, 0.04, 14, kTouchPlay_m);
  return arm;
}

DataSet forgotten(DataSet data, const std::vector<std::string>& contacts) {
  for (const std::string& contact : contacts) {
    data.contacts.forms.erase(contact);
    for (MeasuredPose& pose : data.poses)
      if (pose.contact == contact) pose.contact_kind = ContactKind::point;
  }
  return data;
}

TEST(ContactKinds, AreNotDoubtedWhereTheyAreStated) {
  for (const std::uint64_t seed : {10001u, 10002u})
    EXPECT_THAT(check_data(arm_at_surfaces(seed).data).findings, IsEmpty());
}

TEST(ContactKinds, AreNamedWhereTheyWereForgotten) {
  for (const std::uint64_t seed : {10003u, 10004u, 10005u, 10006u}) {
    const DataSet data = arm_at_surfaces(seed).data;
    for (const std::vector<std::string>& contacts :
         {std::vector<std::string>{"plate"}, {"ball"}, {"ball", "plate"}, {"plate", "top"}, {"ball", "plate", "top"}}) {
      const std::vector<Finding> found = check_data(forgotten(data, contacts)).findings;
      ASSERT_EQ(found.size(), contacts.size()) << seed << " " << contacts.front();
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].kind, FindingKind::wrong_kind);
        EXPECT_EQ(found[i].poses.size(), 14u);
        EXPECT_THAT(found[i].sentence, HasSubstr("Contact '" + contacts[i] + "' is no point"));
        EXPECT_THAT(found[i].sentence, HasSubstr(contacts[i] == "ball" ? "{ball: sphere}" : contacts[i] + ": plane}"));
      }
    }
  }
}

/// Two balls and an edge, by no socket.
KnownArm arm_at_balls_and_edge(std::uint64_t seed) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seed % 2 == 0 ? seven_joint_arm() : modified_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  touch_ball(arm, stream, "left", {0.45, 0.25, 0.1}, 0.025, 24, kTouchPlay_m);
  touch_ball(arm, stream, "right", {0.35, -0.35, 0.35}, 0.025, 24, kTouchPlay_m);
  for (int i = 0; i < 20; ++i) {
    const double along_m = stream.real(-0.15, 0.15);
    touch(arm, stream, "edge", Eigen::Vector3d(0.4, 0.05, 0.2) + along_m * Eigen::Vector3d(0.2, 0.97, 0.1), 1,
          kTouchPlay_m);
    arm.data.poses.back().contact_kind = ContactKind::line;
  }
  arm.data.contacts.forms["edge"].kind = ContactKind::line;
  return arm;
}

TEST(ContactKinds, AreNamedWhereNoSocketIsTouched) {
  for (const std::uint64_t seed : {10021u, 10022u, 10023u, 10024u}) {
    const DataSet data = arm_at_balls_and_edge(seed).data;
    EXPECT_THAT(check_data(data).findings, IsEmpty()) << seed;
    const std::vector<Finding> found = check_data(forgotten(data, {"edge"})).findings;
    ASSERT_EQ(found.size(), 1u) << seed;
    EXPECT_EQ(found[0].kind, FindingKind::wrong_kind);
    EXPECT_THAT(found[0].sentence, HasSubstr("{edge: line}"));
  }
}

/// Rows of two edges that share a name are of no kind of contact: nobody may take their model for a sound one.
TEST(ContactKinds, ThatNoneFitsAreContradictions) {
  for (const std::uint64_t seed : {10031u, 10032u}) {
    KnownArm arm = arm_at_balls_and_edge(seed);
    RandomStream stream{seed + 10};
    for (int i = 0; i < 12; ++i)
      touch(arm, stream, "edge", {0.3, stream.real(-0.2, 0.2), stream.real(0.3, 0.4)}, 1, kTouchPlay_m);
    const DataCheck check = check_data(forgotten(arm.data, {"edge"}));
    EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << seed;
  }
}

/// A socket seems to lie on a circle where the first joint is read the other way, which is no kind of contact.
TEST(ContactKinds, AreNotBlamedForJointsReadOtherwise) {
  DataSet data = arm_at_surfaces(10008).data;
  for (MeasuredPose& pose : data.poses) pose.joints[0] = -pose.joints[0];
  const DataCheck check = check_data(data);
  EXPECT_FALSE(check.has(FindingKind::wrong_kind));
  EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
}

TEST(ContactKinds, AreNotGuessedWhereSocketsShareAName) {
  DataSet data = arm_at_surfaces(10010).data;
  for (MeasuredPose& pose : data.poses)
    if (pose.contact == "right") pose.contact = "left";
  EXPECT_FALSE(check_data(data).has(FindingKind::wrong_kind));
}

TEST(ContactKinds, OfPlanesThatAreStatedAsSquareAndAreParallelAreNamed) {
  for (const bool square : {false, true}) {
    DataSet data = arm_at_surfaces(10012).data;
    data.contacts.angles = {{"plate", "top", square, radians(0.05)}};
    const std::vector<Finding> found = check_data(data).findings;
    ASSERT_EQ(found.size(), square ? 1u : 0u);
    if (!square) continue;
    EXPECT_EQ(found[0].kind, FindingKind::wrong_kind);
    EXPECT_THAT(found[0].sentence, HasSubstr("'plate' and 'top' are square to one another as stated, and "));
  }
}

}  // namespace
}  // namespace demecal

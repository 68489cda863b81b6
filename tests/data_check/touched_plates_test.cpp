// A plate that few poses touch: none of these is blamed for how much the plate's place leans on it, and one that did
// not touch it is named alone, or with those that may be wrong in its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Eigen::Vector3d kPlateMiddle(0.4, 0.05, 0.15);

/// Four sockets, and a plate that so many poses touch for calibration, the last of them `off_m` above it, and others
/// for validation.
DataSet plate_data(std::uint64_t seed, int touches, int validating, double off_m = 0.0) {
  constexpr double kPlay_m = 4e-5;
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  const Eigen::Vector3d gauge(0.0, 0.06, 0.08);
  for (const auto& [side, at_m] :
       {std::pair("left", Eigen::Vector3d(0.45, 0.25, 0.1)), std::pair("right", Eigen::Vector3d(0.35, -0.35, 0.35))}) {
    touch(arm, stream, std::string(side) + "-0", at_m, 8, kPlay_m);
    touch(arm, stream, std::string(side) + "-1", at_m + gauge, 8, kPlay_m);
  }
  touch_plate(arm, stream, "plate", kPlateMiddle, 0.15, validating, kPlay_m, PoseSet::validation);
  touch_plate(arm, stream, "plate", kPlateMiddle, 0.15, touches - 1, kPlay_m);
  touch_plate(arm, stream, "plate", kPlateMiddle + Eigen::Vector3d(0.0, 0.0, off_m), 0.15, 1, kPlay_m);
  return arm.data;
}

TEST(TouchedPlates, NameNoPoseThatIsRight) {
  for (std::uint64_t seed = 9901; seed < 9911; ++seed)
    for (const int validating : {3, 4, 5})
      EXPECT_THAT(check_data(plate_data(seed, 8, validating)).findings, IsEmpty()) << seed << " " << validating;
}

TEST(TouchedPlates, NameThePoseThatDidNotTouchAndNoOther) {
  for (std::uint64_t seed = 9921; seed < 9925; ++seed)
    for (const int touches : {8, 14})
      for (const double off_m : {2e-3, 1e-2, 0.2}) {
        const DataSet data = plate_data(seed, touches, 4, off_m);
        const std::vector<Finding> found = check_data(data).findings;
        ASSERT_EQ(found.size(), 1u) << seed << " " << touches << " " << off_m;
        EXPECT_EQ(found[0].kind, FindingKind::outlier);
        EXPECT_THAT(found[0].poses, ElementsAre(data.poses.back().pose_id));
      }
}

TEST(TouchedPlates, SayThatOneOfTooFewPosesIsWrong) {
  const DataSet data = plate_data(9931, 4, 0, 1e-2);
  const std::vector<Finding> found = check_data(data).findings;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, FindingKind::outlier);
  EXPECT_EQ(found[0].poses.size(), 4u);
  EXPECT_THAT(found[0].poses, Contains(data.poses.back().pose_id));
  EXPECT_THAT(found[0].sentence, HasSubstr("one at least does not fit contact 'plate'"));
}

TEST(TouchedPlates, NameThePlateThatAPoseTouchedInstead) {
  DataSet data = plate_data(9941, 8, 4);
  for (const char* const wrong : {"left-1", "right-0"}) {
    DataSet changed = data;
    MeasuredPose& pose = changed.poses.back();
    pose.contact = wrong;
    pose.contact_kind = ContactKind::point;
    const std::vector<Finding> found = check_data(changed).findings;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, FindingKind::wrong_contact);
    EXPECT_THAT(found[0].poses, ElementsAre(pose.pose_id));
    EXPECT_THAT(found[0].sentence, HasSubstr("most likely it touched 'plate'"));
  }
}

/// Two pairs of sockets as before, a flat plate, and one whose rim is so much above its middle.
DataSet sagging_plate_data(std::uint64_t seed, double sag_m) {
  constexpr double kHalf_m = 0.15, kPlay_m = 4e-5;
  constexpr int kTouches = 16;
  DataSet sockets = plate_data(seed, kTouches, 0);
  RandomStream stream{seed, 1};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  RandomStream as_before{seed};
  misbuild(arm, as_before, {.joint_offset = true, .geometry = true});
  for (int i = 0; i < kTouches; ++i) {
    const Eigen::Vector2d off_m(stream.real(-kHalf_m, kHalf_m), stream.real(-kHalf_m, kHalf_m));
    const double height_m = sag_m * off_m.squaredNorm() / (2.0 * kHalf_m * kHalf_m);
    touch(arm, stream, "top", Eigen::Vector3d(0.4 + off_m.x(), 0.05 + off_m.y(), 0.35 + height_m), 1, kPlay_m);
    arm.data.poses.back().contact_kind = ContactKind::plane;
    arm.data.poses.back().pose_id = "top-" + std::to_string(i);
    sockets.poses.push_back(arm.data.poses.back());
  }
  sockets.contacts.forms["top"].kind = ContactKind::plane;
  return sockets;
}

TEST(TouchedPlates, AreNamedWhereTheyAreNotFlat) {
  for (std::uint64_t seed = 9961; seed < 9967; ++seed) {
    EXPECT_THAT(check_data(sagging_plate_data(seed, 0.0)).findings, IsEmpty()) << seed;
    DataSet data = sagging_plate_data(seed, 2e-3);
    const std::vector<Finding> found = check_data(data).findings;
    ASSERT_EQ(found.size(), 1u) << seed;
    EXPECT_EQ(found[0].kind, FindingKind::uneven_plane);
    EXPECT_THAT(found[0].sentence, HasSubstr("Plane 'top' is not flat"));
    data.contacts.forms["top"].flatness_m = 2e-3;
    weigh_by_flatness(data);
    EXPECT_THAT(check_data(data).findings, IsEmpty()) << seed;
  }
}

TEST(TouchedPlates, NameNoPoseForTheFlatnessThatIsStated) {
  DataSet data = plate_data(9951, 14, 4, 8e-4);
  EXPECT_EQ(check_data(data).findings.size(), 1u);
  data.contacts.forms["plate"].flatness_m = 2e-3;
  weigh_by_flatness(data);
  EXPECT_THAT(check_data(data).findings, IsEmpty());
}

TEST(TouchedPlates, AreAsFarApartAsTheyAreHoweverFewPosesTouchThem) {
  constexpr double kPlay_m = 4e-5;
  const Eigen::Vector3d shelf_m = kPlateMiddle + Eigen::Vector3d(0.08, 0.04, 0.1);
  for (std::uint64_t seed = 9941; seed < 9946; ++seed) {
    for (const int validating : {2, 3, 4, 6}) {
      RandomStream stream{seed};
      KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
      misbuild(arm, stream, {.joint_offset = true, .geometry = true});
      touch(arm, stream, "left", Eigen::Vector3d(0.45, 0.25, 0.1), 12, kPlay_m);
      touch(arm, stream, "right", Eigen::Vector3d(0.35, -0.35, 0.35), 12, kPlay_m);
      for (const auto& [set, touches] : {std::pair{PoseSet::calibration, 12}, {PoseSet::validation, validating}}) {
        touch_plate(arm, stream, "plate", kPlateMiddle, 0.08, touches, kPlay_m, set);
        touch_plate(arm, stream, "shelf", shelf_m, 0.03, touches, kPlay_m, set);
      }
      arm.data.contacts.distances = {{"plate", "shelf", 0.1, 1e-5}};
      EXPECT_THAT(check_data(arm.data).findings, IsEmpty()) << seed << " " << validating;
      arm.data.contacts.distances[0].length_m = 0.15;
      EXPECT_FALSE(check_data(arm.data).findings.empty()) << seed << " " << validating;
    }
  }
}

}  // namespace
}  // namespace demecal

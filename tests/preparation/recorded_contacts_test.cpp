// Every touch in a recording is found, with the joints, approach and contact that are true, and nothing else is taken
// for one; what is not sure is named.
#include "preparation/recorded_contacts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "../errors/complaint.hpp"
#include "preparation/touched_places.hpp"
#include "recorded_log.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A misbuilt arm, and its poses at two sockets 50 mm apart in each of two places, one after another as people visit
/// them.
KnownArm arm_at_sockets(const Chain& chain, RandomStream& stream, int poses) {
  KnownArm arm = perfect_arm(chain, Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  const Eigen::Vector3d left(0.45, 0.25, 0.1), right(0.35, -0.35, 0.35), apart(0.0, 0.03, 0.04);
  touch(arm, stream, "left-0", left, poses, 5e-5);
  touch(arm, stream, "left-1", left + apart, poses, 5e-5);
  touch(arm, stream, "right-0", right, poses, 5e-5);
  touch(arm, stream, "right-1", right + apart, poses, 5e-5);
  return arm;
}

const TrueStop* stop_at(const RecordedArm& recording, const JudgedStandstill& one) {
  const double middle_s = one.at.start_s + 0.5 * one.at.duration_s;
  const TrueStop* found = nullptr;
  for (const TrueStop& stop : recording.stops())
    if (stop.at_s <= middle_s) found = &stop;
  return found;
}

/// Every pose is one of the true touches, and all touches but those that are named unsure are poses.
void expect_true_poses(const RecordedArm& recording, const RecordedContacts& found, double noise_rad) {
  std::map<std::size_t, std::set<std::string>> names;
  std::size_t touches = 0, poses = 0, named = 0;
  for (const TrueStop& stop : recording.stops()) touches += stop.contact.empty() ? 0 : 1;
  for (const JudgedStandstill& one : found.standstills) {
    const TrueStop* const stop = stop_at(recording, one);
    ASSERT_NE(stop, nullptr);
    named += stop->contact.empty() ? 0 : 1;
    if (one.standing != Standing::touches) continue;
    ++poses;
    ASSERT_FALSE(stop->contact.empty()) << "taken for a touch: line " << one.at.first_line;
    names[*one.contact].insert(stop->contact);
    EXPECT_LT((one.at.joints - stop->joints).cwiseAbs().maxCoeff(), noise_rad + 1e-5);
    for (Eigen::Index joint = 0; joint < stop->approach.size(); ++joint) {
      if (stop->approach[joint] == kEither) continue;
      EXPECT_EQ(one.at.approach[joint], stop->approach[joint]) << joint;
    }
  }
  EXPECT_EQ(named, touches);
  EXPECT_GE(20 * poses, 19 * touches - 20);  // one in twenty, and one more, may not be sure
  EXPECT_EQ(names.size(), 4u);
  for (const auto& [contact, true_names] : names) EXPECT_EQ(true_names.size(), 1u) << found.contacts[contact].name;
}

TEST(RecordedContacts, AreTheTouchesOfEveryArmAndLoggerAndNothingElse) {
  const Logger loggers[] = {{0.02, 2e-5, 0.0}, {0.1, 5e-5, 0.0}, {0.004, 0.0, 1e-4}, {0.008, 1e-4, 0.0}};
  const Chain chains[] = {seven_joint_arm(), parallel_arm(), modified_arm(), stanford_arm()};
  std::uint64_t seed = 8801;
  for (const Chain& chain : chains) {
    for (const Logger& logger : loggers) {
      SCOPED_TRACE(seed);
      RandomStream stream{seed++};
      const KnownArm arm = arm_at_sockets(chain, stream, 8);
      const RecordedArm recording = recorded(arm, stream, logger);
      const RecordedContacts found = find_contacts(recordings_of(arm, recording.log()));
      expect_true_poses(recording, found, 2.0 * logger.noise_rad + 0.5 * logger.count_rad);
    }
  }
}

TEST(RecordedContacts, AreNamedByTheirFirstVisitAndGoOnIntoADataSet) {
  RandomStream stream{8820};
  const KnownArm arm = arm_at_sockets(seven_joint_arm(), stream, 10);
  const RecordedArm recording = recorded(arm, stream, {});
  Recordings recordings = recordings_of(arm, recording.log());
  recordings.distances = {{"A", "B", 0.05, 5e-5}};
  recordings.distance_lines = {7};
  const RecordedContacts found = find_contacts(recordings);
  ASSERT_EQ(found.contacts.size(), 4u);
  EXPECT_NEAR(*found.contacts[0].nearest_m, 0.05, 0.02);
  const DataSet data = recorded_data_set(recordings, found);
  ASSERT_GE(data.poses.size(), 39u);
  EXPECT_EQ(data.contacts.distances.size(), 1u);
  std::string last = "A";
  std::map<ContactGroup, std::vector<std::size_t>> groups = contact_groups(data);
  for (const MeasuredPose& pose : data.poses) {
    EXPECT_GE(pose.contact, last);
    last = pose.contact;
    EXPECT_TRUE(pose.approach && pose.time_s);
  }
  for (const char* contact : {"A", "B", "C", "D"}) {
    EXPECT_EQ(groups.count({contact, PoseSet::calibration}), 1u);
    EXPECT_EQ((groups[{contact, PoseSet::validation}].size()), 3u) << contact;
  }
  recordings.distances.front().second = "E";
  EXPECT_THAT(demecal::complaint([&] { find_contacts(recordings); }),
              HasSubstr("preparation.yaml:7: 'E': is none of the contacts that were found in the log: A, B, C, D"));
  recordings.names = {"left", "right"};
  recordings.names_line = 6;
  EXPECT_THAT(demecal::complaint([&] { find_contacts(recordings); }), HasSubstr("names 2 contacts, but 4 were found"));
}

TEST(RecordedContacts, AreFoundWhereTheToolIsKnownToSomeCentimetresOnly) {
  for (const std::uint64_t seed : {8831u, 8832u, 8833u}) {
    RandomStream stream{seed};
    KnownArm arm = arm_at_sockets(seven_joint_arm(), stream, 10);
    const RecordedArm recording = recorded(arm, stream, {});
    arm.data.robot.chain.tool_m += Eigen::Vector3d(0.03, -0.04, 0.07);
    const RecordedContacts found = find_contacts(recordings_of(arm, recording.log()));
    expect_true_poses(recording, found, 4e-5);
    EXPECT_LT((found.tool_m - seven_joint_arm().tool_m).norm(), 0.01);
    EXPECT_THAT(found.notes, Contains(HasSubstr("agree best with the tool point at")));
  }
}

TEST(RecordedContacts, NoteNothingOfCleanRecordings) {
  RandomStream stream{8840};
  const KnownArm arm = arm_at_sockets(seven_joint_arm(), stream, 10);
  const RecordedContacts found = find_contacts(recordings_of(arm, recorded(arm, stream, {}).log()));
  EXPECT_THAT(found.notes, IsEmpty());
}

/// The verdict on the standstill at that time.
Standing standing_at(const RecordedContacts& found, double at_s) {
  for (const JudgedStandstill& one : found.standstills)
    if (one.at.start_s <= at_s && at_s <= one.at.start_s + one.at.duration_s) return one.standing;
  ADD_FAILURE() << "nothing stands at " << at_s << " s";
  return Standing::touches;
}

TEST(RecordedContacts, NameWhatTheyAreNotSureOf) {
  RandomStream stream{8850};
  const KnownArm arm = arm_at_sockets(seven_joint_arm(), stream, 10);
  const Chain& chain = arm.data.robot.chain;
  RecordedArm recording = recorded(arm, stream, {});
  const auto visit = [&](const JointVector& joints, double stood_s) {
    recording.move(joints, 1.5);
    recording.stand(stood_s);
    return recording.stops().back().at_s + 0.5 * stood_s;
  };
  // between the first two sockets, and beside one of them
  KnownArm beside = perfect_arm(chain, Frame::base);
  touch(beside, stream, "between", Eigen::Vector3d(0.45, 0.265, 0.12), 1, 0.0);
  touch(beside, stream, "far", Eigen::Vector3d(0.45, 0.25, 0.07), 1, 0.0);
  const double between_s = visit(beside.data.poses[0].joints, 1.0), far_s = visit(beside.data.poses[1].joints, 1.0);
  const double brief_s = visit(arm.data.poses[0].joints, 0.35);
  // a joint that goes on slowly while the others stand
  recording.move(arm.data.poses[3].joints, 1.5);
  const double moving_s = recording.log().times_s.back() + 1.0;
  JointVector gone = recording.at();
  gone[0] += 1.2e-3;
  recording.creep(gone, 2.0);
  recording.move(arm.data.poses[5].joints, 1.5);
  recording.stand(1.0);
  Recordings recordings = recordings_of(arm, recording.log());
  recordings.gap_m = 0.035;
  const RecordedContacts found = find_contacts(recordings);
  EXPECT_EQ(standing_at(found, between_s), Standing::between_contacts);
  EXPECT_THAT((std::set{Standing::far_out, Standing::alone}), Contains(standing_at(found, far_s)));
  EXPECT_EQ(standing_at(found, brief_s), Standing::too_short);
  EXPECT_EQ(standing_at(found, moving_s), Standing::moving);
  EXPECT_EQ(standing_at(found, 0.7), Standing::one_posture);
}

TEST(RecordedContacts, SayWhereTwoAreNearerThanTheirScatter) {
  RandomStream stream{8860};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  const Eigen::Vector3d at(0.45, 0.25, 0.1);
  touch(arm, stream, "one", at, 12, 5e-5);
  touch(arm, stream, "other", at + Eigen::Vector3d(0.0, 0.0, 0.012), 12, 5e-5);
  Recordings recordings = recordings_of(arm, recorded(arm, stream, {}).log());
  recordings.gap_m = 0.006;
  EXPECT_THAT(find_contacts(recordings).notes, Contains(HasSubstr("some may be at the other one")));
}

TEST(RecordedContacts, AreRefusedWhereTheArmNeverStandsOrNothingIsTouchedTwice) {
  RandomStream stream{8870};
  const KnownArm arm = arm_at_sockets(seven_joint_arm(), stream, 3);
  RecordedArm restless(stream, {}, arm.data.poses[0].joints), wanderer(stream, {}, arm.data.poses[0].joints);
  for (const MeasuredPose& pose : arm.data.poses) restless.move(pose.joints + JointVector::Constant(7, 0.3), 1.5);
  EXPECT_THAT(demecal::complaint([&] { find_contacts(recordings_of(arm, restless.log())); }),
              HasSubstr("log.csv: the arm stands nowhere for 0.5 s: every joint must be slower than"));
  for (const std::size_t pose : {0u, 3u, 6u, 9u}) {
    wanderer.move(arm.data.poses[pose].joints, 1.5);
    wanderer.stand(1.0);
  }
  EXPECT_THAT(demecal::complaint([&] { find_contacts(recordings_of(arm, wanderer.log())); }),
              HasSubstr("but no place that it came to in 4 postures or more"));
}

TEST(GroupPlaces, TellsPlacesApartByTheWidestGap) {
  for (std::uint64_t seed = 8881; seed < 8891; ++seed) {
    RandomStream stream{seed};
    std::vector<Eigen::Vector3d> places_m;
    std::vector<std::size_t> truth;
    for (std::size_t group = 0; group < 3; ++group) {
      for (int place = 0; place < 20; ++place) {
        places_m.push_back(Eigen::Vector3d(0.05 * static_cast<double>(group), 0.0, 0.3) + random_vector(stream, 4e-3));
        truth.push_back(group);
      }
    }
    const PlaceGroups groups = group_places(places_m, {});
    EXPECT_EQ(groups.group_of, truth) << seed;
    EXPECT_EQ(group_places(places_m, 0.2).groups, 1u);
  }
}

TEST(GroupPlaces, NamesAGroupThatMayBeTwo) {
  RandomStream stream{8895};
  std::vector<Eigen::Vector3d> places_m;
  for (int place = 0; place < 20; ++place)
    places_m.push_back(Eigen::Vector3d(place < 8 ? 0.0 : 0.015, 0.0, 0.3) + random_vector(stream, 3e-4));
  const PlaceGroups groups = group_places(places_m, {});
  ASSERT_EQ(groups.groups, 1u);
  ASSERT_EQ(groups.doubtful.size(), 1u);
  EXPECT_EQ(std::min(groups.doubtful[0].first, groups.doubtful[0].second), 8u);
  EXPECT_NEAR(groups.doubtful[0].apart_m, 0.015, 1e-3);
}

}  // namespace
}  // namespace demecal

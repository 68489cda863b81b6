// Two sockets whose names are exchanged from a row on are found with the row, and taken for nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>

#include "data_check/check_data.hpp"
#include "data_check/searches.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Four sockets by turns, as people touch them who change between them often.
DataSet sockets_by_turns(std::uint64_t seed, double apart_m) {
  constexpr double kPlayByTurns_m = 5e-5;
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.tool = true, .joint_offset = true, .geometry = true});
  const Eigen::Vector3d left(0.45, 0.25, 0.1), right(0.35, -0.35, 0.35), gauge(0.0, apart_m, 0.0);
  for (int turn = 0; turn < 15; ++turn) {
    touch(arm, stream, "left-0", left, 1, kPlayByTurns_m);
    touch(arm, stream, "left-1", left + gauge, 1, kPlayByTurns_m);
    touch(arm, stream, "right-0", right, 1, kPlayByTurns_m);
    touch(arm, stream, "right-1", right + gauge, 1, kPlayByTurns_m);
  }
  return arm.data;
}

TEST(ExchangedContacts, AreNamedWithTheRowFromWhichTheyAre) {
  for (const std::uint64_t seed : {9861u, 9862u, 9863u, 9864u}) {
    for (const double apart_m : {0.05, 0.2}) {
      for (const std::size_t from : {16u, 28u, 44u}) {
        DataSet data = sockets_by_turns(seed, apart_m);
        for (std::size_t i = from; i < data.poses.size(); ++i) {
          std::string& contact = data.poses[i].contact;
          if (contact.starts_with("left")) contact.back() = contact.back() == '0' ? '1' : '0';
        }
        const DataCheck check = check_data(data);
        ASSERT_EQ(check.findings.size(), 1u) << seed << " " << from;
        EXPECT_EQ(check.findings[0].kind, FindingKind::targets_exchanged) << check.findings[0].sentence;
        EXPECT_THAT(check.findings[0].sentence, HasSubstr("From line " + std::to_string(data.poses[from].line) + " "));
        EXPECT_THAT(check.findings[0].sentence, HasSubstr("'left-0' and 'left-1' are exchanged"));
        EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
      }
    }
  }
}

TEST(ExchangedContacts, AreNoneInDataWithoutMistakes) {
  for (const std::uint64_t seed : {9871u, 9872u, 9873u})
    EXPECT_TRUE(check_data(sockets_by_turns(seed, 0.05)).findings.empty());
}

TEST(ExchangedContacts, NoContactIsSaidToHaveMovedForPosesAtAnother) {
  for (const std::uint64_t seed : {9881u, 9882u, 9883u}) {
    RandomStream stream{seed};
    KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
    touch(arm, stream, "left", {0.45, 0.25, 0.1}, 12, 5e-5);
    touch(arm, stream, "right", {0.45, 0.3, 0.1}, 12, 5e-5);
    std::set<std::size_t> elsewhere;
    for (std::size_t pose = 9; pose < 12; ++pose) {
      arm.data.poses[pose].contact = "right";
      arm.data.poses[pose + 12].contact = "left";
      elsewhere.insert({pose, pose + 12});
    }
    EXPECT_FALSE(find_moved_contacts(arm.data, arm.truth, {}).empty());
    EXPECT_TRUE(find_moved_contacts(arm.data, arm.truth, elsewhere).empty());
    for (const Finding& one : find_wrong_contacts(arm.data, arm.truth)) {
      EXPECT_EQ(one.kind, FindingKind::wrong_contact) << one.sentence;
      EXPECT_THAT(one.sentence, Not(HasSubstr("moved")));
    }
  }
}

}  // namespace
}  // namespace demecal

// Two holes of a plate whose names are exchanged in all poses, or in contacts.grids: the pair is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// An arm that touches holes of a level plate, whose lengths stand as contacts.grids has them.
DataSet holes_data(std::uint64_t seed, const std::map<std::string, Eigen::Vector2d>& holes_m) {
  const Eigen::Vector3d corner_m(0.3, -0.1, 0.15);
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  for (const auto& [name, at_m] : holes_m) {
    touch(arm, stream, name, corner_m + Eigen::Vector3d(at_m.x(), at_m.y(), 0.0), 12, 5e-5);
    for (const auto& [other, there_m] : holes_m) {
      if (other == name) break;
      arm.data.contacts.distances.push_back({other, name, (at_m - there_m).norm(), 4e-5, true});
    }
  }
  return arm.data;
}

DataSet with_names_exchanged(DataSet data, const std::string& first, const std::string& second) {
  for (MeasuredPose& pose : data.poses)
    if (pose.contact == first || pose.contact == second) pose.contact = pose.contact == first ? second : first;
  return data;
}

const std::map<std::string, Eigen::Vector2d> kPlate{
    {"A1", {0.0, 0.0}}, {"A2", {0.04, 0.0}}, {"A3", {0.08, 0.0}}, {"B1", {0.0, 0.06}}, {"C2", {0.04, 0.15}}};

TEST(ExchangedPlaces, OfAGridAreNamedWithTheirPoses) {
  for (const std::uint64_t seed : {9801u, 9802u, 9803u}) {
    const DataSet right = holes_data(seed, kPlate);
    EXPECT_THAT(check_data(right).findings, IsEmpty());
    for (const auto& [first, second] : {std::pair("A1", "C2"), std::pair("A2", "A3"), std::pair("A2", "B1")}) {
      const std::vector<Finding> found = check_data(with_names_exchanged(right, first, second)).findings;
      ASSERT_EQ(found.size(), 1u) << first << second;
      EXPECT_EQ(found[0].kind, FindingKind::targets_exchanged);
      EXPECT_THAT(found[0].sentence, AllOf(HasSubstr(std::string("once the names of '") + first + "' and '" + second +
                                                     "' are exchanged. Correct"),
                                           HasSubstr("contacts.grids"), Not(HasSubstr("contacts.distances"))));
      EXPECT_EQ(found[0].poses.size(), 24u);
    }
  }
}

TEST(ExchangedPlaces, AreNamedWithAllThatASymmetryMakesAlike) {
  const DataSet right = holes_data(9804, {{"a", {0.0, 0.0}}, {"b", {0.1, 0.0}}, {"c", {0.1, 0.1}}, {"d", {0.0, 0.1}}});
  const std::vector<Finding> found = check_data(with_names_exchanged(right, "a", "b")).findings;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].sentence,
              AllOf(HasSubstr("'a' and 'b', or of 'c' and 'd' are exchanged"), HasSubstr("cannot tell apart")));
  EXPECT_THAT(found[0].poses, IsEmpty()) << "nobody knows which";
}

TEST(ExchangedPlaces, AreNoneWhereALengthIsWrongByItself) {
  DataSet data = holes_data(9805, kPlate);
  data.contacts.distances[3].length_m += 0.05;
  const std::vector<Finding> found = check_data(data).findings;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, FindingKind::wrong_length);
  EXPECT_THAT(found[0].sentence, HasSubstr("the names under contacts.grids"));
}

}  // namespace
}  // namespace demecal

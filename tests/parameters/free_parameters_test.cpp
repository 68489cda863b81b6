// Which numbers a declaration frees, and what they are called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "fitting/known_arm.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> names(const DataSet& data, const DeclaredModel& declared) {
  std::vector<std::string> result;
  for (const ParameterId& id : free_parameters(data, declared)) result.push_back(id.name());
  return result;
}

DataSet data_of(std::vector<Joint> joints, Convention convention = Convention::standard_dh) {
  DataSet data;
  data.robot.chain = {convention, std::move(joints), Eigen::Vector3d::Zero()};
  data.poses.resize(1);
  return data;
}

constexpr auto kRevolute = JointType::revolute;
constexpr auto kPrismatic = JointType::prismatic;

TEST(FreeParameters, AreNoneWhereNothingIsDeclared) {
  EXPECT_THAT(names(data_of({link(kRevolute, 0, 1, 0)}), {}), IsEmpty());
}

TEST(FreeParameters, OfTheBaseAreSix) {
  EXPECT_THAT(names(data_of({}), {.registration = true}),
              ElementsAre("base_x_mm", "base_y_mm", "base_z_mm", "base_rx_deg", "base_ry_deg", "base_rz_deg"));
}

TEST(FreeParameters, OfAToolAreThreeAndSixWhereItsOrientationWasMeasured) {
  DataSet data = data_of({});
  EXPECT_THAT(names(data, {.tool = true}), ElementsAre("tool_x_mm", "tool_y_mm", "tool_z_mm"));
  data.poses.resize(2);
  data.poses[0].target = "B";
  data.poses[1].target = "A";
  data.poses[1].orientation = Eigen::Quaterniond::Identity();
  EXPECT_THAT(names(data, {.tool = true}),
              ElementsAre("tool_x_mm of A", "tool_y_mm of A", "tool_z_mm of A", "tool_rx_deg of A", "tool_ry_deg of A",
                          "tool_rz_deg of A", "tool_x_mm of B", "tool_y_mm of B", "tool_z_mm of B"));
}

TEST(FreeParameters, OfJointOffsetsAreThetaOrD) {
  EXPECT_THAT(names(data_of({link(kRevolute, kRight, 0, 0), link(kPrismatic, 0, 0, 0)}), {.joint_offset = true}),
              ElementsAre("joint 1 theta_deg", "joint 2 d_mm"));
}

TEST(FreeParameters, OfGeometryHaveBetaInPlaceOfDBetweenParallelAxes) {
  const std::vector<Joint> joints{link(kRevolute, 0, 0.5, 0), link(kRevolute, kRight, 0.5, 0)};
  EXPECT_THAT(names(data_of(joints), {.geometry = true}),
              ElementsAre("joint 1 a_mm", "joint 1 alpha_deg", "joint 1 beta_deg", "joint 2 d_mm", "joint 2 a_mm",
                          "joint 2 alpha_deg"));
}

TEST(FreeParameters, OfModifiedGeometryHaveBetaOnTheLinkBeforeTheSecondParallelAxis) {
  const std::vector<Joint> joints{link(kRevolute, kRight, 0, 0), link(kRevolute, 0, 0.5, 0)};
  EXPECT_THAT(names(data_of(joints, Convention::modified_dh), {.geometry = true}),
              ElementsAre("joint 1 d_mm", "joint 1 a_mm", "joint 1 alpha_deg", "joint 2 a_mm", "joint 2 alpha_deg",
                          "joint 2 beta_deg"));
}

TEST(FreeParameters, OfAPrismaticJointsGeometryAreTwoAngles) {
  EXPECT_THAT(
      names(data_of({link(kPrismatic, kRight, 0, 0), link(kRevolute, kRight, 0, 0)}), {.geometry = true}),
      ElementsAre("joint 1 theta_deg", "joint 1 alpha_deg", "joint 2 d_mm", "joint 2 a_mm", "joint 2 alpha_deg"));
  EXPECT_THAT(
      names(data_of({link(kPrismatic, 0, 0, 0), link(kRevolute, kRight, 0, 0)}), {.geometry = true}),
      ElementsAre("joint 1 beta_deg", "joint 1 alpha_deg", "joint 2 d_mm", "joint 2 a_mm", "joint 2 alpha_deg"));
}

TEST(FreeParameters, KeepDBesideAParallelPrismaticJointWhoseOffsetIsNotFree) {
  const std::vector<Joint> joints{link(kRevolute, 0, 0.5, 0), link(kPrismatic, kRight, 0, 0)};
  EXPECT_THAT(names(data_of(joints), {.geometry = true}), ::testing::Contains("joint 1 d_mm"));
  EXPECT_THAT(names(data_of(joints), {.joint_offset = true, .geometry = true}),
              ::testing::Not(::testing::Contains("joint 1 d_mm")));
}

TEST(FreeParameters, AreEachNamedOnce) {
  for (const Chain& chain : {parallel_arm(), modified_arm(), seven_joint_arm(), stanford_arm()}) {
    DataSet data = data_of(chain.joints, chain.convention);
    const auto all = names(data, {.registration = true, .tool = true, .joint_offset = true, .geometry = true});
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  }
}

}  // namespace
}  // namespace demecal

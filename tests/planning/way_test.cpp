// The way between planned poses: free wherever the arm is on it, and without what it does not reach.
#include "planning/way.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/candidates.hpp"
#include "planning/planned_arm.hpp"
#include "planning/travel.hpp"

namespace demecal {
namespace {

/// What stands in it by more than this is seen, however it is met between two looks.
constexpr double kGrazed_m = 2e-3;

/// The cell of another arm, so much thinner, in a box that much wider.
FeasibleSpace grazing(const FeasibleSpace& space) {
  WorkCell cell = space.cell();
  for (double& radius : cell.radii_m) radius -= kGrazed_m;
  if (cell.tool_box) {
    const Eigen::Vector3d wider = Eigen::Vector3d::Constant(kGrazed_m);
    cell.tool_box = Eigen::AlignedBox3d(cell.tool_box->min() - wider, cell.tool_box->max() + wider);
  }
  for (HalfSpace& half : cell.half_spaces) half.height_m -= kGrazed_m;
  return {space.robot(), cell};
}

/// In steps of some tenths of a millimetre.
template <typename Visit>
void visit(const MeasuringWay& way, const Visit& see) {
  constexpr int kSteps = 1500;
  for (std::size_t i = 1; i < way.stops.size(); ++i) {
    const JointVector& from = way.stops[i - 1].joints;
    const JointVector& to = way.stops[i].joints;
    for (int k = 0; k <= kSteps; ++k) see(JointVector(from + (to - from) * (static_cast<double>(k) / kSteps)));
  }
}

void expect_free(const FeasibleSpace& space, const MeasuringWay& way) {
  const FeasibleSpace allowed = grazing(space);
  int met = 0;
  visit(way, [&](const JointVector& joints) { met += allowed.in_passing(joints) != Obstruction::none ? 1 : 0; });
  EXPECT_EQ(met, 0);
}

std::vector<std::size_t> measured_on(const MeasuringWay& way) {
  std::vector<std::size_t> poses;
  for (const WayStop& stop : way.stops)
    if (stop.pose >= 0) poses.push_back(static_cast<std::size_t>(stop.pose));
  return poses;
}

MeasuringWay way_in(const FeasibleSpace& space, std::size_t count, std::uint64_t seed) {
  const std::vector<PlannedPose> poses = draw_poses(space, count, RandomStream{9401, seed}).poses;
  MeasuringWay way = way_along(space, poses, RandomStream{9402, seed});
  EXPECT_EQ(measured_on(way).size() + way.blocked.size(), poses.size());
  EXPECT_THAT(measured_on(way), testing::Not(testing::Contains(testing::AnyOfArray(way.blocked))));
  return way;
}

TEST(MeasuringWay, KeepsToTheBoxTheFloorAndTheJointRanges) {
  WorkCell cell = assumed_cell(planned_arm());
  cell.tool_box = Eigen::AlignedBox3d(Eigen::Vector3d(0.1, -0.6, 0.2), Eigen::Vector3d(0.9, 0.6, 1.0));
  cell.ranges.resize(6);
  cell.ranges[0] = Interval{-1.2, 1.2};
  cell.ranges[2] = Interval{-1.2, 2.5};  // the forearm on one side of the upper arm
  cell.ranges[5] = Interval{-0.3, 0.4};
  const FeasibleSpace space(planned_arm(), cell);
  const MeasuringWay way = way_in(space, 12, 1);
  EXPECT_LE(way.blocked.size(), 3u);
  expect_free(space, way);
  int outside = 0, out_of_range = 0;
  visit(way, [&](const JointVector& joints) {
    const Eigen::Vector3d tool_m = tool_position(space.robot().chain, joints);
    outside += cell.tool_box->exteriorDistance(tool_m) > kGrazed_m ? 1 : 0;
    out_of_range += std::abs(joints[0]) > 1.2 || joints[5] < -0.3 || joints[5] > 0.4 ? 1 : 0;
  });
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(out_of_range, 0);
}

TEST(MeasuringWay, GoesRoundPolesAsThinAsAFinger) {
  WorkCell cell = assumed_cell(planned_arm());
  cell.radii_m.back() = 8e-3;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d foot(0.9 * std::cos(0.8 * i), 0.9 * std::sin(0.8 * i), 0.0);
    cell.obstacles.push_back({foot, foot + Eigen::Vector3d(0.0, 0.0, 1.6), 6e-3});
  }
  const FeasibleSpace space(planned_arm(), cell);
  const MeasuringWay way = way_in(space, 12, 2);
  EXPECT_LE(way.blocked.size(), 3u);
  expect_free(space, way);
}

/// Beyond a wall that reaches as far as the arm.
TEST(MeasuringWay, LeavesOutWhatNoFreeWayLeadsTo) {
  WorkCell cell = assumed_cell(planned_arm());
  for (double height_m = 0.0; height_m < 3.0; height_m += 0.15)
    for (const double side : {-1.0, 1.0})
      cell.obstacles.push_back(
          {{0.0, side * (height_m > 0.8 ? 0.0 : 0.3), height_m}, {0.0, side * 3.0, height_m}, 0.08});
  const FeasibleSpace space(planned_arm(), cell);
  const MeasuringWay way = way_in(space, 12, 3);
  EXPECT_FALSE(way.blocked.empty());
  EXPECT_GE(measured_on(way).size(), 6u);
  expect_free(space, way);
}

TEST(MeasuringWay, IsStraightWhereNothingIsInTheWay) {
  const FeasibleSpace space(planned_arm(), assumed_cell(planned_arm()));
  const std::vector<PlannedPose> poses = draw_poses(space, 12, RandomStream{9403}).poses;
  const MeasuringWay way = way_along(space, poses, RandomStream{9404});
  std::size_t straight = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    straight += is_free(space, poses[i - 1].joints, approach_stop(space, poses[i])) ? 1u : 0u;
  EXPECT_TRUE(way.blocked.empty());
  EXPECT_LE(way.stops.size(), 2 * poses.size() + 2 * (poses.size() - 1 - straight));
}

}  // namespace
}  // namespace demecal

// Sockets planned for an arm that no instrument measures: postures touch them, the cell holds them, and what the plan
// predicts is what fits leave over the workspace.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <set>

#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "planning/candidates.hpp"
#include "planning/plan.hpp"
#include "planning/planned_arm.hpp"
#include "planning/sockets.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal {
namespace {

constexpr double kPlay_m = 4e-5;

PlanRequest touching_request(std::optional<double> length_m) {
  PlanRequest request;
  request.robot = planned_arm();
  request.poses = 36;
  request.places = 2;
  request.cell = assumed_cell_of_sockets(request.robot);
  request.cell->noise_m = kPlay_m;
  request.cell->sockets.length_m = length_m;
  return request;
}

void expect_touched_by_poses_of_their_name(const PlanRequest& request, const Plan& plan) {
  EXPECT_EQ(plan.counts[0], 36u);
  ASSERT_EQ(plan.sockets.size(), 3u);
  const FeasibleSpace space(request.robot, *request.cell);
  std::map<std::size_t, std::set<PoseSet>> sets;
  std::map<std::size_t, int> poses;
  for (const PlannedStop& stop : plan.stops) {
    ASSERT_TRUE(stop.pose.socket);
    const Eigen::Vector3d tool_m = tool_position(request.robot.chain, stop.pose.joints);
    EXPECT_LT((tool_m - plan.sockets[*stop.pose.socket].place_m).norm(), 2e-4) << stop.id;
    EXPECT_TRUE(is_feasible(space, stop.pose)) << stop.id;
    sets[*stop.pose.socket].insert(stop.set);
    ++poses[*stop.pose.socket];
  }
  EXPECT_THAT(sets[0], testing::ElementsAre(PoseSet::calibration, PoseSet::validation));
  EXPECT_THAT(sets[1], testing::ElementsAre(PoseSet::calibration, PoseSet::validation));
  EXPECT_THAT(sets[2], testing::ElementsAre(PoseSet::accept));
  for (const auto& [socket, count] : poses) EXPECT_GE(count, 6) << socket;
  EXPECT_TRUE(plan.way.stops.empty());
}

TEST(PlannedSockets, WarnOfNoProgramsWhichNobodyWrites) {
  PlanRequest request = touching_request({});
  request.poses = 20;
  request.cell.reset();
  const auto warnings = make_plan(request).warnings;
  EXPECT_THAT(warnings, testing::Contains(testing::HasSubstr("Nothing is known of")));
  EXPECT_THAT(warnings, testing::Not(testing::Contains(testing::HasSubstr("programs"))));
}

TEST(PlannedSockets, StandInTheirBoxAsFarApartAsTheBlockHasThem) {
  PlanRequest request = touching_request(0.08);
  request.cell->sockets.box = Eigen::AlignedBox3d(Eigen::Vector3d(-0.9, -0.9, 0.15), Eigen::Vector3d(0.9, 0.9, 0.4));
  const Plan plan = make_plan(request);
  ASSERT_EQ(plan.sockets.size(), 6u);
  ASSERT_EQ(plan.lengths.size(), 3u);
  for (const PlannedSocket& socket : plan.sockets) EXPECT_TRUE(request.cell->sockets.box->contains(socket.place_m));
  for (std::size_t i = 0; i < 6; i += 2) {
    const Eigen::Vector3d apart = plan.sockets[i + 1].place_m - plan.sockets[i].place_m;
    EXPECT_NEAR(apart.norm(), 0.08, 1e-12);
    EXPECT_NEAR(apart.z(), 0.0, 1e-12);
  }
}

void expect_function_of_request(const Plan& plan, const Plan& again) {
  ASSERT_EQ(plan.stops.size(), again.stops.size());
  for (std::size_t i = 0; i < plan.stops.size(); ++i) EXPECT_EQ(plan.stops[i].pose.joints, again.stops[i].pose.joints);
}

/// Plans for single sockets and for blocks of two, each made once for all that is claimed of it.
TEST(PlannedSockets, AreTouchedByTheirPosesAFunctionOfTheRequestAndOfABlockTellTheScale) {
  const PlanRequest single = touching_request({}), block = touching_request(0.05);
  const Plan without = make_plan(single), with = make_plan(block);
  expect_touched_by_poses_of_their_name(single, without);
  expect_function_of_request(with, make_plan(block));
  EXPECT_LT(with.predicted.rms_m, with.random_rms_m) << "random postures";
  EXPECT_LT(with.predicted.rms_m, 0.5 * without.predicted.rms_m);
  EXPECT_THAT(without.warnings, testing::Contains(testing::HasSubstr("scale")));
  EXPECT_THAT(with.warnings, testing::Not(testing::Contains(testing::HasSubstr("scale"))));
}

TEST(PlannedSockets, NeedRoom) {
  PlanRequest request = touching_request({});
  request.cell->sockets.box = Eigen::AlignedBox3d(Eigen::Vector3d(5.0, 5.0, 5.0), Eigen::Vector3d(6.0, 6.0, 6.0));
  EXPECT_THROW(make_plan(request), InputError);
}

/// How far the tools of two arms are apart over these places, once one of them is shifted and turned as a whole: rms.
double apart_m(const CorrectedRobot& one, const CorrectedRobot& other, const std::vector<PlannedPose>& places) {
  Eigen::Matrix3Xd first(3, std::ssize(places)), second = first;
  for (std::size_t i = 0; i < places.size(); ++i) {
    first.col(static_cast<Eigen::Index>(i)) = one.predict(places[i].joints, "").translation();
    second.col(static_cast<Eigen::Index>(i)) = other.predict(places[i].joints, "").translation();
  }
  const Eigen::Isometry3d moved(Eigen::umeyama(first, second, false));
  return std::sqrt((moved * first - second).squaredNorm() / static_cast<double>(places.size()));
}

TEST(PlannedSockets, PredictTheErrorThatFitsLeave) {
  const PlanRequest request = touching_request(0.08);
  const Plan plan = make_plan(request);
  const FeasibleSpace space(request.robot, *request.cell);
  const std::vector<PlannedPose> places = draw_poses(space, 100, RandomStream{77, 1}).poses;
  double squares = 0.0;
  constexpr int kArms = 12;
  const FitOptions believed;
  for (std::uint64_t seed = 1; seed <= kArms; ++seed) {
    RandomStream random{4711, seed};
    DataSet data;
    data.robot = request.robot;
    data.contacts.distances = plan.lengths;
    for (KnownDistance& known : data.contacts.distances) known.length_m += known.sigma_m * random.normal();
    CorrectedRobot truth = nominal_robot(data);
    for (Joint& joint : truth.chain.joints) {  // what sockets hardly tell is as far off as a fit believes beforehand
      joint.theta_rad += believed.prior_rad * random.normal();
      joint.alpha_rad += believed.prior_rad * random.normal();
      joint.a_m += believed.prior_m * random.normal();
      joint.d_m += believed.prior_m * random.normal();
    }
    for (const PlannedStop& stop : plan.stops) {
      if (stop.set != PoseSet::calibration) continue;
      const PlannedSocket& socket = plan.sockets[*stop.pose.socket];
      const Eigen::Vector3d play(random.normal(), random.normal(), random.normal());
      const auto joints = joints_touching(truth.chain, stop.pose.joints, socket.place_m + kPlay_m * play);
      ASSERT_TRUE(joints);
      MeasuredPose pose;
      pose.joints = *joints;
      pose.contact = socket.name;
      data.poses.push_back(pose);
    }
    const Fit fit = fit_declared(data, poses_of(data, PoseSet::calibration), request.declared, nominal_robot(data));
    squares += std::pow(apart_m(fit.robot, truth, places), 2.0) / kArms;
  }
  EXPECT_NEAR(std::sqrt(squares) / plan.predicted.rms_m, 1.0, 0.25);
}

}  // namespace
}  // namespace demecal

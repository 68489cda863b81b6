// A plan keeps to what is feasible, is a function of its request, and its predictions come true.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "planning/plan.hpp"
#include "planning/planned_arm.hpp"
#include "planning/travel.hpp"

namespace demecal {
namespace {

PlanRequest request_of(int poses, std::uint64_t seed = 1) {
  PlanRequest request;
  request.robot = planned_arm();
  request.poses = poses;
  request.validation = 4;
  request.accept = 6;
  request.seed = seed;
  return request;
}

TEST(Plan, HasThePosesAskedForAndAllAreFeasible) {
  const PlanRequest request = request_of(18);
  const Plan plan = make_plan(request);
  EXPECT_THAT(plan.counts, testing::ElementsAre(18u, 4u, 6u));
  const FeasibleSpace space(request.robot, assumed_cell(request.robot));
  for (const PlannedStop& stop : plan.stops) {
    EXPECT_EQ(space.obstruction(stop.pose.joints), Obstruction::none) << stop.id;
    EXPECT_TRUE(is_free(space, approach_stop(space, stop.pose), stop.pose.joints)) << stop.id;
    for (const double sign : stop.pose.approach) EXPECT_EQ(std::abs(sign), 1.0);
  }
  int measured = 0;
  for (const WayStop& stop : plan.way.stops) measured += stop.pose >= 0 ? 1 : 0;
  EXPECT_EQ(measured + static_cast<int>(plan.way.blocked.size()), 28);
}

TEST(Plan, KeepsTheToolInItsBoxAndOnTheRightSideOfEveryHalfSpace) {
  PlanRequest request = request_of(12);
  request.cell = assumed_cell(request.robot);
  request.cell->tool_box = Eigen::AlignedBox3d(Eigen::Vector3d(-0.2, -0.9, 0.1), Eigen::Vector3d(0.9, 0.9, 1.2));
  request.cell->half_spaces.push_back({Eigen::Vector3d::UnitX(), 0.1, false});
  for (const PlannedStop& stop : make_plan(request).stops) {
    const Eigen::Vector3d tool_m = tool_position(request.robot.chain, stop.pose.joints);
    EXPECT_TRUE(request.cell->tool_box->contains(tool_m));
    EXPECT_GE(tool_m.x(), 0.1);
  }
}

TEST(Plan, SaysWhichRadiiItAssumesWhereACellStatesNone) {
  const auto of_radii =
      testing::AllOf(testing::HasSubstr("states no link_radius_mm"), testing::HasSubstr("mm, the tool"));
  PlanRequest request = request_of(8);
  request.cell = assumed_cell(request.robot);
  EXPECT_THAT(make_plan(request).assumptions, testing::Not(testing::Contains(of_radii)));
  request.cell->radii_m.clear();
  const Plan plan = make_plan(request);
  EXPECT_THAT(plan.assumptions, testing::Contains(of_radii));
  EXPECT_THAT(plan.warnings, testing::Not(testing::Contains(testing::HasSubstr("not checked"))));
}

TEST(Plan, KeepsTheTargetInTheInstrumentsSight) {
  PlanRequest request = request_of(12);
  request.cell = assumed_cell(request.robot);
  Instrument instrument;
  instrument.position_m = {3.0, 0.5, 1.0};
  instrument.farthest_m = 3.2;
  instrument.target_direction = Eigen::Vector3d::UnitX();
  instrument.half_angle_rad = 0.7;
  request.cell->instrument = instrument;
  for (const PlannedStop& stop : make_plan(request).stops) {
    const Eigen::Isometry3d flange = forward(request.robot.chain, stop.pose.joints);
    const Eigen::Vector3d view = instrument.position_m - flange * request.robot.chain.tool_m;
    EXPECT_LE(view.norm(), 3.2);
    EXPECT_GE(view.normalized().dot(flange.linear().col(0)), std::cos(0.7) - 1e-9);
  }
}

TEST(Plan, IsAFunctionOfItsRequest) {
  const Plan one = make_plan(request_of(14)), again = make_plan(request_of(14)), other = make_plan(request_of(14, 2));
  ASSERT_EQ(one.stops.size(), again.stops.size());
  bool differs = false;
  for (std::size_t i = 0; i < one.stops.size(); ++i) {
    EXPECT_EQ(one.stops[i].pose.joints, again.stops[i].pose.joints);
    differs = differs || one.stops[i].pose.joints != other.stops[i].pose.joints;
  }
  EXPECT_TRUE(differs);
}

TEST(Plan, BeatsAsManyRandomPosesAndReachesTheAccuracyAskedFor) {
  const Plan plan = make_plan(request_of(20));
  EXPECT_LT(plan.predicted.rms_m, 0.85 * plan.random_rms_m);
  PlanRequest request = request_of(20);
  request.poses.reset();
  request.accuracy_m = 0.8 * plan.predicted.rms_m;
  const Plan more = make_plan(request);
  EXPECT_LE(more.predicted.rms_m, *request.accuracy_m);
  EXPECT_GT(more.counts[0], 20u);
  request.accuracy_m = plan.predicted.rms_m;
  EXPECT_LE(make_plan(request).counts[0], 21U) << "20 poses do";
  for (std::size_t i = 1; i < plan.curve.size(); ++i)
    EXPECT_LT(plan.curve[i].planned.rms_m, plan.curve[i - 1].planned.rms_m) << plan.curve[i].poses;
  request.accuracy_m = 1e-7;
  EXPECT_THROW(make_plan(request), InputError);
}

/// Against a bound that no poses get below: what is left to gain is little.
TEST(Plan, IsNearTheBestThatAsManyPosesCanBe) {
  for (const std::uint64_t seed : {1, 2}) {
    const Plan few = make_plan(request_of(15, seed)), many = make_plan(request_of(40, seed));
    EXPECT_LE(few.bound_rms_m, few.predicted.rms_m);
    EXPECT_LT(few.predicted.rms_m, 1.07 * few.bound_rms_m);
    EXPECT_LE(many.bound_rms_m, many.predicted.rms_m);
    EXPECT_LT(many.predicted.rms_m, 1.03 * many.bound_rms_m);
  }
}

TEST(Plan, SaysWhatItsPosesCannotTell) {
  PlanRequest request = request_of(16);
  request.robot.chain.tool_m = {0.0, 0.0, 0.1};  // on the axis of the last joint
  const Plan plan = make_plan(request);
  EXPECT_THAT(plan.warnings, testing::Contains(testing::HasSubstr("off the axis of joint 6")));
  const auto last = std::ranges::find_if(plan.numbers, [](const PredictedNumber& number) {
    return number.id.kind == ParameterId::Kind::link && number.id.index == 5 && number.id.link == LinkParameter::theta;
  });
  ASSERT_NE(last, plan.numbers.end());
  EXPECT_FALSE(last->identifiable);
}

/// Measured as planned, with repeats of its first pose.
DataSet measured_as(const Plan& plan, const Robot& robot) {
  DataSet data;
  data.robot = robot;
  data.name = "before";
  for (const PlannedStop& stop : plan.stops) {
    MeasuredPose pose;
    pose.joints = stop.pose.joints;
    pose.position_m = tool_position(robot.chain, stop.pose.joints);
    pose.set = stop.set;
    pose.pose_id = stop.id;
    data.poses.push_back(pose);
  }
  data.poses.push_back(data.poses.front());
  return data;
}

TEST(Plan, GoesOnFromWhatWasMeasured) {
  PlanRequest request = request_of(14);
  request.validation = 7;
  request.accept = 12;
  const Plan before = make_plan(request);
  request.measured = measured_as(before, request.robot);
  request.validation.reset();
  request.accept.reset();
  request.poses = 26;
  const Plan after = make_plan(request);
  // 3 for every 10 of 40 that calibrate.
  EXPECT_THAT(after.counts, testing::ElementsAre(26u, 5u, 0u));
  for (std::size_t i = 0; i < after.stops.size(); ++i)
    EXPECT_EQ(after.stops[i].id, "P" + std::to_string(before.stops.size() + 1 + i));
  EXPECT_THAT(after.assumptions, testing::Contains(testing::HasSubstr("goes on from before")));
  request.accept = 3;
  EXPECT_EQ(make_plan(request).counts[2], 3u);
}

/// Whatever no program drives to is counted and named: postures that no way within the box joins.
TEST(Plan, NamesThePosesThatProgramsLeaveOut) {
  PlanRequest request = request_of(10);
  request.cell = assumed_cell(request.robot);
  request.cell->tool_box = Eigen::AlignedBox3d(Eigen::Vector3d(0.3, -0.1, 0.4), Eigen::Vector3d(0.5, 0.1, 0.6));
  const Plan plan = make_plan(request);
  ASSERT_FALSE(plan.way.blocked.empty());
  std::size_t reached = 0;
  for (const WayStop& stop : plan.way.stops) reached += stop.pose >= 0 ? 1 : 0;
  EXPECT_EQ(reached + plan.way.blocked.size(), plan.stops.size());
  EXPECT_THAT(plan.warnings,
              testing::Contains(testing::AllOf(testing::HasSubstr(std::to_string(plan.way.blocked.size()) + " of " +
                                                                  std::to_string(plan.stops.size()) + " poses"),
                                               testing::HasSubstr(plan.stops[plan.way.blocked.front()].id))));
}

/// Others are drawn in their place as long as there are: which ones does not matter.
TEST(Plan, ReplacesPosesThatJudgeWhereNoWayLeadsToThem) {
  for (const double half_m : {0.1, 0.2}) {
    PlanRequest request = request_of(14);
    request.validation = request.accept = 8;
    request.cell = assumed_cell(request.robot);
    const Eigen::Vector3d centre_m(0.4, 0.0, 0.5);
    request.cell->tool_box = Eigen::AlignedBox3d(centre_m.array() - half_m, centre_m.array() + half_m);
    const Plan plan = make_plan(request);
    EXPECT_THAT(plan.counts, testing::ElementsAre(14u, 8u, 8u));
    for (const std::size_t blocked : plan.way.blocked) EXPECT_EQ(plan.stops[blocked].set, PoseSet::calibration);
  }
}

TEST(Plan, SaysFirstThatPosesAreTooFewAndHowManyItTakes) {
  EXPECT_THAT(make_plan(request_of(3)).warnings.front(),
              testing::AllOf(testing::HasSubstr("3 poses are too few"), testing::HasSubstr("it takes ")));
  EXPECT_THAT(make_plan(request_of(20)).warnings, testing::Not(testing::Contains(testing::HasSubstr("too few"))));
}

TEST(Plan, RefusesACellWithoutRoom) {
  PlanRequest request = request_of(12);
  request.cell = assumed_cell(request.robot);
  request.cell->tool_box = Eigen::AlignedBox3d(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
  EXPECT_THROW(make_plan(request), InputError);
  request.stated[Obstruction::tool_box] = {{"cell.yaml", 7}, "tool_box_mm"};
  try {
    make_plan(request);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("cell.yaml:7"), testing::HasSubstr("outside the tool's box"),
                               testing::HasSubstr("Widen tool_box_mm")));
  }
}

/// What is written in radians is within 2 pi.
TEST(Plan, AsksWhetherLimitsAreInRadians) {
  const auto asked = testing::Contains(testing::AllOf(testing::HasSubstr("limits"), testing::HasSubstr("radians")));
  PlanRequest request = request_of(8);
  EXPECT_THAT(make_plan(request).warnings, testing::Not(asked));
  for (Joint& joint : request.robot.chain.joints) {
    joint.lower *= 0.0174;
    joint.upper *= 0.0174;
  }
  EXPECT_THAT(make_plan(request).warnings, asked);
}

/// The prediction is of the error that a fit to simulated measurements leaves, over many simulated arms.
TEST(Plan, PredictsTheErrorThatFitsLeave) {
  PlanRequest request = request_of(24, 5);
  request.accept = 60;
  request.cell = assumed_cell(request.robot);
  request.cell->noise_m = 4e-5;
  const Plan plan = make_plan(request);
  double squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random{9100, seed};
    DataSet data;
    data.robot = request.robot;
    CorrectedRobot truth = nominal_robot(data);
    for (Joint& joint : truth.chain.joints) {
      joint.theta_rad += 1e-3 * random.normal();
      joint.alpha_rad += 1e-3 * random.normal();
      joint.a_m += 1e-3 * random.normal();
    }
    for (const PlannedStop& stop : plan.stops) {
      MeasuredPose pose;
      pose.joints = stop.pose.joints;
      pose.set = stop.set;
      pose.position_m = truth.predict(stop.pose.joints, "").translation() +
                        4e-5 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      data.poses.push_back(pose);
    }
    const Fit fit = fit_declared(data, poses_of(data, PoseSet::calibration), request.declared, nominal_robot(data));
    for (const std::size_t i : poses_of(data, PoseSet::accept)) {
      const JointVector& joints = data.poses[i].joints;
      squares += (fit.robot.predict(joints, "").translation() - truth.predict(joints, "").translation()).squaredNorm();
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count) / plan.predicted.rms_m, 1.0, 0.25);
}

}  // namespace
}  // namespace demecal

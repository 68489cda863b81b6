// Simulated data sets: where the robot is sent, how it comes there, what is recorded and what stays hidden.
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "kinematics/inverse.hpp"
#include "planar_arm.hpp"

namespace demecal {
namespace {

JointVector puma_home() {
  return joints({radians(35), radians(-35), radians(150), radians(0), radians(-60), radians(0)});
}

/// The thesis's calibration cuboid (section 6.1).
Scenario puma_scenario() {
  Scenario scenario;
  scenario.name = "puma";
  scenario.robot = puma_761();
  scenario.seed = 761;
  scenario.box_corner_m = {0.432, 0.490, -0.675};
  scenario.box_size_m = {0.844, 0.582, 1.151};
  scenario.home = puma_home();
  scenario.orientation_spread_rad = radians(25);
  scenario.poses = {30, 30, 10};
  scenario.noise_m = 1e-4;
  return scenario;
}

Scenario planar_by_joints(std::array<int, 3> poses) {
  Scenario scenario;
  scenario.robot = planar_arm();
  scenario.by_joints = true;
  scenario.home = joints({0.0, 0.0});
  scenario.poses = poses;
  return scenario;
}

void add_errors(Scenario& scenario) {
  scenario.geometry = {{1, LinkParameter::a, 0.003}};
  scenario.backlash = {{1, 0.002}};
  scenario.tool_error_m = {0.001, 0.001, 0.001};
}

double sign_by_hand(double move) {
  if (std::abs(move) <= 2e-3) return 0.0;
  return move > 0 ? 1.0 : -1.0;
}

TEST(Simulate, PutsEveryNominalToolPointIntoTheCuboid) {
  const Scenario scenario = puma_scenario();
  const DataSet data = simulate(scenario);
  ASSERT_EQ(data.poses.size(), 70u);
  const Eigen::Array3d lower = scenario.box_corner_m, upper = scenario.box_corner_m + scenario.box_size_m;
  for (const MeasuredPose& pose : data.poses) {
    const Eigen::Array3d point = tool_position(scenario.robot.chain, pose.joints);
    EXPECT_TRUE((point >= lower - 1e-8).all() && (point <= upper + 1e-8).all()) << pose.pose_id;
  }
}

TEST(Simulate, KeepsTheOrientationWithinTheSpreadAroundHome) {
  const Scenario scenario = puma_scenario();
  const Eigen::Matrix3d home = forward(scenario.robot.chain, scenario.home).linear();
  for (const MeasuredPose& pose : simulate(scenario).poses) {
    const Eigen::Matrix3d tilted = home.transpose() * forward(scenario.robot.chain, pose.joints).linear();
    const Eigen::Vector3d tilt = rotation_between(Eigen::Matrix3d::Identity(), tilted);
    EXPECT_LE(tilt.cwiseAbs().maxCoeff(), scenario.orientation_spread_rad + 1e-8) << pose.pose_id;
  }
}

TEST(Simulate, MovesEveryJointAndKeepsItsLimits) {
  const Scenario scenario = puma_scenario();
  const DataSet data = simulate(scenario);
  for (int joint = 0; joint < 6; ++joint) {
    const Joint& link = scenario.robot.chain.joints[static_cast<std::size_t>(joint)];
    double lowest = link.upper, highest = link.lower;
    for (const MeasuredPose& pose : data.poses) {
      EXPECT_GE(pose.joints[joint], link.lower);
      EXPECT_LE(pose.joints[joint], link.upper);
      lowest = std::min(lowest, pose.joints[joint]);
      highest = std::max(highest, pose.joints[joint]);
    }
    EXPECT_GT(highest - lowest, radians(20)) << "joint " << joint + 1;
  }
}

TEST(Simulate, StaysAwayFromTheWristSingularity) {
  for (const MeasuredPose& pose : simulate(puma_scenario()).poses) {
    EXPECT_GT(std::abs(std::sin(pose.joints[4])), radians(5)) << pose.pose_id;
  }
}

TEST(Simulate, SaysThatACuboidIsOutOfReach) {
  Scenario scenario = puma_scenario();
  scenario.box_corner_m = {5.0, 5.0, 5.0};
  try {
    simulate(scenario);
    FAIL() << "reached a cuboid 8 m away";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("could be reached"), std::string::npos) << error.what();
    EXPECT_EQ(error.value(), "corner 5000 5000 5000, size 844 582 1151 mm");
  }
}

TEST(Simulate, FillsTheCuboidOfAnArmThatCannotHoldAnOrientation) {
  Scenario scenario = planar_by_joints({20, 0, 0});
  scenario.by_joints = false;
  scenario.box_corner_m = {0.3, 0.2, 0.0};
  scenario.box_size_m = {0.2, 0.3, 0.0};
  for (const MeasuredPose& pose : simulate(scenario).poses) {
    const Eigen::Vector3d point = planar_tip(pose.joints[0], pose.joints[1]);
    EXPECT_TRUE(point.x() >= 0.3 && point.x() <= 0.5 && point.y() >= 0.2 && point.y() <= 0.5) << point.transpose();
  }
  scenario.box_corner_m.x() = 2.0;
  EXPECT_THROW(simulate(scenario), InputError);
}

TEST(Simulate, DrawsJointsWithinTheirRanges) {
  Scenario scenario = planar_by_joints({200, 0, 0});
  scenario.joint_ranges = {{-0.1, 0.3}, {0.5, 0.6}};
  for (const MeasuredPose& pose : simulate(scenario).poses) {
    EXPECT_TRUE(pose.joints[0] >= -0.1 && pose.joints[0] < 0.3 && pose.joints[1] >= 0.5 && pose.joints[1] < 0.6);
  }
}

TEST(Simulate, EqualSeedsGiveEqualDataAndOthersDoNot) {
  Scenario scenario = puma_scenario();
  const DataSet one = simulate(scenario), two = simulate(scenario);
  scenario.seed = 762;
  const DataSet other = simulate(scenario);
  for (std::size_t i = 0; i < one.poses.size(); ++i) {
    EXPECT_EQ(one.poses[i].joints, two.poses[i].joints);
    EXPECT_EQ(*one.poses[i].position_m, *two.poses[i].position_m);
    EXPECT_NE(*one.poses[i].position_m, *other.poses[i].position_m);
  }
}

TEST(Simulate, MorePosesLeaveTheEarlierOnesAsTheyWere) {
  const DataSet few = simulate(planar_by_joints({10, 0, 0})), many = simulate(planar_by_joints({10, 5, 0}));
  for (std::size_t i = 0; i < few.poses.size(); ++i) EXPECT_EQ(few.poses[i].joints, many.poses[i].joints);
}

TEST(Simulate, NothingOfTheTruthIsInTheDataBesideTheMeasurements) {
  const Scenario sound = puma_scenario();
  Scenario faulty = sound;
  add_errors(faulty);
  const DataSet one = simulate(sound), two = simulate(faulty);
  EXPECT_EQ(two.robot.chain.tool_m, sound.robot.chain.tool_m);
  for (std::size_t joint = 0; joint < 6; ++joint) {
    for (int p = 0; p < kLinkParameters; ++p) {
      const auto which = static_cast<LinkParameter>(p);
      EXPECT_EQ(two.robot.chain.joints[joint].parameter(which), sound.robot.chain.joints[joint].parameter(which));
    }
  }
  for (std::size_t i = 0; i < one.poses.size(); ++i) {
    EXPECT_EQ(one.poses[i].joints, two.poses[i].joints);
    EXPECT_EQ(*one.poses[i].approach, *two.poses[i].approach);
    EXPECT_GT((*one.poses[i].position_m - *two.poses[i].position_m).norm(), 1e-4);
  }
}

TEST(Simulate, ApproachSignsAreThoseOfTheMovesInOrderFromHome) {
  const Scenario scenario = planar_by_joints({300, 0, 0});
  JointVector from = scenario.home;
  for (const MeasuredPose& pose : simulate(scenario).poses) {
    for (int joint = 0; joint < 2; ++joint) {
      ASSERT_EQ((*pose.approach)[joint], sign_by_hand(pose.joints[joint] - from[joint])) << pose.pose_id;
    }
    from = pose.joints;
  }
}

TEST(Simulate, AJointThatHardlyMovesHasNoApproach) {
  Scenario scenario = planar_by_joints({10, 0, 0});
  scenario.joint_ranges = {{0.3, 0.3015}, {-2.0, 2.0}};
  scenario.home = {};
  const DataSet data = simulate(scenario);
  for (const MeasuredPose& pose : data.poses) EXPECT_EQ((*pose.approach)[0], 0.0);
  EXPECT_EQ((*data.poses[0].approach)[1], 0.0) << "without a home the first pose is not approached";
}

TEST(Simulate, RepeatsStayWithTheirPoseAndComeFromBothSides) {
  Scenario scenario = planar_by_joints({8, 5, 3});
  scenario.repeats = 12;
  const DataSet data = simulate(scenario);
  ASSERT_EQ(data.poses.size(), 16u * 12u);
  int approached_from_both_sides = 0;
  for (std::size_t pose = 0; pose < 16; ++pose) {
    const MeasuredPose& first = data.poses[pose * 12];
    EXPECT_EQ(first.pose_id, std::to_string(pose + 1).insert(0, 1, 'P'));
    EXPECT_EQ(first.set, pose < 8 ? PoseSet::calibration : pose < 13 ? PoseSet::validation : PoseSet::accept);
    double least = 1, most = -1;
    for (std::size_t repeat = 0; repeat < 12; ++repeat) {
      const MeasuredPose& row = data.poses[pose * 12 + repeat];
      EXPECT_EQ(row.pose_id, first.pose_id);
      EXPECT_EQ(row.set, first.set);
      EXPECT_EQ(row.joints, first.joints);
      least = std::min(least, (*row.approach)[0]);
      most = std::max(most, (*row.approach)[0]);
    }
    approached_from_both_sides += least < 0 && most > 0;
  }
  EXPECT_GE(approached_from_both_sides, 10);
}

TEST(Simulate, RecordsOnlyWhatTheScenarioHas) {
  Scenario scenario = planar_by_joints({40, 0, 0});
  scenario.approach_recorded = false;
  const MeasuredPose bare = simulate(scenario).poses[0];
  EXPECT_FALSE(bare.approach || bare.payload_kg || bare.temperature_celsius || bare.time_s || bare.orientation);

  scenario.payloads_kg = {0.0, 5.0};
  scenario.temperature = TemperatureCourse{18.0, 26.0, 600.0};
  scenario.seconds_per_pose = 30.0;
  scenario.orientation_measured = true;
  int loaded = 0;
  double time_s = 0.0;
  for (const MeasuredPose& pose : simulate(scenario).poses) {
    loaded += *pose.payload_kg == 5.0;
    EXPECT_EQ(*pose.time_s, time_s);
    EXPECT_TRUE(*pose.temperature_celsius >= 18.0 && *pose.temperature_celsius <= 26.0);
    EXPECT_TRUE(pose.orientation.has_value());
    time_s += 30.0;
  }
  EXPECT_TRUE(loaded > 8 && loaded < 32) << loaded;
}

TEST(Simulate, CallsTheFrameBaseOnlyWhereTheInstrumentStandsInIt) {
  Scenario scenario = planar_by_joints({1, 0, 0});
  EXPECT_EQ(simulate(scenario).frame, Frame::base);
  scenario.sensor_from_base.translation().x() = 0.1;
  EXPECT_EQ(simulate(scenario).frame, Frame::sensor);
}

TEST(Simulate, NoiseIsNormalOnEveryAxisAndInOrientation) {
  Scenario scenario = planar_by_joints({4000, 0, 0});
  scenario.noise_m = 2e-4;
  scenario.orientation_measured = true;
  scenario.orientation_noise_rad = 1e-3;
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero(), squares = sum;
  int beyond_two_sigma = 0;
  for (const MeasuredPose& pose : simulate(scenario).poses) {
    Eigen::Matrix<double, 6, 1> noise;
    noise.head<3>() = (*pose.position_m - planar_tip(pose.joints[0], pose.joints[1])) / 2e-4;
    noise.tail<3>() =
        rotation_between(forward(scenario.robot.chain, pose.joints).linear(), pose.orientation->toRotationMatrix()) /
        1e-3;
    sum += noise;
    squares += noise.cwiseAbs2();
    beyond_two_sigma += static_cast<int>((noise.array().abs() > 2.0).count());
  }
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_NEAR(sum[axis] / 4000, 0.0, 0.06) << axis;
    EXPECT_NEAR(std::sqrt(squares[axis] / 4000), 1.0, 0.04) << axis;
  }
  EXPECT_NEAR(beyond_two_sigma / 24000.0, 0.0455, 0.006);
}

}  // namespace
}  // namespace demecal

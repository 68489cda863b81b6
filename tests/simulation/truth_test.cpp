// What each true error does to the tool point of a planar arm, against formulas worked out by hand.
#include <gtest/gtest.h>

#include <numbers>

#include "expression/text.hpp"
#include "planar_arm.hpp"

namespace demecal {
namespace {

constexpr double kQ1 = 0.7, kQ2 = -1.1;

Scenario planar_scenario(const Eigen::Vector3d& down = -Eigen::Vector3d::UnitY()) {
  Scenario scenario;
  scenario.robot = planar_arm(down);
  scenario.by_joints = true;
  return scenario;
}

Visit visit(double s1 = 0.0, double s2 = 0.0) {
  return {.commanded = joints({kQ1, kQ2}), .approach = joints({s1, s2})};
}

Eigen::Vector3d tip(const Scenario& scenario, const Visit& at) {
  return SimulatedRobot(scenario).true_pose(at).translation();
}

void expect_near(const Eigen::Vector3d& actual, const Eigen::Vector3d& expected, double tolerance = 1e-12) {
  EXPECT_LT((actual - expected).norm(), tolerance) << actual.transpose() << " instead of " << expected.transpose();
}

Tree scaled_sine(double amplitude, double phase) {
  const Tree shifted = apply(Primitive::add, variable_tree(0), constant_tree(phase));
  return apply(Primitive::multiply, constant_tree(amplitude), apply(Primitive::sine, shifted));
}

TEST(Truth, AnArmWithoutErrorsGoesWhereItIsSent) {
  expect_near(tip(planar_scenario(), visit(1, -1)), planar_tip(kQ1, kQ2));
}

TEST(Truth, JointErrorAddsItsFormulaToItsJoint) {
  Scenario scenario = planar_scenario();
  scenario.joint_errors = {{1, scaled_sine(0.003, 0.4)}};
  expect_near(tip(scenario, visit()), planar_tip(kQ1, kQ2 + 0.003 * std::sin(kQ2 + 0.4)));
}

TEST(Truth, BacklashStopsTheJointHalfItsWidthShort) {
  Scenario scenario = planar_scenario();
  scenario.backlash = {{1, 0.004}};
  expect_near(tip(scenario, visit(0, +1)), planar_tip(kQ1, kQ2 - 0.002));
  expect_near(tip(scenario, visit(0, -1)), planar_tip(kQ1, kQ2 + 0.002));
  expect_near(tip(scenario, visit(1, 0)), planar_tip(kQ1, kQ2));
}

TEST(Truth, HysteresisGrowsWithTheLoad) {
  Scenario scenario = planar_scenario();
  scenario.hysteresis = {{1, 0.001, 0.05}};
  const double torque = kGravity * kSecondMass * kSecondCentre * std::cos(kQ1 + kQ2);
  expect_near(tip(scenario, visit(0, 1)), planar_tip(kQ1, kQ2 - 0.001 * (1 + 0.05 * torque)));
}

TEST(Truth, GearHarmonicTurnsNTimesAsFast) {
  Scenario scenario = planar_scenario();
  scenario.gear_harmonics = {{0, 36.5, 0.0002, -0.0003}};
  const double error = 0.0002 * std::cos(36.5 * kQ1) - 0.0003 * std::sin(36.5 * kQ1);
  expect_near(tip(scenario, visit()), planar_tip(kQ1 + error, kQ2));
}

TEST(Truth, GainEccentricityAndCouplingAddUp) {
  Scenario scenario = planar_scenario();
  scenario.gains = {{0, 0.002}};
  scenario.eccentricities = {{0, 2, 0.001, 0.0005}};
  scenario.couplings = {{1, 0, 0.003, 0.0004, -0.0007}};
  const double first = 0.002 * kQ1 + 0.001 * std::cos(2 * kQ1) + 0.0005 * std::sin(2 * kQ1);
  const double second = 0.003 * kQ1 + 0.0004 * std::cos(kQ1) - 0.0007 * std::sin(kQ1);
  expect_near(tip(scenario, visit()), planar_tip(kQ1 + first, kQ2 + second));
}

TEST(Truth, ComplianceGivesWayWhereGravityPushes) {
  Scenario scenario = planar_scenario();
  scenario.compliance = {{1, 1e-4}};
  Visit loaded = visit();
  loaded.payload_kg = 2.0;
  const double torque = -kGravity * (kSecondMass * kSecondCentre + 2.0 * kSecondLink) * std::cos(kQ1 + kQ2);
  const Eigen::Vector3d actual = tip(scenario, loaded);
  expect_near(actual, planar_tip(kQ1, kQ2 + 1e-4 * torque));
  EXPECT_LT(actual.y(), planar_tip(kQ1, kQ2).y());
}

TEST(Truth, LinkBendingDropsTheTipOfAnArmThatLiesFlat) {
  Scenario scenario = planar_scenario(-Eigen::Vector3d::UnitZ());
  constexpr double kGive = 1e-6;
  scenario.link_bending = {{0, kGive, kGive}};
  const Eigen::Vector3d centre = planar_tip(kQ1, kQ2, kFirstLink, kSecondCentre);
  const Eigen::Vector3d point = planar_tip(kQ1, kQ2);
  const double drop = kGive * kGravity * kSecondMass * (centre.x() * point.x() + centre.y() * point.y());
  expect_near(tip(scenario, visit()), point - drop * Eigen::Vector3d::UnitZ(), 1e-8);
  EXPECT_GT(drop, 1e-6);
}

TEST(Truth, AxisWobbleTiltsAllThatTheAxisCarries) {
  Scenario scenario = planar_scenario();
  scenario.axis_wobble = {{0, 1, {2e-4, 0.0}, {0.0, 3e-4}}};
  const Eigen::Vector3d tilt(2e-4 * std::cos(kQ1), 3e-4 * std::sin(kQ1), 0.0);
  const Eigen::Vector3d point = planar_tip(kQ1, kQ2);
  expect_near(tip(scenario, visit()), point + tilt.cross(point), 1e-7);
}

TEST(Truth, GeometryErrorChangesItsLinkParameter) {
  Scenario scenario = planar_scenario();
  scenario.geometry = {{1, LinkParameter::a, 0.002}, {0, LinkParameter::theta, 0.001}};
  expect_near(tip(scenario, visit()), planar_tip(kQ1 + 0.001, kQ2, kFirstLink, kSecondLink + 0.002));
}

TEST(Truth, ToolErrorMovesTheToolPointWithTheFlange) {
  Scenario scenario = planar_scenario();
  scenario.tool_error_m = {0.001, 0.0, 0.002};
  const Eigen::Vector3d lifted = planar_tip(kQ1, kQ2, kFirstLink, kSecondLink + 0.001);
  expect_near(tip(scenario, visit()), lifted + Eigen::Vector3d(0, 0, 0.002));
}

TEST(Truth, ABalanceSpringPullsItsPivotsTogether) {
  Scenario scenario = planar_scenario();
  // The moving pivot stands a quarter of a turn before the fixed one, 0.4 and 0.3 m from the axis: 0.5 m apart, 0.24 m
  // from the axis, and 0.4 m longer than where it is shortest.
  scenario.balance_springs = {{0, 0.3, 0.4, kQ1 + std::numbers::pi / 2.0, 1000.0, 5000.0, 1e-6}};
  expect_near(tip(scenario, visit()), planar_tip(kQ1 + 1e-6 * 0.24 * 3000.0, kQ2));
}

TEST(Truth, WarmthShiftsZerosAndGrowsLinks) {
  Scenario scenario = planar_scenario();
  scenario.temperature = TemperatureCourse{20.0, 30.0, 400.0};
  scenario.thermal_offsets = {{0, 1e-5}};
  scenario.thermal_lengths = {{1, 12e-6}};
  Visit hottest = visit();
  hottest.time_s = 100.0;
  expect_near(tip(scenario, hottest), planar_tip(kQ1 + 1e-4, kQ2, kFirstLink, kSecondLink * (1 + 12e-5)));
  Visit at_reference = visit();
  at_reference.time_s = 300.0;
  expect_near(tip(scenario, at_reference), planar_tip(kQ1, kQ2));
}

TEST(Truth, SymbolicErrorKnowsJointsTorqueApproachAndWarmth) {
  Scenario scenario = planar_scenario();
  scenario.temperature = TemperatureCourse{20.0, 30.0, 400.0};
  const VariableNames names = symbolic_variables(2);
  ASSERT_EQ(names, (VariableNames{"q1", "q2", "tau", "s", "T"}));
  Tree sum = apply(Primitive::multiply, constant_tree(1e-3), apply(Primitive::sine, variable_tree(0)));
  sum = apply(Primitive::add, sum, apply(Primitive::multiply, constant_tree(1e-4), variable_tree(2)));
  sum = apply(Primitive::add, sum, apply(Primitive::multiply, constant_tree(1e-3), variable_tree(3)));
  sum = apply(Primitive::add, sum, apply(Primitive::multiply, constant_tree(1e-5), variable_tree(4)));
  scenario.symbolic = {{1, sum}};
  Visit hottest = visit(1, -1);
  hottest.time_s = 100.0;
  const double torque = -kGravity * kSecondMass * kSecondCentre * std::cos(kQ1 + kQ2);
  const double error = 1e-3 * std::sin(kQ1) + 1e-4 * torque - 1e-3 + 1e-4;
  expect_near(tip(scenario, hottest), planar_tip(kQ1, kQ2 + error));
}

TEST(Truth, DriftGrowsWithTime) {
  Scenario scenario = planar_scenario();
  scenario.drift = {.metres_per_s = {1e-6, 0, 0}, .rad_per_s = {0, 0, 1e-6}};
  Visit late = visit();
  late.time_s = 1000.0;
  expect_near(tip(scenario, late), planar_tip(kQ1 + 1e-3, kQ2) + Eigen::Vector3d(1e-3, 0, 0));
}

TEST(Truth, SensorScaleStretchesWhatIsReadAndNotWhereTheToolIs) {
  Scenario scenario = planar_scenario();
  scenario.sensor_scale.share = 1e-3;
  RandomStream random{503};
  expect_near(*SimulatedRobot(scenario).measure(visit(), random).position_m, 1.001 * planar_tip(kQ1, kQ2));
  expect_near(tip(scenario, visit()), planar_tip(kQ1, kQ2));
}

TEST(Truth, IsReportedInTheSensorsFrame) {
  Scenario scenario = planar_scenario();
  scenario.sensor_from_base = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ());
  expect_near(tip(scenario, visit()), planar_tip(kQ1 + 0.5, kQ2) + Eigen::Vector3d(1, 2, 3));
}

TEST(Truth, APrismaticJointGivesWayToTheForceAlongIt) {
  Scenario scenario = planar_scenario(-Eigen::Vector3d::UnitZ());
  scenario.robot.chain.joints[1].type = JointType::prismatic;
  scenario.compliance = {{1, 1e-5}};
  const Eigen::Vector3d expected = planar_tip(kQ1, 0.0) + Eigen::Vector3d(0, 0, kQ2 - 1e-5 * kGravity * kSecondMass);
  expect_near(tip(scenario, visit()), expected);
}

}  // namespace
}  // namespace demecal

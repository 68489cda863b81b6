// How much larger radii are taken to be outside of what was measured: joints, payload and temperature, and the words.
#include "parameters/widening.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "expression/text.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre, ::testing::IsEmpty;

/// Compliant in joint 2 and warm in joint 3, measured with 1 to 5 kg at 20 to 24 degrees.
struct MeasuredArm {
  CorrectedRobot robot;
  std::vector<Interval> ranges;
  std::map<int, std::vector<Interval>> gaps{};
  Stop inside{JointVector::Constant(6, 0.3)};

  MeasuredArm() {
    DataSet data;
    data.robot.chain = wrist_arm();
    robot = nominal_robot(data);
    robot.effects = {
        {.kind = "compliance", .joint = 1, .settings = {}, .form = "payload", .formula = {}, .values = {1e-5}},
        {.kind = "thermal_offset",
         .joint = 2,
         .settings = {{"reference_celsius", 22.0}},
         .form = {},
         .formula = {},
         .values = {1e-5}}};
    robot.payloads_kg = Interval{1.0, 5.0};
    robot.temperatures_celsius = Interval{20.0, 24.0};
    ranges.assign(6, Interval{-1.0, 1.0});
    inside.payload_kg = 2.0;
    inside.temperature_celsius = 21.0;
  }

  Widening at(const Stop& stop) const { return widening(robot, {ranges, gaps}, stop); }
};

TEST(Widening, IsNoneWhereEverythingWasMeasured) {
  const MeasuredArm arm;
  EXPECT_EQ(arm.at(arm.inside).factor, 1.0);
  EXPECT_EQ(arm.at(arm.inside).unstated_m, 0.0);
  EXPECT_THAT(arm.at(arm.inside).reasons, IsEmpty());
  Stop turned = arm.inside;
  turned.joints[3] += 4.0 * std::acos(-1.0);
  EXPECT_NEAR(arm.at(turned).factor, 1.0, 1e-9) << "whole turns aside";
}

TEST(Widening, GrowsWithTheWayOutsideInSharesOfTheRangeAndSaysWhere) {
  MeasuredArm arm;
  Stop joint = arm.inside, heavy = arm.inside, empty = arm.inside, hot = arm.inside, cold = arm.inside;
  joint.joints[1] = 1.5;
  heavy.payload_kg = 7.0;
  empty.payload_kg = 0.0;
  hot.temperature_celsius = 34.0;
  cold.temperature_celsius = 15.0;
  EXPECT_NEAR(arm.at(joint).factor, 1.0 + 2.0 * 0.5 / 2.0, 1e-12);
  EXPECT_NEAR(arm.at(heavy).factor, 1.0 + 2.0 * 2.0 / 4.0, 1e-12);
  EXPECT_NEAR(arm.at(empty).factor, 1.0 + 2.0 * 1.0 / 4.0, 1e-12);
  EXPECT_NEAR(arm.at(hot).factor, 1.0 + 2.0 * 10.0 / 10.0, 1e-12);
  EXPECT_NEAR(arm.at(cold).factor, 1.0 + 2.0 * 5.0 / 10.0, 1e-12);
  EXPECT_THAT(arm.at(joint).sentences(), ElementsAre("joint 2 at 85.9 deg, measured -57.3 .. 57.3 deg"));
  EXPECT_THAT(arm.at(heavy).sentences(), ElementsAre("payload at 7 kg, measured 1 .. 5 kg"));
  EXPECT_THAT(arm.at(hot).sentences(), ElementsAre("temperature at 34 °C, measured 20 .. 24 °C"));
  heavy.joints[1] = 1.5;
  EXPECT_NEAR(arm.at(heavy).factor, 1.0 + 0.5 + 1.0, 1e-12) << "they add up";
  arm.gaps = {{1, {{0.0, 0.8}}}};
  EXPECT_NEAR(arm.at(arm.inside).factor, 1.0 + 2.0 * 0.3 / 2.0, 1e-12);
  EXPECT_THAT(arm.at(arm.inside).sentences(), ElementsAre("joint 2 at 17.2 deg, measured nowhere in 0 .. 45.8 deg"));
}

TEST(Widening, HoldsWhatACorrectionMayBeOffByOutside) {
  MeasuredArm arm;
  arm.robot.corrections[1] = JointCorrection(parse("0.002 * SIN(theta)"), {true, 0.0}, {-1.0, 1.0});
  EXPECT_EQ(arm.at(arm.inside).held_radius_m(), 0.0);
  Stop near = arm.inside, far = arm.inside;
  near.joints[1] = 1.2;
  far.joints[1] = 3.0;
  const auto radius_rad = [&](const Stop& stop) {
    const Eigen::Vector3d tool_m = arm.robot.tool("").translation();
    const auto drives = differential_kinematics(arm.robot.chain, arm.robot.actual_joints(stop), tool_m).drives;
    return arm.at(stop).held_radius_m() / drives.col(1).head<3>().norm();
  };
  EXPECT_NEAR(radius_rad(near), 0.2 * 0.002, 1e-6) << "as steep as in the middle";
  EXPECT_NEAR(radius_rad(far), 0.004 * std::sin(1.0), 1e-6) << "as much as there was between its ends";
  EXPECT_THAT(arm.at(near).sentences(),
              ElementsAre("joint 2 at 68.8 deg, measured -57.3 .. 57.3 deg, where its motion may be off by 0.4 mrad"));
  arm.robot.corrections[1] = {};
  EXPECT_EQ(arm.at(far).held_radius_m(), 0.0);
  Effect gear{.kind = "gear_harmonic", .joint = 1, .settings = {{"ratio", 50.0}}};
  gear.values = {3e-4, 4e-4};
  gear.ranges[1] = {-1.0, 1.0};
  arm.robot.effects.push_back(gear);
  Stop beside = arm.inside;
  beside.joints[1] = 1.01;
  EXPECT_NEAR(radius_rad(beside), (50.0 + 1.5 / kFade) * 5e-4 * 0.01, 1e-8) << "its phase runs on, and it fades";
  EXPECT_NEAR(radius_rad(far), 2.0 * 5e-4, 1e-8);
  EXPECT_TRUE(arm.at(near).is_worth_flagging(1e-4));
  EXPECT_FALSE(arm.at(arm.inside).is_worth_flagging(1e-4));
}

TEST(Widening, HoldsAJumpWhereItsSideIsNotKnown) {
  MeasuredArm arm;
  arm.robot.effects.push_back({.kind = "jump",
                               .joint = 1,
                               .settings = {{"at_rad", -0.2}, {"within_rad", 0.01}},
                               .form = "step",
                               .values = {-1e-3}});
  const auto at = [&](double q2_rad) {
    Stop stop = arm.inside;
    stop.joints[1] = q2_rad;
    return arm.at(stop);
  };
  for (const double known : {-0.215, -0.185, 0.9}) EXPECT_EQ(at(known).held_radius_m(), 0.0) << known;
  for (const double unknown : {-0.209, -0.2, -0.191}) {
    Stop below = arm.inside, above = arm.inside;
    below.joints[1] = unknown - 5e-4, above.joints[1] = unknown + 5e-4;  // a milliradian apart, on one side both
    arm.robot.effects.back().values = {0.0};
    const double apart_m =
        (arm.robot.predict(above, "").translation() - arm.robot.predict(below, "").translation()).norm();
    arm.robot.effects.back().values = {-1e-3};
    EXPECT_NEAR(at(unknown).held_radius_m(), apart_m, 0.01 * apart_m) << unknown;
    EXPECT_EQ(at(unknown).factor, 1.0);
  }
  EXPECT_THAT(
      at(-0.2).sentences(),
      ElementsAre("joint 2 at -11.5 deg, where it jumps by 1 mrad: on which side it is, the poses did not tell"));
  arm.robot.effects.back().form = "square_wave";
  arm.robot.effects.back().settings["per_turn"] = 4.0;
  EXPECT_GT(at(-0.2 + 0.25 * std::acos(-1.0) + 0.009).held_radius_m(), 0.0);
  EXPECT_EQ(at(-0.2 + 0.25 * std::acos(-1.0) + 0.011).held_radius_m(), 0.0);
}

TEST(Widening, HoldsWhateverWasMeasuredOfWhatIsNotStated) {
  const MeasuredArm arm;
  const auto tool_m = [&](const Stop& stop) -> Eigen::Vector3d { return arm.robot.predict(stop, "").translation(); };
  Stop unstated = arm.inside, other = arm.inside;
  unstated.payload_kg = 0.0;
  unstated.payload_stated = false;
  other.payload_kg = 5.0;
  const double payload_m = (tool_m(unstated) - tool_m(other)).norm();
  EXPECT_GT(payload_m, 1e-5);
  EXPECT_NEAR(arm.at(unstated).unstated_m, payload_m, 1e-12);
  EXPECT_EQ(arm.at(unstated).factor, 1.0);
  ASSERT_EQ(arm.at(unstated).reasons.size(), 1u);
  EXPECT_EQ(arm.at(unstated).reasons[0].subject, "payload");
  Stop without = arm.inside, warm = arm.inside;
  without.temperature_celsius.reset();
  warm.temperature_celsius = 24.0;
  const double warmth_m = (tool_m(without) - tool_m(warm)).norm();
  EXPECT_GT(warmth_m, 1e-6);
  EXPECT_NEAR(arm.at(without).unstated_m, warmth_m, 1e-9);
  MeasuredArm rigid;
  rigid.robot.effects.clear();
  EXPECT_EQ(rigid.at(unstated).unstated_m, 0.0) << "nothing depends on it";
  EXPECT_THAT(rigid.at(unstated).reasons, IsEmpty());
}

}  // namespace
}  // namespace demecal

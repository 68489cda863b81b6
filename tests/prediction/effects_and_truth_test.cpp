// Every effect against the simulated robot that has the same error with the same numbers: signs, units, places.
#include <gtest/gtest.h>

#include <functional>

#include "effects/effect.hpp"
#include "effects/laden_arm.hpp"
#include "effects/weight_parts.hpp"
#include "random_robot.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal {
namespace {

constexpr double kReference_celsius = 20.0;

/// An effect, and the same error put into a scenario.
struct Twin {
  Effect effect;
  std::function<void(Scenario&)> inject;
};

Effect valued(std::string kind, int joint, std::map<std::string, double> settings, std::vector<double> values,
              std::string form = "") {
  return {.kind = std::move(kind),
          .joint = joint,
          .settings = std::move(settings),
          .form = std::move(form),
          .formula = {},
          .values = std::move(values)};
}

std::vector<Twin> gear_twins(int i, int other) {
  const double from = other + 1.0;
  return {
      {valued("joint_offset", i, {}, {2e-4}),
       [=](Scenario& s) {
         const bool revolute = is_revolute(s.robot.chain, i);
         s.geometry = {{i, revolute ? LinkParameter::theta : LinkParameter::d, 2e-4}};
       }},
      {valued("gain", i, {}, {1e-4}),
       [=](Scenario& s) {
         s.gains = {{i, 1e-4}};
       }},
      {valued("eccentricity", i, {{"order", 2}}, {1e-4, -2e-4}),
       [=](Scenario& s) {
         s.eccentricities = {{i, 2, 1e-4, -2e-4}};
       }},
      {valued("gear_harmonic", i, {{"ratio", 24.5}}, {1e-4, -2e-4}),
       [=](Scenario& s) {
         s.gear_harmonics = {{i, 24.5, 1e-4, -2e-4}};
       }},
      {valued("coupling", i, {{"from", from}}, {1e-4}, "linear"),
       [=](Scenario& s) {
         s.couplings = {{i, other, 1e-4, 0.0, 0.0}};
       }},
      {valued("coupling", i, {{"from", from}}, {1e-4, -2e-4}, "harmonic"),
       [=](Scenario& s) {
         s.couplings = {{i, other, 0.0, 1e-4, -2e-4}};
       }},
  };
}

std::vector<Twin> load_and_side_twins(int i) {
  return {
      {valued("compliance", i, {}, {3e-6}, "masses"),
       [=](Scenario& s) {
         s.compliance = {{i, 3e-6}};
       }},
      {valued("compliance", i, {}, {3e-6, 0.0, 0.0}, "tilted"),
       [=](Scenario& s) {
         s.compliance = {{i, 3e-6}};
       }},
      {valued("compliance", i, {}, {3e-5}, "payload"),
       [=](Scenario& s) {
         for (LinkMass& link : s.robot.masses) link.mass_kg = 0.0;
         s.compliance = {{i, 3e-5}};
       }},
      {valued("link_bending", i, {}, {3e-6, -2e-6}),
       [=](Scenario& s) {
         s.link_bending = {{i, 3e-6, -2e-6}};
       }},
      {valued("backlash", i, {}, {4e-4}),
       [=](Scenario& s) {
         s.backlash = {{i, 4e-4}};
       }},
      {valued("hysteresis", i, {}, {1e-4, 1e-4 * 0.02}),
       [=](Scenario& s) {
         s.hysteresis = {{i, 1e-4, 0.02}};
       }},
      {valued("axis_wobble", i, {{"order", 2}}, {1e-4, -2e-4, 3e-4, 5e-5}),
       [=](Scenario& s) {
         s.axis_wobble = {{i, 2, {1e-4, -2e-4}, {3e-4, 5e-5}}};
       }},
      {valued("thermal_offset", i, {{"reference_celsius", kReference_celsius}}, {2e-5}),
       [=](Scenario& s) {
         s.thermal_offsets = {{i, 2e-5}};
       }},
      {valued("thermal_length", i, {{"reference_celsius", kReference_celsius}}, {5e-5}),
       [=](Scenario& s) {
         s.thermal_lengths = {{i, 5e-5}};
       }},
  };
}

Twin symbolic_twin(int i, const Robot& robot) {
  const std::string formula = "SIN(q2 + 2 * q5) + tau * 0.01 + s * 0.3 + T * 0.1";
  Effect effect = valued("symbolic", i, {{"reference_celsius", kReference_celsius}}, {1e-4});
  effect.formula = parse(formula, symbolic_variables(robot.chain));
  return {effect, [=](Scenario& s) {
            const Tree truth = parse(formula, symbolic_variables(s.robot.chain.size()));
            s.symbolic = {{i, apply(Primitive::multiply, constant_tree(1e-4), truth)}};
          }};
}

/// Links wrong in everything that geometry has free.
Twin geometry_twin(int i, const Robot& robot) {
  const std::map<std::string, LinkParameter> parameters = {{"theta_rad", LinkParameter::theta},
                                                           {"d_m", LinkParameter::d},
                                                           {"a_m", LinkParameter::a},
                                                           {"alpha_rad", LinkParameter::alpha},
                                                           {"beta_rad", LinkParameter::beta}};
  Effect effect = valued("geometry", i, {}, {});
  std::vector<GeometryError> errors;
  for (const CoefficientLabel& label : law_of(effect).coefficients(effect, robot)) {
    effect.values.push_back(1e-4 * (1.0 + static_cast<double>(effect.values.size())));
    errors.push_back({i, parameters.at(label.name), effect.values.back()});
  }
  return {effect, [=](Scenario& s) { s.geometry = errors; }};
}

std::vector<Twin> whole_arm_twins() {
  return {
      {valued("tool", -1, {}, {1e-4, -2e-4, 3e-4}, "position"),
       [](Scenario& s) {
         s.tool_error_m = {1e-4, -2e-4, 3e-4};
       }},
      {valued("drift", -1, {{"reference_time_s", 0.0}}, {1e-7, -2e-7, 3e-7, 1e-7, 5e-8, -2e-7}),
       [](Scenario& s) {
         s.drift = {{1e-7, -2e-7, 3e-7}, {1e-7, 5e-8, -2e-7}};
       }},
      {valued("registration", -1, {}, {1e-4, -2e-4, 3e-4, 1e-4, 5e-5, -2e-4}),
       [](Scenario& s) {
         const Eigen::Vector3d turn(1e-4, 5e-5, -2e-4);
         Eigen::Isometry3d moved(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
         moved.translation() = Eigen::Vector3d(1e-4, -2e-4, 3e-4);
         s.sensor_from_base = moved * s.sensor_from_base;
       }},
  };
}

Scenario faultless(const Robot& robot, const Eigen::Isometry3d& sensor_from_base, double celsius) {
  Scenario scenario;
  scenario.robot = robot;
  scenario.by_joints = true;
  scenario.sensor_from_base = sensor_from_base;
  scenario.temperature = TemperatureCourse{celsius, celsius, 1000.0};
  scenario.reference_celsius = kReference_celsius;
  return scenario;
}

/// The true pose with the error differs from that without as the effect says, but for its square.
void expect_twins(const Twin& twin, const Robot& robot, RandomStream& stream) {
  SCOPED_TRACE(twin.effect.kind + ' ' + std::to_string(twin.effect.joint + 1) + ' ' + twin.effect.form);
  const Eigen::Isometry3d sensor_from_base = random_pose(stream);
  const Stop stop = random_stop(stream, robot);
  const Scenario right = faultless(robot, sensor_from_base, *stop.temperature_celsius);
  Scenario wrong = right;
  twin.inject(wrong);
  const Visit visit{stop.joints, stop.approach, stop.payload_kg, *stop.time_s};
  const PoseError moved = pose_error(SimulatedRobot(right).true_pose(visit), SimulatedRobot(wrong).true_pose(visit));
  const PoseError predicted = first_order(twin.effect, robot, arm_state(robot, stop), sensor_from_base);
  EXPECT_GT(predicted.norm(), 1e-7);
  EXPECT_LT((moved - predicted).norm(), 10.0 * predicted.squaredNorm() + 1e-12)
      << moved.transpose() << " instead of " << predicted.transpose();
}

TEST(EffectsAndTruth, AgreeForEveryJointOfEveryArm) {
  RandomStream stream{35, 1};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    for (int joint = 0; joint < 6; ++joint) {
      std::vector<Twin> twins = gear_twins(joint, (joint + 2) % 6);
      for (Twin& twin : load_and_side_twins(joint)) twins.push_back(std::move(twin));
      twins.push_back(geometry_twin(joint, robot));
      twins.push_back(symbolic_twin(joint, robot));
      for (const Twin& twin : twins) expect_twins(twin, robot, stream);
    }
  }
}

TEST(EffectsAndTruth, AgreeOnBalanceSprings) {
  RandomStream stream{35, 7};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    for (const int i : {0, 1, 3, 4, 5}) {
      const Effect effect =
          valued("balancer", i, {{"fixed_m", 0.25}, {"moving_m", 0.4}, {"shortest_rad", 1.2}}, {1e-3, 5e-3});
      const auto inject = [i](Scenario& s) { s.balance_springs = {{i, 0.25, 0.4, 1.2, 1000.0, 5000.0, 1e-6}}; };
      expect_twins({effect, inject}, robot, stream);
    }
  }
}

TEST(EffectsAndTruth, AgreeForToolBaseAndInstrument) {
  RandomStream stream{35, 2};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    for (const Twin& twin : whole_arm_twins()) expect_twins(twin, robot, stream);
  }
}

TEST(EffectsAndTruth, AgreeOnTheInstrumentsScale) {
  RandomStream stream{35, 3};
  const Robot robot = laden_arm(stream, Arm::standard);
  const Eigen::Isometry3d sensor_from_base = random_pose(stream);
  const Stop stop = random_stop(stream, robot);
  Scenario scenario = faultless(robot, sensor_from_base, kReference_celsius);
  scenario.sensor_scale.share = 1e-4;
  const SimulatedRobot simulated(scenario);
  const Visit visit{stop.joints, stop.approach, stop.payload_kg, *stop.time_s};
  const Eigen::Vector3d truth = simulated.true_pose(visit).translation();
  ArmState state = arm_state(robot, stop);
  state.tool_in_sensor_m = truth;
  const PoseError predicted = first_order(valued("sensor_scale", -1, {}, {1e-4}), robot, state, sensor_from_base);
  EXPECT_LT((*simulated.measure(visit, stream).position_m - truth - predicted.head<3>()).norm(), 1e-14);
  EXPECT_EQ(predicted.tail<3>().norm(), 0.0);
}

TEST(EffectsAndTruth, SeatedBacklashSaturatesOnTheSideOfTheLoad) {
  RandomStream stream{35, 4};
  const Robot robot = laden_arm(stream, Arm::standard);
  const Effect effect = valued("backlash", 1, {{"torque0_nm", 1e-3}}, {1.0}, "seated");
  for (int i = 0; i < 10; ++i) {
    const ArmState state = arm_state(robot, random_stop(stream, robot));
    std::vector<UnitMotion> motions;
    append_unit_motions(effect, robot, state, motions);
    ASSERT_EQ(motions.size(), 1u);
    EXPECT_NEAR(motions[0].size, state.torque(robot.chain, 1) > 0.0 ? 0.5 : -0.5, 1e-9);
  }
}

TEST(EffectsAndTruth, LoggedTorquesTellOfTheMassesThatNobodyStated) {
  RandomStream stream{35, 6};
  for (const Arm arm : kArms) {
    const Robot heavy = laden_arm(stream, arm);
    Scenario scenario = faultless(heavy, Eigen::Isometry3d::Identity(), kReference_celsius);
    scenario.torque_log = TorqueLog{.noise = 0.0, .friction = 3.0};
    const SimulatedRobot simulated(scenario);
    Robot robot = heavy;
    robot.masses.clear();
    const auto logged = [&] {
      const Stop stop = random_stop(stream, heavy);
      return Stop(simulated.measure({stop.joints, stop.approach, stop.payload_kg, 0.0}, stream));
    };
    std::vector<ArmState> states;
    for (int i = 0; i < 120; ++i) {
      Stop stop = logged();
      stop.payload_kg = 0.0;
      stop.torque = simulated.measure({stop.joints, stop.approach, 0.0, 0.0}, stream).torque.value();
      states.push_back(arm_state(robot, stop));
    }
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      Effect effect = valued("compliance", joint, logged_weights(robot, states, joint), {1.0}, "logged");
      for (const ArmState& state : states) {
        Stop unlogged = state.stop;
        unlogged.torque = {};
        const double truth = arm_state(heavy, state.stop).torque(heavy.chain, joint);
        for (const ArmState& either : {state, arm_state(robot, unlogged)}) {
          std::vector<UnitMotion> motions;
          append_unit_motions(effect, robot, either, motions);
          const double found = motions.empty() ? 0.0 : motions.at(0).size;
          EXPECT_NEAR(found, truth, 0.03 * std::abs(truth) + 0.3) << "joint " << joint + 1;  // parts below 1 % are left
        }
      }
    }
  }
}

TEST(EffectsAndTruth, NothingMovesWhereCircumstancesAreUnknown) {
  RandomStream stream{35, 5};
  Robot robot = laden_arm(stream, Arm::standard);
  robot.masses.clear();
  const ArmState state = arm_state(robot, Stop(random_joints(stream, robot.chain)));
  std::vector<UnitMotion> motions;
  for (const Effect& effect :
       {valued("backlash", 1, {}, {1.0}), valued("hysteresis", 1, {}, {1.0, 1.0}),
        valued("compliance", 1, {}, {1.0}, "masses"), valued("compliance", 1, {}, {1.0}, "payload"),
        valued("thermal_offset", 1, {{"reference_celsius", 20}}, {1.0}),
        valued("thermal_length", 1, {{"reference_celsius", 20}}, {1.0}),
        valued("drift", -1, {{"reference_time_s", 5}}, {1, 1, 1, 1, 1, 1})}) {
    append_unit_motions(effect, robot, state, motions);
    EXPECT_TRUE(motions.empty()) << effect.kind;
  }
}

}  // namespace
}  // namespace demecal

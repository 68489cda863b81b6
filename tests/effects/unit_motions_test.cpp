// Unit motions against arms that are walked again with one place moved, and against the Jacobian of the links.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "decompositions/decompositions.hpp"
#include "effects/weight_parts.hpp"
#include "kinematics/chain.hpp"
#include "laden_arm.hpp"

namespace demecal {
namespace {

using ::testing::UnorderedElementsAre;

constexpr double kStep = 1e-6;

/// Moves the frame along (0-2) or about (3-5) one of its own axes.
void nudge(Eigen::Isometry3d& frame, int axis, double size) {
  if (axis < 3) {
    frame.translate(size * Eigen::Vector3d::Unit(axis));
  } else {
    frame.rotate(Eigen::AngleAxisd(size, Eigen::Vector3d::Unit(axis - 3)));
  }
}

/// Pose of the tool in the base frame, every place moved by the effect with the given values.
Eigen::Isometry3d walk_moved(const Effect& effect, const Robot& robot, const ArmState& state) {
  std::vector<UnitMotion> motions;
  append_unit_motions(effect, robot, state, motions);
  const auto move = [&](int place, Eigen::Isometry3d& frame) {
    for (const UnitMotion& motion : motions) {
      const double value = effect.value(static_cast<std::size_t>(motion.coefficient));
      if (motion.place == place) nudge(frame, motion.axis, value * motion.size);
    }
  };
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  move(kSensorPlace, frame);
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    for (const Elementary& transform : elementary_transforms(robot.chain.convention)) {
      if (transform.parameter == LinkParameter::theta) move(joint, frame);
      const Joint& link = robot.chain.joints[static_cast<std::size_t>(joint)];
      const bool moves = transform.parameter == moving_parameter(link);
      advance(frame, transform, link.parameter(transform.parameter) + (moves ? state.joints()[joint] : 0.0));
    }
  }
  move(robot.chain.size(), frame);
  frame.translate(robot.chain.tool_m);
  return frame;
}

TEST(UnitMotions, MoveTheToolAsAnArmWalkedAgain) {
  RandomStream stream{34, 1};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    ArmState state = arm_state(robot, random_stop(stream, robot));
    state.tool_in_sensor_m = state.payload_point_m;
    for (const EffectLaw* law : catalogue()) {
      for (Effect& effect : law->proposals(robot, full_evidence(robot))) {
        const std::size_t count = law->coefficients(effect, robot).size();
        for (std::size_t coefficient = 0; coefficient < count; ++coefficient) {
          effect.values.assign(count, 0.0);
          effect.values[coefficient] = 1.0;
          const PoseError expected = first_order(effect, robot, state, Eigen::Isometry3d::Identity());
          const double step = kStep / std::max(1.0, expected.norm());
          effect.values[coefficient] = step;
          const Eigen::Isometry3d ahead = walk_moved(effect, robot, state);
          effect.values[coefficient] = -step;
          const PoseError moved = pose_error(walk_moved(effect, robot, state), ahead) / (2 * step);
          ASSERT_LT((moved - expected).norm(), 1e-7 * std::max(1.0, expected.norm()))
              << effect.kind << ' ' << effect.joint + 1 << ' ' << coefficient;
        }
      }
    }
  }
}

TEST(UnitMotions, OfGeometryAreTheColumnsOfTheLinkJacobian) {
  RandomStream stream{34, 2};
  const std::map<std::string, LinkParameter> parameters = {{"theta_rad", LinkParameter::theta},
                                                           {"d_m", LinkParameter::d},
                                                           {"a_m", LinkParameter::a},
                                                           {"alpha_rad", LinkParameter::alpha},
                                                           {"beta_rad", LinkParameter::beta}};
  for (const Arm arm : kArms) {
    Robot robot = laden_arm(stream, arm);
    robot.chain.joints[1].alpha_rad = 0.01;
    robot.chain.joints[2].alpha_rad = 0.01;
    const Stop stop = random_stop(stream, robot);
    const ArmState state = arm_state(robot, stop);
    const LinkJacobian jacobian = link_jacobian(robot.chain, stop.joints, robot.chain.tool_m);
    for (const char* kind : {"geometry", "joint_offset"}) {
      const EffectLaw& law = *find_law(kind);
      for (Effect& effect : law.proposals(robot, {})) {
        const std::vector<CoefficientLabel> labels = law.coefficients(effect, robot);
        for (std::size_t i = 0; i < labels.size(); ++i) {
          effect.values.assign(labels.size(), 0.0);
          effect.values[i] = 1.0;
          const int column = effect.joint * kLinkParameters + static_cast<int>(parameters.at(labels[i].name));
          EXPECT_LT((first_order(effect, robot, state, Eigen::Isometry3d::Identity()) - jacobian.col(column)).norm(),
                    1e-12)
              << kind << ' ' << effect.joint + 1 << ' ' << labels[i].name;
        }
      }
    }
  }
}

std::vector<std::string> free_names(const Robot& robot, int joint) {
  std::vector<std::string> names;
  const Effect effect{.kind = "geometry", .joint = joint};
  for (const CoefficientLabel& label : law_of(effect).coefficients(effect, robot)) names.push_back(label.name);
  return names;
}

TEST(UnitMotions, OfGeometryHaveBetaBetweenParallelAxes) {
  RandomStream stream{34, 3};
  Robot standard = laden_arm(stream, Arm::sliding_standard), modified = laden_arm(stream, Arm::sliding_modified);
  standard.chain.joints[1].alpha_rad = modified.chain.joints[1].alpha_rad = 0.01;
  EXPECT_THAT(free_names(standard, 0), UnorderedElementsAre("d_m", "a_m", "alpha_rad"));
  EXPECT_THAT(free_names(standard, 1), UnorderedElementsAre("beta_rad", "a_m", "alpha_rad"));
  EXPECT_THAT(free_names(standard, 2), UnorderedElementsAre("theta_rad", "alpha_rad"));
  EXPECT_THAT(free_names(modified, 0), UnorderedElementsAre("d_m", "a_m", "alpha_rad"));
  EXPECT_THAT(free_names(modified, 1), UnorderedElementsAre("beta_rad", "a_m", "alpha_rad"));
  EXPECT_THAT(free_names(modified, 2), UnorderedElementsAre("theta_rad", "alpha_rad"));
}

/// An arm that stands upright: gravity along the first joint's axis.
Robot upright_arm() {
  Robot robot;
  robot.chain = wrist_arm();
  for (int link = 0; link < 6; ++link) robot.masses.push_back({2.0 + link, {0.05, -0.03, 0.1}});
  return robot;
}

TEST(UnitMotions, AVerticalAxisCarriesNoWeight) {
  const Robot robot = upright_arm();
  Evidence evidence = full_evidence(robot);
  for (const bool masses : {true, false}) {
    evidence.masses = masses;
    for (const char* kind : {"compliance", "hysteresis"}) {
      for (const Effect& effect : find_law(kind)->proposals(robot, evidence)) {
        EXPECT_TRUE(effect.joint != 0 || effect.settings.contains("gravity_turn")) << kind;  // a leaning mount's share
      }
    }
    for (const Effect& effect : find_law("backlash")->proposals(robot, evidence)) {
      EXPECT_TRUE(effect.joint > 0 || effect.form != "seated");
    }
  }
}

TEST(UnitMotions, OfUnknownMassesAreThoseThatCanBeToldApart) {
  const Robot robot = upright_arm();
  Evidence evidence = full_evidence(robot);
  const std::vector<ArmState> states = sampled_states(robot, evidence, 0.0);
  // Of the last link, turning about its own z, only what is off that axis shows; of joint 5, the moments of link 5, and
  // with them those of link 6 along its axis, which stands still in link 5.
  EXPECT_EQ(independent_parts(robot, states, 5).size(), 2u);
  EXPECT_EQ(independent_parts(robot, states, 4).size(), 4u);
  for (int joint = 1; joint < 6; ++joint) {
    for (const WeightPart& part : independent_parts(robot, states, joint)) {
      EXPECT_LT(part.axis, 3) << "masses hang on the links' moments";
      EXPECT_EQ(name_of(*weight_part(name_of(part))), name_of(part));
    }
  }
  EXPECT_FALSE(weight_part("3_mw") || weight_part("mx") || weight_part("0_mx"));
}

/// Least squares of the columns to a target: the largest residual.
double largest_residual(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) {
  return (columns * PivotedQr(columns).solve(target) - target).cwiseAbs().maxCoeff();
}

TEST(UnitMotions, OfUnknownMassesSpanTheTorqueOfAnyMasses) {
  RandomStream stream{34, 4};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    Evidence evidence = full_evidence(robot);
    evidence.masses = false;
    for (const Effect& effect : find_law("compliance")->proposals(robot, evidence)) {
      if (effect.form != "moments") continue;
      const auto count = static_cast<Eigen::Index>(law_of(effect).coefficients(effect, robot).size());
      if (count < 2) continue;  // one part at a time: several of them make the whole
      Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(60, count);
      Eigen::VectorXd torque(60);
      for (Eigen::Index row = 0; row < 60; ++row) {
        const ArmState state = arm_state(robot, random_stop(stream, robot));
        std::vector<UnitMotion> motions;
        append_unit_motions(effect, robot, state, motions);
        for (const UnitMotion& motion : motions) columns(row, motion.coefficient) += motion.size;
        torque[row] = state.torque(robot.chain, effect.joint);
      }
      EXPECT_LT(largest_residual(columns, torque), 0.02 * torque.cwiseAbs().maxCoeff()) << "joint " << effect.joint + 1;
    }
  }
}

TEST(UnitMotions, OfABaseUnderUnknownMassesSpanTheMomentOfAnyMasses) {
  RandomStream stream{34, 14};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    Evidence evidence = full_evidence(robot);
    evidence.masses = false;
    const std::vector<Effect> effects = find_law("link_bending")->proposals(robot, evidence);
    ASSERT_GT(effects.size(), 2u);
    const Effect& all = effects.back();  // those before it are its parts, one by one
    const auto count = static_cast<Eigen::Index>(law_of(all).coefficients(all, robot).size());
    EXPECT_EQ(count, std::ssize(effects) - 1);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(80, count);
    Eigen::VectorXd moment(80);
    for (Eigen::Index stop = 0; stop < 40; ++stop) {
      const ArmState state = arm_state(robot, Stop(random_joints(stream, robot.chain)));
      std::vector<UnitMotion> motions;
      append_unit_motions(all, robot, state, motions);
      for (const UnitMotion& motion : motions) {
        ASSERT_EQ(motion.place, 0);
        columns(2 * stop + motion.axis - 3, motion.coefficient) += motion.size;
      }
      moment.segment<2>(2 * stop) = state.loads[0].moment_nm.head<2>();
    }
    EXPECT_LT(largest_residual(columns, moment), 0.02 * moment.cwiseAbs().maxCoeff());
  }
}

TEST(UnitMotions, NoBaseTiltsByMoreThanThreeMilliradians) {
  RandomStream stream{34, 15};
  const Robot robot = laden_arm(stream, Arm::standard);
  Evidence evidence = full_evidence(robot);
  evidence.masses = false;
  for (Effect effect : find_law("link_bending")->proposals(robot, evidence)) {
    effect.values.assign(law_of(effect).coefficients(effect, robot).size(), -1e-3);
    EXPECT_EQ(law_of(effect).implausibility(effect), "");
    effect.values.back() = -4e-3;
    EXPECT_EQ(law_of(effect).implausibility(effect), "no base gives way so far (> 3 mrad)");
  }
}

TEST(UnitMotions, NoLinkGrowsMuchMoreThanAluminium) {
  Effect effect{.kind = "thermal_length", .joint = 1, .settings = {{"reference_celsius", 20.0}}, .values = {23e-6}};
  EXPECT_EQ(law_of(effect).implausibility(effect), "");
  for (const double share : {1e-3, -1e-3}) {
    effect.values = {share};
    EXPECT_THAT(law_of(effect).implausibility(effect), ::testing::HasSubstr("no link grows so much"));
  }
}

TEST(UnitMotions, OfTiltedGravityAreTheTorqueOfLeaningGravity) {
  RandomStream stream{34, 5};
  constexpr double kLean = 1e-5;
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    const Stop stop = random_stop(stream, robot);
    for (int joint = 0; joint < 6; ++joint) {
      const Effect effect{.kind = "compliance", .joint = joint, .settings = {}, .form = "tilted"};
      std::vector<UnitMotion> motions;
      append_unit_motions(effect, robot, arm_state(robot, stop), motions);
      ASSERT_EQ(motions.size(), 3u);
      EXPECT_NEAR(motions[0].size, arm_state(robot, stop).torque(robot.chain, joint), 1e-10);
      // However gravity leans, its torque changes by a combination of the two columns that is the same for all joints.
      Robot leaning = robot;
      const Eigen::Vector3d down = robot.gravity_mps2.normalized();
      const Eigen::Vector3d hint = std::abs(down.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
      const Eigen::Vector3d axis = (hint - down.dot(hint) * down).normalized();
      leaning.gravity_mps2 = Eigen::AngleAxisd(kLean, axis) * robot.gravity_mps2;
      const double change = arm_state(leaning, stop).torque(robot.chain, joint) - motions[0].size;
      EXPECT_NEAR(motions[1].size, change / kLean, 1e-2);
    }
  }
}

}  // namespace
}  // namespace demecal

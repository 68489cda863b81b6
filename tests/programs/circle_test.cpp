// The circle: a corrected program, run on a robot that is wrong as the model says, hits what the program meant.
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"
#include "parsed_programs/orientation.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal {
namespace {

constexpr int kTargets = 5;

struct Run {
  double position_m = 0.0, orientation_rad = 0.0;  ///< the largest errors
};

/// Where a target's numbers send the nominal robot, as its controller solves them near `about`.
JointVector sent_to(const Target& target, const Chain& arm, const JointVector& about) {
  if (!target.is_pose()) {
    JointVector joints(arm.size());
    for (int i = 0; i < arm.size(); ++i) joints[i] = target.joints[static_cast<std::size_t>(i)].inside();
    return joints;
  }
  std::vector<double> numbers;
  for (const Cell& cell : target.orientation) numbers.push_back(cell.inside());
  Eigen::Isometry3d tool(rotation_from(target.form, numbers));
  for (int i = 0; i < 3; ++i) tool.translation()[i] = target.position[static_cast<std::size_t>(i)].inside();
  return nominal_joints(arm, tool, {.near = about}, about).value();
}

/// Runs the program on the real robot: each joint is approached as the commands before say.
Run run_on(const CommandModel& real, const Program& program, const std::vector<JointVector>& meant) {
  Run errors;
  ApproachSigns signs = ApproachSigns::Zero(6);
  JointVector last;
  for (std::size_t i = 0; i < meant.size(); ++i) {
    const JointVector joints = sent_to(program.targets[i], real.nominal.chain, meant[i]);
    if (i > 0) signs = (joints - last).cwiseSign();
    last = joints;
    Stop stop(joints);
    stop.approach = signs;
    const PoseError error = pose_error(real.robot.predict(stop, ""), real.nominal_tool(meant[i]));
    errors.position_m = std::max(errors.position_m, error.head<3>().norm());
    errors.orientation_rad = std::max(errors.orientation_rad, error.tail<3>().norm());
  }
  return errors;
}

struct Circle {
  Run before, after;
};

/// Targets at which the arm is regular, each joint at least 5 mrad from the target before; those of poses so near to
/// the middle of the joints and to each other that their configuration needs no saying.
std::vector<JointVector> random_targets(RandomStream& stream, const Chain& arm, bool of_poses) {
  std::vector<JointVector> targets;
  while (std::ssize(targets) < kTargets) {
    JointVector joints = (of_poses ? 0.35 : 1.0) * random_joints(stream, arm);
    if (of_poses && !targets.empty()) joints = targets.back() + random_change(stream, 6, 0.3);
    const bool moved = targets.empty() || (joints - targets.back()).cwiseAbs().minCoeff() > 5e-3;
    if (moved && is_regular(arm, joints) && joints.cwiseAbs().maxCoeff() < (of_poses ? 1.1 : 3.0)) {
      targets.push_back(joints);
    }
  }
  return targets;
}

Circle circle_of(RandomStream& stream, const CommandModel& model, WrittenIn language, bool of_poses, int decimals) {
  std::vector<JointVector> meant = random_targets(stream, model.nominal.chain, of_poses);
  const auto line = [&](int index) {
    const JointVector& joints = meant[static_cast<std::size_t>(index - 1)];
    return of_poses ? pose_line(language, model.nominal_tool(joints), joints, index, decimals)
                    : joints_line(language, joints, index, decimals);
  };
  const std::string text = written(language, of_poses, kTargets, line, "\n");
  Program program = read_program(language, text, "p", model.nominal.chain);
  const Run before = run_on(model, program, meant);
  const CorrectedProgram corrected = correct_program(text, std::move(program), model, {.near = meant.front()});
  for (std::size_t i = 0; i < meant.size(); ++i) {
    EXPECT_EQ(corrected.targets[i].outcome, CorrectionOutcome::corrected);
    EXPECT_LT((meant[i] - corrected.targets[i].nominal).norm(), 1e-2);
    meant[i] = corrected.targets[i].nominal;  // the file's rounding
  }
  return {before, run_on(model, read_program(language, corrected.text, "p", model.nominal.chain), meant)};
}

TEST(CorrectedProgram, OfJointsHitsTheNominalPoints) {
  RandomStream stream{7201};
  for (int repetition = 0; repetition < 4; ++repetition) {
    const CommandModel model = erring_model(stream, elbow_arm(stream));
    for (const WrittenIn language : kLanguages) {
      if (!has_joint_targets(language)) continue;
      SCOPED_TRACE(to_string(language));
      const Circle exact = circle_of(stream, model, language, false, 10);
      EXPECT_GT(exact.before.position_m, 1e-4);
      EXPECT_LT(exact.after.position_m, 1e-6);
      EXPECT_LT(exact.after.orientation_rad, 1e-6);
    }
  }
}

TEST(CorrectedProgram, OfJointsIsNoWorseThanItsRounding) {
  RandomStream stream{7202};
  constexpr double kReach = 1.7, kHalfOfTheLastDegree = 0.5e-4 * 3.14159 / 180.0;
  for (int repetition = 0; repetition < 4; ++repetition) {
    const CommandModel model = erring_model(stream, elbow_arm(stream));
    for (const WrittenIn language : kLanguages) {
      if (!has_joint_targets(language)) continue;
      SCOPED_TRACE(to_string(language));
      EXPECT_LT(circle_of(stream, model, language, false, 4).after.position_m,
                6 * kReach * kHalfOfTheLastDegree + 1e-6);
    }
  }
}

TEST(CorrectedProgram, OfPosesHitsThePoses) {
  RandomStream stream{7203};
  for (int repetition = 0; repetition < 4; ++repetition) {
    const CommandModel model = erring_model(stream, elbow_arm(stream));
    for (const WrittenIn language : kLanguages) {
      SCOPED_TRACE(to_string(language));
      const Circle circle = circle_of(stream, model, language, true, 10);
      EXPECT_GT(circle.before.position_m, 1e-4);
      EXPECT_LT(circle.after.position_m, 1e-6);
      if (language != WrittenIn::val2) {
        EXPECT_LT(circle.after.orientation_rad, 1e-6);
      }
    }
  }
}

TEST(CorrectedProgram, DoesNotDependOnWhereTheInstrumentStands) {
  RandomStream stream{7204};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 1e-3, 2e-3);
  const std::string text = written(
      WrittenIn::val2, false, 3,
      [&](int index) { return joints_line(WrittenIn::val2, regular_joints(stream, nominal.chain), index, 6); }, "\n");
  const Program program = read_program(WrittenIn::val2, text, "p", nominal.chain);
  const std::string here = correct_program(text, program, unbounded_model(nominal, identified), {}).text;
  identified.sensor_from_base = random_pose(stream);
  identified.effects = {{.kind = "registration", .values = {0.01, 0.0, 0.0, 0.0, 0.02, 0.0}},
                        {.kind = "sensor_scale", .values = {1e-3}}};
  EXPECT_EQ(correct_program(text, program, unbounded_model(nominal, identified), {}).text, here);
}

TEST(CorrectedProgram, DoesNotDependOnHowAFitSharesOutBaseAndFirstJoint) {
  for (const Convention convention : {Convention::standard_dh, Convention::modified_dh}) {
    RandomStream stream{7206, static_cast<std::uint64_t>(convention)};
    Robot nominal = elbow_arm(stream);
    nominal.chain.convention = convention;
    CorrectedRobot identified = random_robot(stream, nominal.chain, 1e-3, 2e-3);
    const CorrectedRobot first = without_base(identified, nominal.chain);
    const Eigen::Isometry3d before = identified.predict(Stop(JointVector::Zero(6)), "");
    // The same arm, its first joint raised and turned where its base is lowered and turned back.
    const double raised_m = 0.033, turned_rad = -0.04;
    identified.chain.joints[0].d_m += raised_m;
    identified.chain.joints[0].theta_rad += turned_rad;
    if (convention == Convention::standard_dh) {
      identified.sensor_from_base = identified.sensor_from_base * Eigen::Translation3d(0.0, 0.0, -raised_m) *
                                    Eigen::AngleAxisd(-turned_rad, Eigen::Vector3d::UnitZ());
      EXPECT_TRUE(identified.predict(Stop(JointVector::Zero(6)), "").isApprox(before, 1e-12));
    }
    const CorrectedRobot second = without_base(identified, nominal.chain);
    const JointVector joints = random_joints(stream, nominal.chain);
    const auto point = [&](const CorrectedRobot& robot) {
      return unbounded_model(nominal, robot).robot.predict(Stop(joints), "");
    };
    EXPECT_TRUE(point(first).isApprox(point(second), 1e-12));
    EXPECT_GT((point(first).translation() - point(identified).translation()).norm(), 0.01);
  }
}

TEST(CorrectedProgram, OfAnotherToolIsNotCorrectedForTheToolMeasured) {
  RandomStream stream{7205};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(6, {});
  identified.tools[""].translation() += Eigen::Vector3d(0.008, 0.0, 0.0);
  const std::vector<double> none(6, std::numeric_limits<double>::infinity());
  const std::string text = joints_line(WrittenIn::urscript, regular_joints(stream, nominal.chain), 1, 6);
  const Program program = read_program(WrittenIn::urscript, text, "p", nominal.chain);
  const Eigen::Vector3d other{0.0, 0.0, 0.3};
  EXPECT_NE(correct_program(text, program, command_model(nominal, identified, none), {}).text, text);
  EXPECT_EQ(correct_program(text, program, with_stated_tool(command_model(nominal, identified, none), other), {}).text,
            text);
}

}  // namespace
}  // namespace demecal

// In which configuration a target is reached: what tells, and what is left where nothing does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "kinematics/units.hpp"
#include "languages/written_program.hpp"
#include "programs/configuration.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

struct Configured {
  RandomStream stream{7506};
  CommandModel model = erring_model(stream, elbow_arm(stream));
  JointVector meant = [] {
    JointVector joints(6);
    joints << 0.4, -0.7, 0.5, 0.3, 0.9, -0.2;
    return joints;
  }();

  std::string line(const JointVector& joints) const {
    return pose_line(WrittenIn::urscript, model.nominal_tool(joints), joints, 1, 9) + "\n";
  }
  CorrectedProgram correct(const std::string& text, const JointVector& near = {}) const {
    return correct_program(text, read_program(WrittenIn::urscript, text, "p.script", model.nominal.chain), model,
                           {.temperature_celsius = 20.0, .near = near});
  }
};

TEST(Configuration, ThatNothingTellsLeavesTheLineAndStatesBothCorrections) {
  const Configured of;
  const std::string text = of.line(of.meant);
  const CorrectedProgram corrected = of.correct(text);
  EXPECT_EQ(corrected.text, text);
  EXPECT_EQ(corrected.targets[0].from, JointsFrom::undetermined);
  ASSERT_EQ(corrected.warnings.size(), 1u);
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("configuration is not known (joint"));
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("the corrections differ by"));
}

TEST(Configuration, ComesFromTheJointsBeforeOrFromTheUser) {
  const Configured of;
  const JointVector before = of.meant + JointVector::Constant(6, 0.05);
  const CorrectedProgram moved = of.correct(joints_line(WrittenIn::urscript, before, 1, 9) + '\n' + of.line(of.meant));
  EXPECT_EQ(moved.targets[1].from, JointsFrom::line);
  EXPECT_LT((moved.targets[1].nominal - of.meant).norm(), 1e-6);
  const CorrectedProgram named = of.correct(of.line(of.meant), before);
  EXPECT_EQ(named.targets[0].from, JointsFrom::given);
  EXPECT_LT((named.targets[0].nominal - of.meant).norm(), 1e-6);
  ASSERT_EQ(named.warnings.size(), 1u);
  EXPECT_THAT(named.warnings[0].sentence, HasSubstr("the side that the arm comes from"));
}

TEST(Configuration, ThatNoJointsHaveLeavesTheLine) {
  Configured of;
  JointVector stated = of.meant;
  stated[0] += radians(90.0);
  of.model.nominal.chain.tool_m.setZero();
  std::string text = pose_line(WrittenIn::rapid, of.model.nominal_tool(of.meant), stated, 1, 9) + "\n";
  text.replace(text.find("t_test"), 6, "tool0");
  const Program program = read_program(WrittenIn::rapid, text, "p.mod", of.model.nominal.chain);
  const CorrectedProgram corrected = correct_program(text, program, of.model, {.temperature_celsius = 20.0});
  EXPECT_EQ(corrected.text, text);
  ASSERT_FALSE(corrected.warnings.empty());
  EXPECT_THAT(corrected.warnings.back().sentence, HasSubstr("in the configuration that is stated; this line was not"));
}

TEST(Configuration, IsNotThatOfAnotherRoutinesLastMotion) {
  const Configured of;
  const JointVector before = of.meant + JointVector::Constant(6, 0.05);
  const std::string known = joints_line(WrittenIn::urscript, before, 1, 9) + '\n';
  const auto from = [&](const std::string& text) { return of.correct(text).targets.back().from; };
  const std::string moves = "def f():\n" + known + "end\n", waits = "def f():\nsleep(1)\nend\n";
  EXPECT_EQ(from("def m():\n" + known + of.line(of.meant) + "end\n"), JointsFrom::line);
  EXPECT_EQ(from(moves + "def m():\n" + of.line(of.meant) + "end\n"), JointsFrom::undetermined);
  EXPECT_EQ(from("def m():\n" + moves + of.line(of.meant) + "end\n"), JointsFrom::undetermined);
  EXPECT_EQ(from(moves + "def m():\n" + known + "f()\n" + of.line(of.meant) + "end\n"), JointsFrom::undetermined);
  EXPECT_EQ(from(waits + "def m():\n" + known + "f()\n" + of.line(of.meant) + "end\n"), JointsFrom::line);
}

TEST(Configuration, IsKeptAlongAStraightLineHoweverNearAnotherIs) {
  const Configured of;
  RandomStream stream{7507};
  int followed = 0;
  for (int i = 0; i < 30; ++i) {
    const JointVector from = regular_joints(stream, of.model.nominal.chain), to = from + random_change(stream, 6, 0.4);
    const auto end = joints_after_line(of.model.nominal.chain, from, of.model.nominal_tool(to));
    if (!end || (*end - to).norm() > 1e-6) continue;
    ++followed;
    const CorrectedProgram corrected = of.correct(joints_line(WrittenIn::urscript, from, 1, 9) + '\n' + of.line(to));
    EXPECT_LT((corrected.targets[1].nominal - to).norm(), 1e-5);
  }
  EXPECT_GT(followed, 15);
}

TEST(Branches, AreAllThatAnElbowArmWithAWristHas) {
  RandomStream stream{7508};
  const Chain arm = elbow_arm(stream).chain;
  JointVector joints(6);
  joints << 0.4, -0.7, 0.5, 0.3, 0.9, -0.2;
  const Eigen::Isometry3d tool = forward(arm, joints) * Eigen::Translation3d(arm.tool_m);
  const std::vector<JointVector> all = joints_reaching(arm, tool, joints);
  EXPECT_EQ(all.size(), 8u);
  for (const JointVector& branch : all) {
    EXPECT_TRUE((forward(arm, branch) * Eigen::Translation3d(arm.tool_m)).isApprox(tool, 1e-8));
  }
}

TEST(SingularWrist, KeepsItsJoints) {
  RandomStream stream{7509};
  for (int i = 0; i < 10; ++i) {
    const CommandModel model = erring_model(stream, elbow_arm(stream));
    JointVector joints(6);
    joints << 0.4, -0.7, 0.5, 0.0, stream.real(-1e-3, 1e-3), 0.0;
    const std::string text = joints_line(WrittenIn::urscript, joints, 1, 9);
    const CorrectedProgram corrected =
        correct_program(text, read_program(WrittenIn::urscript, text, "p", model.nominal.chain), model, {});
    EXPECT_LT((corrected.targets[0].command - joints).cwiseAbs().maxCoeff(), radians(3.0));
    EXPECT_LT(corrected.targets[0].residual_m, 1e-5);
  }
}

}  // namespace
}  // namespace demecal

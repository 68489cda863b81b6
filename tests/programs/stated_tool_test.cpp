// A tool that a program or its user states: the measured one where it stands near it, otherwise another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// An arm whose file has no tool, measured with one; sure of its tool and of one link.
struct ToollessFile {
  RandomStream stream{7601};
  Eigen::Vector3d measured_m{0.0204, 0.0297, 0.1203};
  CommandModel model = [this] {
    Robot nominal = elbow_arm(stream);
    nominal.chain.tool_m.setZero();
    CorrectedRobot identified = random_robot(stream, nominal.chain, 1e-3, 2e-3);
    identified.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(measured_m));
    Posterior posterior;
    posterior.ids = {{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta},
                     {.kind = ParameterId::Kind::tool_translation, .index = 0}};
    posterior.factor = 1e-6 * Eigen::MatrixXd::Identity(2, 2);
    return with_posterior(unbounded_model(nominal, identified), identified, posterior, {}, false);
  }();
  JointVector joints = regular_joints(stream, model.nominal.chain);

  CorrectedProgram corrected(const std::string& tool_line, const CommandModel& by) const {
    const std::string text = tool_line + joints_line(WrittenIn::urscript, joints, 1, 6);
    return correct_program(text, read_program(WrittenIn::urscript, text, "p", by.nominal.chain), by,
                           {.temperature_celsius = 20.0, .own_tool = &by});
  }
  /// How far the measured tool then is from where the program has its own, m.
  double left_m(const CorrectedProgram& program, const Eigen::Vector3d& tool_m) const {
    const Eigen::Vector3d meant_m = forward(model.nominal.chain, joints) * tool_m;
    CorrectedRobot real = model.robot;
    real.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(measured_m));
    return (real.predict(Stop(program.targets[0].command), "").translation() - meant_m).norm();
  }
  static std::string said(const CorrectedProgram& program) {
    std::string said;
    for (const Remark& warning : program.warnings) said += warning.sentence + '\n';
    return said;
  }
};

TEST(StatedTool, IsTheMeasuredOneWhereItStandsThereThoughTheFileHasNone) {
  const ToollessFile arm;
  const CorrectedProgram stated = arm.corrected("set_tcp(p[0.02,0.03,0.12,0,0,0])\n", arm.model);
  EXPECT_LT(arm.left_m(stated, {0.02, 0.03, 0.12}), 1e-6);
  EXPECT_THAT(ToollessFile::said(stated), Not(HasSubstr("tool")));
  const CommandModel given = with_stated_tool(arm.model, {0.02, 0.03, 0.12});
  EXPECT_LT(arm.left_m(arm.corrected("", given), {0.02, 0.03, 0.12}), 1e-6);
  EXPECT_EQ(given.posterior->ids.size(), 2u);
}

TEST(StatedTool, IsAnotherElsewhere) {
  const ToollessFile arm;
  const CorrectedProgram stated = arm.corrected("set_tcp(p[0.02,0.03,0.13,0,0,0])\n", arm.model);
  EXPECT_GT(arm.left_m(stated, {0.02, 0.03, 0.13}), 5e-3) << "the tool at 120 mm is none of this program's";
  const CommandModel other = with_stated_tool(arm.model, {0.02, 0.03, 0.13});
  EXPECT_EQ(other.posterior->ids.size(), 1u);
  EXPECT_TRUE(other.robot.tool("").isApprox(Eigen::Isometry3d(Eigen::Translation3d(0.02, 0.03, 0.13))));
}

TEST(StatedTool, SaysWhereItIsTakenForOneThatStandsMoreThanAMillimetreOff) {
  const ToollessFile arm;
  EXPECT_THAT(ToollessFile::said(arm.corrected("set_tcp(p[0.02,0.03,0.122,0,0,0])\n", arm.model)),
              HasSubstr("the tool at 20.0 30.0 122.0 mm is taken for the measured one, 1.77 mm from it"));
}

TEST(StatedTool, WhereNoneIsStatedTheFilesOneIsTakenAndTheOtherNamed) {
  const ToollessFile arm;
  EXPECT_THAT(ToollessFile::said(arm.corrected("", arm.model)), HasSubstr("--tool-mm 20.4 29.7 120.3 says that it is"));
}

}  // namespace
}  // namespace demecal

// The whole turns that FANUC's configurations state: a pose is reached in them, and the arm comes to it from their
// side.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/units.hpp"
#include "languages/written_program.hpp"
#include "named_motions.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

JointVector turned_joints(std::size_t joint, double angle_deg) {
  JointVector joints(6);
  joints << 0.4, -0.7, 0.5, 0.3, 0.9, 0.2;
  joints[static_cast<Eigen::Index>(joint)] = radians(angle_deg);
  return joints;
}

/// A pose with such a configuration behind joints from which `joint` has the shortest way to -160 degrees.
CorrectedProgram behind_turn(const CommandModel& model, std::size_t joint, const std::string& words) {
  const JointVector meant = turned_joints(joint, -160.0);
  const Eigen::Isometry3d pose = model.nominal_tool(meant);
  const std::string text = "/PROG  T\n/MN\n   1:J P[1] 9% FINE ;\n   2:J P[2] 9% FINE ;\n/POS\n" +
                           joints_line(WrittenIn::fanuc_ls, turned_joints(joint, -150.0), 1, 9) + '\n' +
                           fanuc_position("2", " CONFIG : '" + words + "',", {"X", "Y", "Z", "W", "P", "R"},
                                          six_numbers(pose, about_fixed_xyz(pose)), 9) +
                           "\n/END\n";
  return correct_program(text, read_program(WrittenIn::fanuc_ls, text, "p", model.nominal.chain), model,
                         {.temperature_celsius = 20.0});
}

CommandModel with_limits(double limit_deg) {
  CommandModel model = lost_motion_model();
  for (Joint& joint : model.nominal.chain.joints) {
    joint.lower = -radians(limit_deg);
    joint.upper = radians(limit_deg);
  }
  return model;
}

TEST(StatedTurns, AreThoseThatAPoseIsReachedIn) {
  const CommandModel model = with_limits(360.0);
  for (const auto& [joint, zero, one] : {std::tuple{0u, "N U T, 0, 0, 0", "N U T, 1, 0, 0"},
                                         {3u, "N U T, 0, 0, 0", "N U T, 0, 1, 0"},
                                         {5u, "N U T, 0, 0, 0", "N U T, 0, 0, 1"}}) {
    const auto index = static_cast<Eigen::Index>(joint);
    const CorrectedTarget near = behind_turn(model, joint, zero).targets.at(1);
    const CorrectedTarget far = behind_turn(model, joint, one).targets.at(1);
    EXPECT_NEAR(degrees(near.nominal[index]), -160.0, 1e-5);
    EXPECT_EQ(near.stop.approach[index], -1.0);
    EXPECT_NEAR(degrees(far.nominal[index]), 200.0, 1e-5);
    EXPECT_EQ(far.stop.approach[index], 1.0);
  }
}

TEST(StatedTurns, ThatAreOutsideTheLimitsAreSaid) {
  const CorrectedProgram corrected = behind_turn(with_limits(180.0), 5, "N U T, 0, 0, 1");
  std::string said;
  for (const Remark& warning : corrected.warnings) said += warning.sentence + '\n';
  EXPECT_THAT(said, HasSubstr("joint 6 is sent to 200.0000 deg, outside its limits -180.0000 deg .. 180.0000 deg"));
}

}  // namespace
}  // namespace demecal

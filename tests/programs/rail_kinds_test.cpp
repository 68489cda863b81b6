// Arms on rails where a language or a table has its own way to say where the rail stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "languages/languages.hpp"
#include "rail_cell.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(RailKinds, OfAYaskawaJobCarriesItsRobotFrameAlong) {
  const RailCell cell = rail_cell(16, 1);
  const JointVector joints = cell.arm_joints(0);
  const Eigen::Isometry3d on_robot = forward(cell.arm.chain, joints) * Eigen::Translation3d(cell.arm.chain.tool_m);
  const std::string text = "//POS\n///POSTYPE ROBOT\n///RECTAN\n" +
                           pose_line(WrittenIn::yaskawa_jbi, on_robot, joints, 1, 7) +
                           "\nBC00001=" + rail_text(cell, 0) + "\n//INST\nNOP\nMOVL C00001 BC00001 V=50.0\nEND\n";
  const CorrectedProgram corrected = corrected_on_rail(WrittenIn::yaskawa_jbi, cell, text);
  ASSERT_EQ(corrected.targets.size(), 1u);
  EXPECT_LT((corrected.targets[0].nominal - cell.meant[0]).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(corrected.targets[0].outcome, CorrectionOutcome::corrected);
  const auto left = [&](const std::string& motion) {
    const std::string other = text.substr(0, text.find("MOVL")) + motion + "\nEND\n";
    const Program program = read_program(WrittenIn::yaskawa_jbi, other, "p", cell.model.nominal.chain);
    return program.targets.empty() && !program.uncorrected.empty();
  };
  EXPECT_TRUE(left("MOVL C00001 V=50.0")) << "where the rail stands then is not said";
  EXPECT_TRUE(left("MOVL C00001 BC00001 V=50.0\nMOVL C00001 BC00007 V=50.0"));
  EXPECT_FALSE(left("MOVL C00001 BC00001 V=50.0\nMOVJ C00001 BC00001 VJ=50.0"));
}

TEST(RailKinds, OfAYaskawaJobInPulsesCountsThoseOfAMillimetre) {
  const RailCell cell = rail_cell(17, 1);
  ControllerData controller;
  controller.pulses_per_deg = {100.0, 1000.0, 1000.0, 900.0, 800.0, 700.0, 500.0};
  const std::string text =
      "//POS\n///POSTYPE PULSE\n///PULSE\nC00001=1000,2000,900,800,35000,500\nBC00001=45000\n//INST\nNOP\n"
      "MOVJ C00001 BC00001 VJ=5.0\nEND\n";
  const ProgramSource source(text, "p.jbi");
  const Program program = read_program(*find_language("yaskawa_jbi"), source, cell.model.nominal.chain, controller);
  ASSERT_EQ(program.targets.size(), 1u);
  const JointVector joints = stated_joints(program.targets[0]);
  EXPECT_NEAR(joints[0], 0.45, 1e-12);
  EXPECT_NEAR(degrees(joints[1]), 1.0, 1e-12);
  EXPECT_NEAR(degrees(joints[6]), 1.0, 1e-12);
  EXPECT_TRUE(read_program(WrittenIn::yaskawa_jbi, text, "p", cell.model.nominal.chain).targets.empty())
      << "what a pulse is, is not known";
}

TEST(RailKinds, StandsBesideThePosesOfATable) {
  const RailCell cell = rail_cell(18, 5);
  const std::string header = "x_mm,y_mm,z_mm,qw,qx,qy,qz";
  std::string rows;
  for (std::size_t i = 0; i < cell.meant.size(); ++i) {
    const Eigen::Isometry3d pose = believed(cell, cell.meant[i]);
    const Eigen::Quaterniond turn(pose.linear());
    rows += listed(std::vector<double>{1e3 * pose.translation().x(), 1e3 * pose.translation().y(),
                                       1e3 * pose.translation().z(), turn.w(), turn.x(), turn.y(), turn.z()},
                   9, ",") +
            ',' + rail_text(cell, i) + '\n';
  }
  const std::string text = header + ",q1_mm\n" + rows;
  const CorrectedProgram corrected = corrected_on_rail(WrittenIn::csv, cell, text);
  ASSERT_EQ(corrected.targets.size(), cell.meant.size());
  for (std::size_t i = 0; i < cell.meant.size(); ++i) {
    EXPECT_LT((corrected.targets[i].nominal - cell.meant[i]).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(corrected.targets[i].command[0], corrected.targets[i].nominal[0]) << "the rail stands still";
  }
  for (const double miss : misses_m(WrittenIn::csv, cell, text)) EXPECT_GT(miss, 2e-4);
  for (const double miss : misses_m(WrittenIn::csv, cell, corrected.text)) EXPECT_LT(miss, 2e-8);
  try {
    read_program(WrittenIn::csv, header + ",speed\n" + rows, "p.csv", cell.model.nominal.chain);
    FAIL() << "where the rail stands is not told";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("add q1_mm"));
  }
}

TEST(RailKinds, IsTheSeventhNumberOfKawasakisJointsAndLeavesItsPoses) {
  const RailCell cell = rail_cell(19, 1);
  const std::string text =
      ".PROGRAM m()\nJMOVE #a\nLMOVE b\n.END\n.JOINTS\n#a 10 20 30 40 50 60 450.5\n.END\n.TRANS\nb 1 2 3 4 5 6 450.5\n"
      ".END\n";
  const Program program = read_program(WrittenIn::kawasaki_as, text, "p", cell.model.nominal.chain);
  ASSERT_EQ(program.targets.size(), 2u);
  EXPECT_NEAR(stated_joints(program.targets[0])[0], 0.4505, 1e-12);
  EXPECT_NEAR(degrees(stated_joints(program.targets[0])[6]), 60.0, 1e-12);
  EXPECT_THAT(program.targets[1].frames.unknown_frame, HasSubstr("a rail carries the arm"));
}

}  // namespace
}  // namespace demecal

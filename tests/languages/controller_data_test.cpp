// Frames, tools and pulses that programs only name come from the controller's data, where the program gives none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/angles.hpp"
#include "kinematics/random_arm.hpp"
#include "kinematics/units.hpp"
#include "languages/reading_checks.hpp"
#include "languages/written_program.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// A program in which one target names a frame and a tool, and by what keys they are kept.
struct NamingProgram {
  WrittenIn language;
  std::string text, frame, tool;
};

const std::vector<NamingProgram>& naming_programs() {
  static const std::vector<NamingProgram> programs{
      {WrittenIn::krl, "BAS(#TOOL,3)\nBAS(#BASE,2)\nLIN {X 1,Y 2,Z 3,A 4,B 5,C 6}\n", "2", "3"},
      {WrittenIn::rapid, "MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v100,z10,Grip\\WObj:=Table;\n", "table",
       "grip"},
      {WrittenIn::fanuc_ls,
       "/PROG  A\n/POS\nP[1]{\n GP1:\n UF : 2, UT : 3, CONFIG : 'N U T, 0, 0, 0',\n X = 1 mm, Y = 2 mm, Z = 3 mm,\n "
       "W = 4 deg, P = 5 deg, R = 6 deg\n};\n/END\n",
       "2", "3"},
      {WrittenIn::yaskawa_jbi,
       "//POS\n///TOOL 3\n///USER 2\n///POSTYPE USER\n///RECTAN\nC00001=1,2,3,4,5,6\n//INST\nMOVL C00001\n", "2", "3"},
      {WrittenIn::val3,
       "<Data name=\"p\" type=\"pointRx\"><Value x=\"1\" y=\"2\" z=\"3\" rx=\"4\" ry=\"5\" rz=\"6\" "
       "fatherId=\"fTable[0]\"/></Data>",
       "ftable[0]", ""},
      {WrittenIn::urscript, "movej(get_inverse_kin(pose_trans(Plane_1, p[0.1,0.2,0.3,0,0,0])))\n", "plane_1", ""}};
  return programs;
}

Program read_with(const NamingProgram& naming, const ControllerData& controller) {
  const ProgramSource source(naming.text, "p");
  return read_program(row_of(naming.language), source, wrist_arm(), controller);
}

TEST(ControllerData, GivesTheFramesAndToolsThatProgramsName) {
  RandomStream stream{7701};
  for (const NamingProgram& naming : naming_programs()) {
    SCOPED_TRACE(to_string(naming.language));
    const Eigen::Isometry3d frame = random_place(stream), tool = random_place(stream);
    ControllerData controller{.frames = {{naming.frame, frame}}, .tools = {{naming.tool, tool}}};
    const StatedFrames stated = read_with(naming, controller).targets.at(0).frames;
    EXPECT_EQ(stated.unknown_frame, "");
    EXPECT_TRUE(stated.base_from_frame.isApprox(frame, 1e-12));
    EXPECT_EQ(stated.unknown_tool, "");
    if (!naming.tool.empty()) {
      EXPECT_TRUE(stated.tool && stated.tool->isApprox(tool, 1e-12));
    }
    controller = {.frames = {{"9", frame}}, .tools = {{"9", tool}}};
    const StatedFrames others = read_with(naming, controller).targets.at(0).frames;
    EXPECT_THAT(others.unknown_frame, HasSubstr("is given neither in this program nor by --frames"));
    if (!naming.tool.empty()) {
      EXPECT_THAT(others.unknown_tool, HasSubstr("neither in this program"));
    }
  }
}

TEST(ControllerData, GivesWayToNumbersOfTheProgram) {
  const NamingProgram naming{WrittenIn::krl,
                             "TOOL_DATA[1]={X 7,Y 0,Z 0,A 0,B 0,C 0}\nBAS(#TOOL,1)\nBAS(#BASE,n)\n"
                             "LIN {X 1,Y 2,Z 3,A 4,B 5,C 6}\n",
                             "1", "1"};
  const ControllerData controller{.frames = {{"1", Eigen::Isometry3d::Identity()}},
                                  .tools = {{"1", Eigen::Isometry3d::Identity()}}};
  const StatedFrames stated = read_with(naming, controller).targets.at(0).frames;
  EXPECT_DOUBLE_EQ(stated.tool->translation().x(), 0.007);
  EXPECT_THAT(stated.unknown_frame, HasSubstr("is computed")) << "a number that is not written is none that is kept";
}

TEST(ControllerData, GivesTheToolsOfNamedLocations) {
  const Eigen::Isometry3d tool(Eigen::Translation3d(0, 0, 0.2));
  const ControllerData controller{.frames = {}, .tools = {{"gun", tool}}};
  const std::string as = ".PROGRAM a()\n TOOL gun\n LMOVE p\n.END\n.TRANS\np 1 2 3 4 5 6\n";
  const std::string val2 = ".PROGRAM a\n TOOL GUN\n MOVE p\n.END\n.LOCATIONS\np 1 0 0 0 1 0 0 0 1 10 20 30\n";
  for (const NamingProgram& naming :
       {NamingProgram{WrittenIn::kawasaki_as, as, "", ""}, NamingProgram{WrittenIn::val2, val2, "", ""}}) {
    SCOPED_TRACE(to_string(naming.language));
    EXPECT_NE(read_with(naming, {}).targets.at(0).frames.unknown_tool, "");
    const StatedFrames stated = read_with(naming, controller).targets.at(0).frames;
    EXPECT_EQ(stated.unknown_tool, "");
    EXPECT_TRUE(stated.tool && stated.tool->isApprox(tool, 1e-12));
  }
  const NamingProgram own{WrittenIn::kawasaki_as, as + "gun 0 0 150 0 0 0\n.END\n", "", ""};
  EXPECT_DOUBLE_EQ(read_with(own, controller).targets.at(0).frames.tool->translation().z(), 0.15);
}

TEST(ControllerData, TellsWhatPulsesAre) {
  RandomStream stream{7702};
  for (int repetition = 0; repetition < 20; ++repetition) {
    ControllerData controller;
    std::vector<double> pulses;
    JointVector joints = random_joints(stream, wrist_arm());
    for (Eigen::Index joint = 0; joint < 6; ++joint) {
      controller.pulses_per_deg.push_back(stream.real(500.0, 2000.0) * (stream.chance(0.2) ? -1.0 : 1.0));
      pulses.push_back(std::round(degrees(joints[joint]) * controller.pulses_per_deg.back()));
      joints[joint] = radians(pulses.back() / controller.pulses_per_deg.back());
    }
    const NamingProgram naming{WrittenIn::yaskawa_jbi,
                               "//POS\n///POSTYPE PULSE\n///PULSE\nC00001=" + listed(pulses, 0, ",") +
                                   "\nBC00001=7\n//INST\nMOVJ C00001 VJ=5\n",
                               "", ""};
    const Target target = read_with(naming, controller).targets.at(0);
    ASSERT_EQ(target.joints.size(), 6u);
    for (std::size_t joint = 0; joint < 6; ++joint) {
      const Cell& cell = target.joints[joint];
      EXPECT_NEAR(cell.inside(), joints[static_cast<Eigen::Index>(joint)], 1e-12);
      EXPECT_EQ(rewritten(cell, cell.inside()), std::nullopt);
      const double step = std::abs(cell.unit);
      EXPECT_EQ(rewritten(cell, cell.inside() + 0.4 * step), std::nullopt) << "less than half a pulse";
      EXPECT_EQ(rewritten(cell, (cell.value + 3.0) * cell.unit), std::to_string(std::lround(cell.value + 3.0)));
    }
    EXPECT_TRUE(read_with(naming, {}).targets.empty());
    EXPECT_THAT(read_with(naming, {}).uncorrected.at(0).sentence, HasSubstr("--pulses-per-deg"));
  }
}

}  // namespace
}  // namespace demecal

// Files as the controllers of FANUC, Yaskawa, Kawasaki and Staubli write them: what is a target, in which frame, what
// is left as it is and why, and where faults are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/angles.hpp"
#include "kinematics/units.hpp"
#include "languages/reading_checks.hpp"
#include "parsed_programs/orientation.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

Program read_file_of(WrittenIn language, const std::string& text) {
  return read_program(language, text, "p", wrist_arm());
}

std::vector<std::string> sentences(const Program& program) {
  std::vector<std::string> found;
  for (const Remark& remark : program.uncorrected) found.push_back(remark.name + ": " + remark.sentence);
  return found;
}

std::string fanuc_pose(const std::string& head) {
  return "P[1]{\n   GP1:\n\t" + head +
         "\n\tX =   500.000  mm,\tY =   -20.500  mm,\tZ =      .250  mm,\n\tW =  -180.000 deg,\tP =     -.384 deg,\tR "
         "=    90.000 "
         "deg\n};\n";
}

TEST(FanucLs, ReadsJointAndCartesianPositionsOfTheFirstGroup) {
  const Program program =
      read_file_of(WrittenIn::fanuc_ls,
                   "/PROG  A\r\n/ATTR\r\nCOMMENT\t= \"P[9]{\";\r\n/MN\r\n   1:J P[2:up] 100% FINE    ;\r\n   2:L P[1] "
                   "200mm/sec CNT100 ;\r\n"
                   "/POS\r\nP[1]{\r\n   GP1:\r\n\tUF : 0, UT : 0,\t\tCONFIG : 'N U T, 0, 0, -1',\r\n\tX =   500.000  "
                   "mm,\tY =  -20.500  "
                   "mm,\tZ =   .250  mm,\r\n\tW =  -180.000 deg,\tP =  -.384 deg,\tR =  90.000 deg,\r\n\tE1=  12.000 "
                   "deg\r\n   GP2:\r\n\tUF : "
                   "0, UT : 2,\r\n\tJ1=   100.000  mm\r\n};\r\nP[2:\"up\"]{\r\n   GP1:\r\n\tUF : 0, UT : 0,\r\n\tJ1=  "
                   "1.000 deg,\tJ2=  -2.000 "
                   "deg,\tJ3=  3.000 deg,\r\n\tJ4=  .500 deg,\tJ5=  -90.000 deg,\tJ6=  6.000 deg\r\n};\r\n/END\r\n");
  EXPECT_THAT(names(program), ElementsAre("P[1]", "P[2]"));
  const Target &pose = program.targets[0], &joints = program.targets[1];
  EXPECT_THAT(values(pose.position), ElementsAre(500, -20.5, 0.25));
  EXPECT_THAT(values(pose.orientation), ElementsAre(-180, -0.384, 90));
  EXPECT_EQ(pose.hint.configuration, "NUT,0,0,-1");
  EXPECT_EQ(pose.motion, Motion::line);
  EXPECT_TRUE(pose.frames.tool->isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(pose.frames.unknown_frame, "");
  EXPECT_THAT(values(joints.joints), ElementsAre(1, -2, 3, 0.5, -90, 6));
  EXPECT_EQ(joints.motion, Motion::joints);
  EXPECT_LT(joints.order, pose.order);
  EXPECT_THAT(program.uncorrected, SizeIs(0));
}

TEST(FanucLs, TurnsAboutAxesThatStay) {
  const Program program = read_file_of(WrittenIn::fanuc_ls, "/POS\n" + fanuc_pose("UF : 0,"));
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(radians(90.0), Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(radians(-0.384), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(radians(-180.0), Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  EXPECT_TRUE(stated_tool_pose(program.targets.at(0)).linear().isApprox(turn, 1e-12));
}

TEST(FanucLs, SaysWhatFramesAndToolsTheFileDoesNotGive) {
  const auto frames = [](const std::string& head) {
    return read_file_of(WrittenIn::fanuc_ls, "/POS\n" + fanuc_pose(head)).targets.at(0).frames;
  };
  EXPECT_EQ(frames("UF : 3, UT : 0,").unknown_frame, "UF 3 is given neither in this program nor by --frames");
  EXPECT_EQ(frames("UF : 0, UT : 2,").unknown_tool, "UT 2 is given neither in this program nor by --frames");
  EXPECT_EQ(frames("UF : F, UT : F,").unknown_frame, "UF is computed when the program runs");
  EXPECT_THAT(frames("UF : 0, UT : 1,\n\tE1=  3175.000  mm,").unknown_frame, HasSubstr("may carry the arm"));
  EXPECT_EQ(frames("UF : 0, UT : 1,\n\tE1=  0.000  mm,\tE2= 30.000 deg,").unknown_frame, "");
}

TEST(FanucLs, LeavesWhatIsNoPlaceToGoTo) {
  const auto left = [](const std::string& motion, const std::string& position) {
    return sentences(read_file_of(WrittenIn::fanuc_ls, "/MN\n   1:" + motion + " ;\n/POS\n" + position));
  };
  const std::string pose = fanuc_pose("UF : 0, UT : 0,");
  EXPECT_THAT(left("L P[1] 100mm/sec FINE", pose), SizeIs(0));
  EXPECT_THAT(left("!L P[1] 100mm/sec FINE INC", pose), SizeIs(0));
  EXPECT_THAT(left("L P[1] 100mm/sec FINE INC", pose), ElementsAre(HasSubstr("P[1]: a motion goes by it")));
  EXPECT_THAT(left("L P[1] 100mm/sec FINE Offset,PR[2]", pose), ElementsAre(HasSubstr("register or an offset")));
  EXPECT_THAT(left("L P[R[3]] 100mm/sec FINE Tool_Offset", pose), ElementsAre(HasSubstr("a motion may go by it")));
  EXPECT_THAT(left("J PR[1:home] 100% FINE", pose), ElementsAre(HasSubstr("the motion goes to a register")));
  EXPECT_THAT(left("C P[7]\n    :  P[1] 100mm/sec FINE INC", pose),
              ElementsAre(HasSubstr("a motion goes by it"), HasSubstr("P[7]: it is not given in this file")));
  EXPECT_THAT(left("L P[1] 1mm/sec FINE",
                   "P[1]{\n GP1:\n X = ******** mm, Y = 1 mm, Z = 1 mm, W = 1 deg, P = 1 deg, R = 1 deg\n};"),
              ElementsAre(HasSubstr("it is not taught")));
  EXPECT_THAT(left("L P[1] 1mm/sec FINE", "P[1]{\n GP1:\n J1= 1 deg, J2= 2 deg\n};"),
              ElementsAre(HasSubstr("names neither J1 to J6 nor X")));
  EXPECT_THAT(
      left("L P[1] 1mm/sec FINE", "P[1]{\n GP1:\n J1= 1 mm, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 5 deg, J6= 6 deg\n};"),
      ElementsAre(HasSubstr("not in mm and deg")));
}

TEST(FanucLs, NamesTheFault) {
  expect_fault(WrittenIn::fanuc_ls, "/POS\nP[1]{\n GP1:\n", 2, "never closed");
  expect_fault(WrittenIn::fanuc_ls, "/POS\nP[x]{ };\n", 2, "must be the number of a position");
  expect_fault(WrittenIn::fanuc_ls,
               "/POS\nP[1]{\n GP1:\n J1= 1 deg, J2= 2..0 deg, J3= 3 deg, J4= 4 deg, J5= 5 deg, J6= 6 deg\n};\n", 4,
               "'2..0': must be a number (column 17)");
}

TEST(YaskawaJbi, ReadsCartesianPositionsThatMotionsGoTo) {
  const Program program = read_file_of(
      WrittenIn::yaskawa_jbi,
      "/JOB\r\n//NAME A\r\n//POS\r\n///NPOS 3,0,1,1,0,0\r\n///TOOL 2\r\n///POSTYPE ROBOT\r\n///RECTAN\r\n///RCONF "
      "1,0,0,0,0,0,0,0\r\nC00000=500.000,-20.500,300.000,180.0000,0.0000,-90.0000\r\nC00001=1.000,2.000,3.000,4.00,5."
      "00,6.00\r\n"
      "EC00000=7\r\nP00012=1,2,3,4,5,6\r\n//INST\r\n///DATE 2024/01/01 12:00\r\n///GROUP1 RB1\r\nNOP\r\n'MOVL "
      "C00009\r\nMOVJ C0000 "
      "VJ=10.00\r\nMOVL P012 V=50.0 +MOVJ EC00000\r\nEND\r\n");
  EXPECT_THAT(names(program), ElementsAre("C00000", "C00001", "P00012"));
  const Target& first = program.targets[0];
  EXPECT_THAT(values(first.position), ElementsAre(500, -20.5, 300));
  EXPECT_THAT(values(first.orientation), ElementsAre(180, 0, -90));
  EXPECT_EQ(first.orientation[0].decimals, 4);
  EXPECT_EQ(program.targets[1].orientation[0].decimals, 2);
  EXPECT_EQ(first.hint.configuration, "1,0,0,0,0,0,0,0");
  EXPECT_EQ(first.frames.unknown_frame, "");
  EXPECT_EQ(first.frames.unknown_tool, "tool 2 is given neither in this program nor by --frames");
  EXPECT_EQ(first.motion, Motion::joints);
  EXPECT_EQ(program.targets[2].motion, Motion::line);
}

TEST(YaskawaJbi, LeavesPulsesAndWhatIsNoPlaceToGoTo) {
  const auto left = [](const std::string& headings, const std::string& position, const std::string& instructions) {
    return sentences(read_file_of(WrittenIn::yaskawa_jbi, "//POS\n" + headings + position +
                                                              "1,2,3,4,5,6\n//INST\nNOP\n" + instructions + "END\n"));
  };
  const std::string cartesian = "///POSTYPE BASE\n///RECTAN\n";
  EXPECT_THAT(left(cartesian, "C00001=", "MOVL C00001 V=5\n"), SizeIs(0));
  EXPECT_THAT(left("///POSTYPE PULSE\n///PULSE\n", "C00001=", "MOVL C00001 V=5\n"),
              ElementsAre(HasSubstr("C00001: it is in pulses")));
  EXPECT_THAT(left(cartesian, "P001=", "IMOV P001 V=5\n"), ElementsAre(HasSubstr("used by imov")));
  EXPECT_THAT(left(cartesian, "P001=", "SET P001 P002\nMOVL P001\n"), ElementsAre(HasSubstr("used by set")));
  EXPECT_THAT(left(cartesian, "P001=", ""), ElementsAre(HasSubstr("no motion of this job goes to it")));
  EXPECT_THAT(left(cartesian, "C00001=", "SFTON P005\nMOVL C00001\nSFTOF\n"),
              ElementsAre(HasSubstr("while a shift is on")));
  EXPECT_THAT(left(cartesian, "C00001=", "SFTON P005\nSFTOF\nMOVL C00001\n"), SizeIs(0));
  EXPECT_THAT(left(cartesian, "C00001=", "SMOVL C00001\n"), ElementsAre(HasSubstr("frame of a station")));
  EXPECT_THAT(left(cartesian, "C00001=", "MOVL C00001\nMOVJ P007 VJ=1\n"),
              ElementsAre(HasSubstr("P7: it is not given in this file")));
  EXPECT_THAT(left(cartesian, "C00001=7,", "MOVL C00001\n"), ElementsAre(HasSubstr("has 7 numbers")));
  EXPECT_THAT(left(cartesian, "C00001=", "///GROUP2 RB2\nMOVL C00001\n"), ElementsAre(HasSubstr("several robots")));
}

TEST(YaskawaJbi, SaysWhatFramesTheFileDoesNotGiveAndNamesTheFault) {
  const auto frame = [](const std::string& headings) {
    return read_file_of(WrittenIn::yaskawa_jbi, "//POS\n" + headings + "C00001=1,2,3,4,5,6\n")
        .targets.at(0)
        .frames.unknown_frame;
  };
  EXPECT_EQ(frame("///USER 3\n///POSTYPE USER\n///RECTAN\n"),
            "user frame 3 is given neither in this program nor by --frames");
  EXPECT_EQ(frame("///POSTYPE TOOL\n///RECTAN\n"), "frame tool is not given in this file");
  EXPECT_EQ(frame("BC00000=1\n///POSTYPE BASE\n///RECTAN\n"), "base axes carry the arm");
  EXPECT_EQ(frame("BC00000=1\n///POSTYPE ROBOT\n///RECTAN\n"), "");
  expect_fault(WrittenIn::yaskawa_jbi, "//POS\n///RECTAN\nC00001=1,2,x3,4,5,6\n", 3,
               "'x3': must be a number (column 12)");
  expect_fault(WrittenIn::yaskawa_jbi, "//POS\n///RECTAN\nC00001 1,2\n", 3, "must be a position, NAME=NUMBERS");
}

TEST(KawasakiAs, ReadsLocationsOfBothSectionsAndThoseInStatements) {
  const Program program = read_file_of(
      WrittenIn::kawasaki_as,
      ".*=== a comment\n.PROGRAM a()\n  JMOVE #home ; JMOVE TRANS(9,9,9,9,9,9)\n 10 LMOVE pick[1]\n  LAPPRO "
      "TRANS(1,2,3,4,5,6), 50\n"
      "  POINT put = TRANS(7,8,9,1,2,3)\n  LMOVE put\n  JMOVE #PPOINT(1,2,3,4,5,6)\n  LMOVE SHIFT(pick[1] BY 0,0,100)\n"
      "  LMOVE TRANS(x,2,3,4,5,6)\n.END\n.TRANS\npick[1]  500.000 -20.500 300.000 10.0 20.0 30.0 77.0\n.END\n.JOINTS\n"
      "#home 0.000 1.5 -90 0 5 6\n.END\n.REALS\nspeed = 3\n.END\n");
  EXPECT_THAT(names(program), ElementsAre("", "put", "", "pick[1]", "#home"));
  EXPECT_THAT(values(program.targets[3].position), ElementsAre(500, -20.5, 300));
  EXPECT_EQ(program.targets[3].motion, Motion::line);
  EXPECT_THAT(values(program.targets[2].joints), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values(program.targets[4].joints), ElementsAre(0, 1.5, -90, 0, 5, 6));
  EXPECT_LT(program.targets[4].order, program.targets[3].order);
  EXPECT_THAT(sentences(program),
              ElementsAre(HasSubstr("'x' is no number"), HasSubstr("'SHIFT(pick[1] BY 0,0,100)' is computed")));
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(radians(10.0), Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(radians(20.0), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(radians(30.0), Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  EXPECT_TRUE(stated_tool_pose(program.targets[3]).linear().isApprox(turn, 1e-12));
}

TEST(KawasakiAs, TakesToolsAndSaysWhatItCannotFollow) {
  const std::string points = ".END\n.TRANS\np 10 20 30 1 2 3\nt 0 0 150 0 0 0\n.END\n";
  const auto read = [&](const std::string& statement) {
    return read_file_of(WrittenIn::kawasaki_as, ".PROGRAM a()\n" + statement + "\n LMOVE p\n" + points);
  };
  EXPECT_THAT(names(read("")), ElementsAre("p", "t"));
  EXPECT_THAT(names(read(" TOOL t")), ElementsAre("p"));
  EXPECT_DOUBLE_EQ(read(" TOOL t").targets[0].frames.tool->translation().z(), 0.15);
  EXPECT_THAT(read(" TOOL u").targets[0].frames.unknown_tool, HasSubstr("TOOL is computed"));
  EXPECT_TRUE(read(" TOOL t\n TOOL NULL").targets[0].frames.tool->isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(read(" BASE NULL").targets[0].frames.unknown_frame, "");
  EXPECT_THAT(read(" BASE b").targets[0].frames.unknown_frame, HasSubstr("the base is moved by BASE, and --frames"));
  EXPECT_THAT(read_file_of(WrittenIn::kawasaki_as, ".SYSDATA\nBASE 0 0 1.5 0 0 0\n.END\n" + points)
                  .targets[0]
                  .frames.unknown_frame,
              HasSubstr("the base is moved by BASE, and --frames"));
  EXPECT_THAT(sentences(read(" LMOVE t+p")),
              ElementsAre(HasSubstr("'t+p' is computed"), HasSubstr("sum of transformations"), HasSubstr("t: ")));
  EXPECT_THAT(sentences(read(" POINT p = HERE")), ElementsAre(HasSubstr("p: it is computed")));
  EXPECT_THAT(sentences(read(" LEFTY")), ElementsAre(HasSubstr("(lefty)"), HasSubstr("(lefty)")));
  expect_fault(WrittenIn::kawasaki_as, ".TRANS\np 1 2 3\n", 2, "p has 3 numbers; a location (x, y, z, O, A, T) has 6");
  expect_fault(WrittenIn::kawasaki_as, ".JOINTS\n#p 1 2 3 4 5 6x\n", 2, "'6x': must be a number");
  expect_fault(WrittenIn::kawasaki_as, ".TRANS\n1 2 3\n", 2, "must be a location");
}

const std::string kVal3Head = "<?xml version=\"1.0\" encoding=\"utf-8\" ?>\n<Database>\n<Datas>\n";
const std::string kVal3Points =
    "<Data name=\"p\" access=\"public\" xsi:type=\"array\" type=\"pointRx\" size=\"2\">\n"
    "  <Value key=\"1\" x=\"10\" y=\"20.5\" z=\"-30\" rx=\"10\" ry=\"20\" rz=\"30\" shoulder=\"lefty\" "
    "elbow=\"epositive\" "
    "wrist=\"wnegative\" fatherId=\"f[1]\" />\n</Data>\n";
const std::string kVal3Frames =
    "<Data name=\"f\" type=\"frame\" size=\"2\"><Value key=\"0\" x=\"500\" fatherId=\"world[0]\"/><Value key=\"1\" "
    "y=\"1\" "
    "rz=\"90\" fatherId=\"f[0]\"/></Data>\n";

TEST(Val3, ReadsJointsAndPointsThatHangOnFramesOfTheFile) {
  const Program program = read_file_of(
      WrittenIn::val3,
      kVal3Head + "<!-- <Value j1=\"1\"/> -->\n<Data name=\"n\" type=\"num\"><Value value=\"3\"/></Data>\n" +
          kVal3Frames + kVal3Points +
          "<Data name='j' type='jointRx'><Value j1='1' j2='2' j3='3' j4='4' j5='-5.5' j6='6'/></Data>\n"
          "<Data name=\"t\" type=\"tool\"><Value key=\"0\" z=\"150\" "
          "fatherId=\"flange[0]\"/></Data></Datas></Database>\n");
  EXPECT_THAT(names(program), ElementsAre("p[1]", "j[0]"));
  const Target& point = program.targets[0];
  EXPECT_THAT(values(point.position), ElementsAre(10, 20.5, -30));
  EXPECT_EQ(point.hint.configuration, "lefty epositive wnegative");
  EXPECT_LT((stated_point(point) - Eigen::Vector3d(0.4795, 0.011, -0.03)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(point.frames.tool->translation().z(), 0.15);
  EXPECT_THAT(values(program.targets[1].joints), ElementsAre(1, 2, 3, 4, -5.5, 6));
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(radians(90.0), Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(radians(10.0), Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(radians(20.0), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(radians(30.0), Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  EXPECT_TRUE(stated_tool_pose(point).linear().isApprox(turn, 1e-12));
}

TEST(Val3, SaysWhatTheFileDoesNotGiveAndNamesTheFault) {
  const Program lacking = read_file_of(WrittenIn::val3, kVal3Head + kVal3Points);
  EXPECT_EQ(lacking.targets.at(0).frames.unknown_frame, "frame f[1] is given neither in this program nor by --frames");
  const std::string tools =
      "<Data name=\"t\" type=\"tool\"><Value key=\"0\" z=\"1\"/><Value key=\"1\" z=\"2\"/></Data>\n";
  EXPECT_THAT(
      read_file_of(WrittenIn::val3, kVal3Head + tools + kVal3Frames + kVal3Points).targets.at(0).frames.unknown_tool,
      HasSubstr("several tools"));
  EXPECT_THAT(
      sentences(read_file_of(WrittenIn::val3, "<Data name=\"j\" type=\"jointRx\"><Value j3=\"90\" j5=\"90\"/></Data>")),
      ElementsAre(HasSubstr("j[0]: it leaves out j1, j2, j4, j6; write 0")));
  const std::string circle = "<Data name=\"f\" type=\"frame\"><Value key=\"1\" fatherId=\"f[1]\"/></Data>";
  EXPECT_NE(read_file_of(WrittenIn::val3, circle + kVal3Points).targets.at(0).frames.unknown_frame, "");
  expect_fault(WrittenIn::val3,
               "<Data type=\"jointRx\">\n<Value j1=\"1\" j2=\"a\" j3=\"0\" j4=\"0\" j5=\"0\" j6=\"0\"/>", 2,
               "'a': must be a number (column 19)");
  expect_fault(WrittenIn::val3, "\n<Data name=\"p", 2, "quote that is never closed");
  expect_fault(WrittenIn::val3, "\n<Data ", 2, "tag that is never closed");
}

TEST(OrientationForms, AreReadBackNearWhatWasWritten) {
  RandomStream stream{7302};
  for (const OrientationForm form : {OrientationForm::zyx_angles, OrientationForm::fixed_xyz_angles,
                                     OrientationForm::xyz_angles, OrientationForm::zyz_angles}) {
    for (int i = 0; i < 200; ++i) {
      std::vector<double> written;
      for (int angle = 0; angle < 3; ++angle) written.push_back(stream.real(-6.0, 6.0));
      const Eigen::Matrix3d rotation = rotation_from(form, written);
      const std::vector<double> same = numbers_of(rotation, form, written);
      for (std::size_t angle = 0; angle < 3; ++angle) EXPECT_NEAR(same[angle], written[angle], 1e-6);
      const Eigen::Matrix3d turned = rotation_of(1e-3 * Eigen::Vector3d::Ones()) * rotation;
      EXPECT_TRUE(rotation_from(form, numbers_of(turned, form, written)).isApprox(turned, 1e-9));
    }
  }
}

}  // namespace
}  // namespace demecal

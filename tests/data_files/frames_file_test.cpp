// FRAMES.yaml: the same frame in every controller's way of writing it, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "../config/temporary_folder.hpp"
#include "data_files/robot_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/orientation.hpp"
#include "prediction/random_robot.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

std::string flow_list(const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(17);
  for (const double value : values) text << (text.tellp() > 0 ? ", " : "") << value;
  return '[' + text.str() + ']';
}

TEST(FramesFile, ReadsTheSameFrameInEveryWayOfWritingIt) {
  struct Written {
    const char* key;
    OrientationForm form;
    double to_border;
  };
  constexpr double kDegrees = degrees(1.0);
  RandomStream stream{1701};
  const TemporaryFolder folder;
  for (int repetition = 0; repetition < 20; ++repetition) {
    const Eigen::Isometry3d pose = random_pose(stream);
    for (const Written& written : {Written{"rpy_deg", OrientationForm::fixed_xyz_angles, kDegrees},
                                   Written{"abc_deg", OrientationForm::zyx_angles, kDegrees},
                                   Written{"rxryrz_deg", OrientationForm::xyz_angles, kDegrees},
                                   Written{"oat_deg", OrientationForm::zyz_angles, kDegrees},
                                   Written{"quaternion_wxyz", OrientationForm::quaternion, 1.0},
                                   Written{"rotation_vector_rad", OrientationForm::rotation_vector, 1.0}}) {
      const bool four = written.form == OrientationForm::quaternion;
      std::vector<double> numbers =
          numbers_of(pose.linear(), written.form, std::vector<double>(four ? 4 : 3, four ? 0.5 : 0.1));
      for (double& number : numbers) number *= written.to_border;
      const Eigen::Vector3d point_mm = 1e3 * pose.translation();
      const std::string frame = "{xyz_mm: " + flow_list({point_mm.x(), point_mm.y(), point_mm.z()}) + ", " +
                                written.key + ": " + flow_list(numbers) + "}";
      const ControllerData read = load_frames(folder.write(
          "frames.yaml", "demecal_frames: 1\nframes:\n  3: " + frame + "\ntools:\n  Grip: " + frame + "\n"));
      ASSERT_TRUE(read.frames.contains("3") && read.tools.contains("grip"));
      EXPECT_TRUE(read.frames.at("3").isApprox(pose, 1e-9)) << written.key;
      EXPECT_TRUE(read.tools.at("grip").isApprox(pose, 1e-9)) << written.key;
    }
  }
}

TEST(FramesFile, NamesTheFault) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) -> std::string {
    try {
      load_frames(folder.write("f.yaml", "demecal_frames: 1\n" + text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  };
  EXPECT_THAT(complaint("frames: {}\n"), HasSubstr("no fault"));
  EXPECT_THAT(complaint(""), HasSubstr("must have frames or tools"));
  EXPECT_THAT(complaint("frames: [1]\n"), HasSubstr("must be a map"));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1]}\n"), HasSubstr("f.yaml:3: "));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1]}\n"), HasSubstr("must have an orientation"));
  EXPECT_THAT(complaint("tools:\n  1: {rpy_deg: [0, 0, 1]}\n"), HasSubstr("xyz_mm"));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1], rpy_deg: [0, 0, 1], abc_deg: [0, 0, 0]}\n"),
              HasSubstr("second orientation"));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1], rpy_deg: [0, 0, 361]}\n"), HasSubstr("-360 to 360"));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1], quaternion_wxyz: [1, 1, 0, 0]}\n"), HasSubstr("unit"));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1], quaternion_wxyz: [1, 0, 0]}\n"), HasSubstr("4 numbers"));
  EXPECT_THAT(complaint("tools:\n  1: {xyz_mm: [0, 0, 1], rotation_vector_rad: [90, 0, 0]}\n"), HasSubstr("one turn"));
  EXPECT_THAT(complaint("tools:\n  Grip: {xyz_mm: [0, 0, 1], rpy_deg: [0, 0, 0]}\n  grip: {xyz_mm: [0, 0, 1], "
                        "rpy_deg: [0, 0, 0]}\n"),
              HasSubstr("named twice"));
}

}  // namespace
}  // namespace demecal

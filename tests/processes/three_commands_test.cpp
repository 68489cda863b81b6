// From an arm's URDF, a tracker's text and a log of joints to a corrected program, in three commands: every file was
// made by another program (other_program.py), which also judges the corrected one by the arm as it really is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "data_files/robot_file.hpp"
#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

struct StrangersArm {
  std::string urdf, base, tip, language, ending;
  std::vector<std::string> options;  ///< that `new` needs
};

void PrintTo(const StrangersArm& arm, std::ostream* out) {
  *out << arm.urdf;
}

Ended other_program(std::vector<std::string> arguments) {
  const std::string file = std::string(DEMECAL_SOURCE_DIR) + "/tests/processes/other_program.py";
  arguments.insert(arguments.begin(), {"python3", "-B", file});
  return run("/usr/bin/env", arguments);
}

/// Distances of the tool point from where a program means it to be, mm.
struct ProgramErrors {
  double rms_before_mm = 0.0, largest_before_mm = 0.0, rms_mm = 0.0, largest_mm = 0.0;
};
ProgramErrors judged(const SmallJob& job, const std::string& corrected, const Eigen::Vector3d& tool_m) {
  std::ostringstream tool_mm;
  tool_mm << 1e3 * tool_m.x() << ',' << 1e3 * tool_m.y() << ',' << 1e3 * tool_m.z();
  const Ended said = other_program({"judge", job.path("."), corrected, tool_mm.str()});
  EXPECT_EQ(said.code, 0) << said.err;
  std::istringstream text(said.out);
  ProgramErrors errors;
  text >> errors.rms_before_mm >> errors.largest_before_mm >> errors.rms_mm >> errors.largest_mm;
  EXPECT_TRUE(text) << said.out;
  return errors;
}

class ThreeCommands : public ::testing::TestWithParam<StrangersArm> {};

TEST_P(ThreeCommands, LeadFromFilesOfOtherProgramsToACorrectedOne) {
  if (run("/usr/bin/env", {"python3", "-c", ""}).code != 0) GTEST_SKIP() << "there is no python3";
  const StrangersArm& arm = GetParam();
  const SmallJob job;
  const std::string urdf = std::string(DEMECAL_SOURCE_DIR) + "/../shared/data/urdf/" + arm.urdf + ".urdf";
  const Ended given = other_program({"make", urdf, arm.base, arm.tip, arm.language, job.path(".")});
  ASSERT_EQ(given.code, 0) << given.err;
  std::vector<std::string> first{
      "new", job.path("cell"), "--urdf", urdf, "--poses", job.path("tracker.txt"), job.path("joints.log")};
  first.insert(first.end(), arm.options.begin(), arm.options.end());
  const Ended made = run("demecal", first);
  ASSERT_EQ(made.code, 0) << made.err << made.out;
  EXPECT_THAT(made.err, HasSubstr("tracker.txt: in line 34 the clock falls to 00:00:02,2"));
  const Ended fitted =
      run("demecal", {"calibrate", job.path("cell/job.yaml"), "--out", job.path("result"), "--no-evolution"});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const std::string corrected = job.path("corrected" + arm.ending);
  const Ended applied =
      run("demecal", {"apply", job.path("result/model.yaml"), job.path("program" + arm.ending), "--out", corrected});
  ASSERT_EQ(applied.code, 0) << applied.err;

  // A table states no tool: its targets are of the one that robot.yaml has.
  const bool states_tool = arm.language != "csv";
  const Eigen::Vector3d tool_m =
      states_tool ? Eigen::Vector3d(0.11, -0.07, 0.19) : load_robot(job.path("cell/robot.yaml")).chain.tool_m;
  const ProgramErrors errors = judged(job, corrected, tool_m);
  EXPECT_GT(errors.rms_before_mm, 1.0);
  // The tracker scatters by 0.01 mm an axis.
  EXPECT_LT(errors.rms_mm, 0.03) << applied.out;
  EXPECT_LT(errors.largest_mm, 0.06) << applied.out;
}

INSTANTIATE_TEST_SUITE_P(
    OfArms, ThreeCommands,
    ::testing::Values(StrangersArm{"ur5", "base", "tool0", "urscript", ".script", {"--base", "base"}},
                      StrangersArm{"irb120_3_58", "base_link", "tool0", "rapid", ".mod", {}},
                      StrangersArm{"kr6r900_2", "base_link", "tool0", "krl", ".src", {}},
                      StrangersArm{
                          "iiwa14_no_collision", "base", "iiwa_link_ee", "csv", ".csv", {"--tip", "iiwa_link_ee"}}));

}  // namespace
}  // namespace demecal

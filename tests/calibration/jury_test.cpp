// A jury finds the errors that the model itself would give, however often it is asked.
#include "calibration/jury.hpp"

#include <gtest/gtest.h>

#include "erring_arm.hpp"

namespace demecal {
namespace {

CorrectedRobot model_of(const DataSet& data) {
  CorrectedRobot robot = nominal_robot(data);
  robot.effects = {{.kind = "gain", .joint = 1, .values = {3e-4}},
                   {.kind = "eccentricity", .joint = 2, .settings = {{"order", 1.0}}, .values = {1e-3, -5e-4}}};
  robot.corrections[0] = {parse("0.001*SIN(theta)"), {}, {-2.0, 2.0}};
  return robot;
}

TEST(Jury, FindsTheModelsErrors) {
  const DataSet data = measure(true_puma({"", "0.001", "", "", "", ""}), 30, 1e-4, 1, false);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::validation);
  const CorrectedRobot robot = model_of(data);
  const SquaredErrors errors = Jury(data, poses, robot).squared_errors(robot);
  ASSERT_EQ(errors.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(std::sqrt(errors[i]), 1e3 * tool_error_m(robot, data, data.poses[poses[i]]), 1e-9);
  }
}

TEST(Jury, TriesACorrectionAsIfItWereInTheModel) {
  const DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, 1e-4, 2, false);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  CorrectedRobot robot = model_of(data);
  const Jury jury(data, poses, robot);
  const JointCorrection correction(parse("0.002*COS(theta)"), {}, {-2.0, 3.0});
  const SquaredErrors tried = jury.squared_errors(robot, jury.with(jury.corrected(robot), 3, correction));
  robot.corrections[3] = correction;
  EXPECT_EQ(tried, jury.squared_errors(robot));
}

TEST(Jury, LeavesOutPosesWithoutAPosition) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 30, 1e-4, 3, true);
  for (std::size_t i = 0; i < data.poses.size(); i += 2) data.poses[i].position_m.reset();
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot robot = nominal_robot(data);
  const SquaredErrors errors = Jury(data, poses, robot).squared_errors(robot);
  EXPECT_EQ(errors.size(), poses.size() / 2);
  EXPECT_TRUE(std::isfinite(sum(errors)));
}

}  // namespace
}  // namespace demecal

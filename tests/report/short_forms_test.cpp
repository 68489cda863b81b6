// Corrections are shown in short where the short form does as well.
#include "report/make_report.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expression/text.hpp"
#include "prediction/measurement.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// Two links in a plane and a turning base.
Chain three_joints() {
  Chain chain;
  const double alpha[] = {-M_PI / 2, 0, 0}, a[] = {0, 0.5, 0.4}, d[] = {0.3, 0, 0};
  for (int i = 0; i < 3; ++i)
    chain.joints.push_back({.d_m = d[i], .a_m = a[i], .alpha_rad = alpha[i], .lower = -M_PI, .upper = M_PI});
  return chain;
}

CorrectedRobot arm(const std::vector<std::string>& errors) {
  CorrectedRobot robot;
  robot.chain = three_joints();
  robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.02, 0.03));
  for (const std::string& text : errors)
    robot.corrections.push_back(text.empty() ? JointCorrection{} : JointCorrection(parse(text), {}, {-1.4, 1.4}));
  return robot;
}

DataSet measured(const CorrectedRobot& truth, double noise_m, std::uint64_t seed) {
  RandomStream random{seed, 815};
  DataSet data;
  data.frame = Frame::base;
  data.robot.chain = three_joints();
  for (int i = 0; i < 90; ++i) {
    MeasuredPose pose;
    pose.joints.resize(3);
    for (int joint = 0; joint < 3; ++joint) pose.joints[joint] = random.real(-1.3, 1.3);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    pose.position_m = truth.predict(pose.joints, "").translation() + noise_m * noise;
    pose.set = i % 3 == 2 ? PoseSet::validation : PoseSet::calibration;
    pose.pose_id = "P" + std::to_string(i + 1);
    data.poses.push_back(pose);
  }
  return data;
}

TEST(ShortForms, SayAWaveInTheUnitsOfPeople) {
  const CorrectedRobot model = arm({"", "0.00031*SIN(theta+0.2443)", "0.0006*COS(2*theta)-0.0004"});
  const std::vector<std::optional<ShortForm>> forms = short_forms(measured(model, 5e-5, 1), model);
  EXPECT_FALSE(forms[0]);
  ASSERT_TRUE(forms[1] && forms[2]);
  EXPECT_EQ(forms[1]->text, "0.31 mrad sin(q2 + 14 deg)");
  EXPECT_EQ(forms[2]->text, "0.6 mrad sin(2 q3 + 90 deg) - 0.4 mrad");
}

TEST(ShortForms, ErrAtMostFivePerCentMoreTogether) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CorrectedRobot model = arm({"0.0003*theta+0.0002*SIN(3*theta)", "0.001*SIN(theta*theta)", "0.0004*SIN(theta)"});
    const DataSet data = measured(model, 1e-4, seed);
    const double long_rms_mm = error_figures(model, data, poses_of(data, PoseSet::validation)).rms_mm;
    const std::vector<std::optional<ShortForm>> forms = short_forms(data, model);
    EXPECT_TRUE(forms[0] && forms[2]) << "seed " << seed;
    for (std::size_t joint = 0; joint < forms.size(); ++joint) {
      if (!forms[joint]) continue;
      EXPECT_LE(forms[joint]->nodes, 20U);
      EXPECT_EQ(forms[joint]->nodes, forms[joint]->correction.formula().size());
      model.corrections[joint] = forms[joint]->correction;
    }
    EXPECT_LE(error_figures(model, data, poses_of(data, PoseSet::validation)).rms_mm, 1.05 * long_rms_mm);
  }
}

/// 600 validation poses of two targets in turn, the one where joint 3 does not move it.
DataSet measured_in_turn(const CorrectedRobot& truth) {
  DataSet data = measured(truth, 0.0, 4);
  RandomStream random{4, 816};
  for (int i = 0; i < 600; ++i) {
    MeasuredPose pose;
    pose.target = i % 2 == 0 ? "axis" : "far";
    pose.joints.resize(3);
    for (int joint = 0; joint < 3; ++joint) pose.joints[joint] = random.real(-1.3, 1.3);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    pose.position_m = truth.predict(pose.joints, pose.target).translation() + 5e-5 * noise;
    pose.set = PoseSet::validation;
    data.poses.push_back(pose);
  }
  return data;
}

TEST(ShortForms, AreJudgedOnEveryTargetMeasuredInTurn) {
  CorrectedRobot model = arm({"", "", "0.001*SIN(theta)+0.0003*SIN(5*theta*theta)"});
  model.tools["axis"] = Eigen::Isometry3d(Eigen::Translation3d(-0.4, 0, 0));
  model.tools["far"] = Eigen::Isometry3d(Eigen::Translation3d(0.1, 0, 0));
  DataSet data = measured_in_turn(model);
  std::erase_if(data.poses,
                [](const MeasuredPose& pose) { return pose.set == PoseSet::validation && pose.target.empty(); });
  EXPECT_FALSE(short_forms(data, model)[2]);
}

TEST(ShortForms, AreNotMadeUpWhereNoneDoes) {
  const CorrectedRobot model = arm({"", "0.002*SIGN(SIN(7*theta*theta))", ""});
  EXPECT_FALSE(short_forms(measured(model, 2e-5, 3), model)[1]);
}

}  // namespace
}  // namespace demecal

// Lines whose correction would leave the configuration that they state are left as they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/units.hpp"
#include "languages/written_program.hpp"
#include "programs/target_correction.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct StatingArm {
  RandomStream stream{7571};
  CommandModel model = [this] {
    Robot robot = elbow_arm(stream);
    for (const std::size_t joint : {3u, 5u}) {
      robot.chain.joints[joint].lower = -2.0 * std::numbers::pi;
      robot.chain.joints[joint].upper = 2.0 * std::numbers::pi;
    }
    return erring_model(stream, robot);
  }();

  std::string text(WrittenIn language, const JointVector& joints) const {
    const Eigen::Isometry3d pose = model.nominal_tool(joints);
    std::string text = written(
        language, true, 1, [&](int i) { return pose_line(language, pose, joints, i, 9); }, "\n");
    const auto insert = [&](const std::string& before, const std::string& words) {
      text.insert(text.find(before), words);
    };
    if (language == WrittenIn::fanuc_ls) insert("\n\tX =", " CONFIG : 'N U T, 0, 0, 0',");
    if (language == WrittenIn::yaskawa_jbi) insert("C00001=", "///RCONF 1,0,0,0,0,0,0,0\n");
    if (language == WrittenIn::val3) insert(" fatherId", " shoulder=\"ssame\" elbow=\"esame\" wrist=\"wpositive\"");
    return text;
  }

  CorrectedProgram corrected(WrittenIn language, const JointVector& joints) const {
    const std::string program = text(language, joints);
    return correct_program(program, read_program(language, program, "p", model.nominal.chain), model,
                           {.temperature_celsius = 20.0, .near = joints + JointVector::Constant(6, 0.05)});
  }
};

struct Boundary {
  Eigen::Index joint;
  double angle;
  std::vector<WrittenIn> languages;
};

std::vector<Boundary> boundaries() {
  using enum WrittenIn;
  return {{4, 0.0, {fanuc_ls, yaskawa_jbi, val3}},
          {5, std::numbers::pi, {fanuc_ls, yaskawa_jbi}},
          {3, -std::numbers::pi, {fanuc_ls, yaskawa_jbi}},
          {5, 0.0, {krl, rapid}},
          {3, std::numbers::pi / 2.0, {rapid}}};
}

/// The warnings about lines.
std::vector<std::string> sentences_of_lines(const CorrectedProgram& corrected) {
  std::vector<std::string> sentences;
  for (const Remark& warning : corrected.warnings)
    if (warning.place.line > 0) sentences.push_back(warning.sentence);
  return sentences;
}

TEST(StatedConfiguration, IsKeptOrTheLineIsLeftAndSaysWhichJointLeavesIt) {
  StatingArm arm;
  for (const Boundary& boundary : boundaries()) {
    for (const WrittenIn language : boundary.languages) {
      int kept = 0, left = 0;
      for (int i = 0; i < 24; ++i) {
        JointVector joints(6);
        joints << 0.4, -0.7, 0.5, 0.3, 0.9, 0.2;
        joints.head<3>() += random_change(arm.stream, 3, 0.2);
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        joints[boundary.joint] = boundary.angle + side * arm.stream.real(2e-4, 5e-3);
        const CorrectedProgram corrected = arm.corrected(language, joints);
        ASSERT_EQ(corrected.targets.size(), 1u);
        const CorrectedTarget& target = corrected.targets[0];
        if (target.command.size() == 0) continue;  // near a singular wrist no joints may be found
        const auto beyond = [&](const JointVector& at) { return wrap_near(at[boundary.joint] - boundary.angle, 0.0); };
        const double before = beyond(target.nominal);
        if (std::abs(before) > 0.03) continue;
        const bool crosses = before * beyond(target.command) < 0.0;
        EXPECT_EQ(target.is_uncorrected(), crosses) << joints.transpose() << " | " << target.command.transpose();
        (crosses ? left : kept)++;
        if (!crosses) continue;
        EXPECT_EQ(corrected.text, arm.text(language, joints));
        EXPECT_THAT(sentences_of_lines(corrected),
                    Contains(AllOf(StartsWith("the correction takes joint " + std::to_string(boundary.joint + 1)),
                                   HasSubstr("this line was not corrected"))));
      }
      EXPECT_GT(kept, 2) << boundary.joint << ' ' << boundary.angle << " in language " << static_cast<int>(language);
      EXPECT_GT(left, 0) << boundary.joint << ' ' << boundary.angle << " in language " << static_cast<int>(language);
    }
  }
}

TEST(StatedConfiguration, OfNothingLeavesNoLine) {
  StatingArm arm;
  JointVector joints(6);
  joints << 0.4, -0.7, 0.5, 0.3, 0.9, 0.2;
  int crossed = 0;
  for (int i = 0; i < 20; ++i) {
    joints[5] = arm.stream.real(-0.01, 0.01);
    const CorrectedProgram corrected = arm.corrected(WrittenIn::urscript, joints);
    EXPECT_FALSE(corrected.targets[0].is_uncorrected());
    crossed += joints[5] * corrected.targets[0].command[5] < 0.0 ? 1 : 0;
  }
  EXPECT_GT(crossed, 0);
}

/// Of a KRL program that moves to joints and then, as `motion` says, to a pose with these words for its configuration.
JointVector krl_command_after_joints(const StatingArm& arm, const std::string& motion, const std::string& words) {
  JointVector from(6), to(6);
  from << 0.4, -0.7, 0.5, 0.3, 0.9, 0.2;
  to << 0.45, -0.65, 0.45, 0.35, 0.85, 0.25;
  const auto joined = [](const std::vector<std::string>& names, const std::vector<double>& values) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
      text += (i == 0 ? "" : ",") + names[i] + " " + fixed_text(values[i], 9);
    return text;
  };
  std::vector<double> axes_deg, pose;
  for (const double angle : from) axes_deg.push_back(degrees(angle));
  const Eigen::Isometry3d tool = arm.model.nominal_tool(to);
  for (const double coordinate : tool.translation()) pose.push_back(1e3 * coordinate);
  const std::vector<double> abc_deg = controller_angles(tool.linear()).front().values;
  pose.insert(pose.end(), abc_deg.begin(), abc_deg.end());
  const std::string text = "$BASE=$NULLFRAME\n$TOOL={X 150,Y 2,Z 56,A 0,B 0,C 0}\nPTP {" +
                           joined({"A1", "A2", "A3", "A4", "A5", "A6"}, axes_deg) + "}\n" + motion + " {" +
                           joined({"X", "Y", "Z", "A", "B", "C"}, pose) + words + "}\n";
  const CorrectedProgram corrected = correct_program(
      text, read_program(WrittenIn::krl, text, "p", arm.model.nominal.chain), arm.model, {.temperature_celsius = 20.0});
  EXPECT_EQ(corrected.targets.size(), 2u);
  return corrected.targets.back().nominal;
}

TEST(StatedConfiguration, OfKrlCountsForPtpAndNotForLin) {
  const StatingArm arm;
  const JointVector plain = krl_command_after_joints(arm, "LIN", "");
  EXPECT_EQ(krl_command_after_joints(arm, "LIN", ",S 2,T 18"), plain);
  EXPECT_EQ(krl_command_after_joints(arm, "LIN", ",S 2,T 58"), plain);
  const JointVector other = krl_command_after_joints(arm, "PTP", ",S 2,T 18");
  EXPECT_TRUE(other.size() == 0 || (other - plain).cwiseAbs().maxCoeff() > 0.1);
}

}  // namespace
}  // namespace demecal

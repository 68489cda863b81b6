// Poses for an arm of seven joints leave its elbow to the controller, which is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "corrected_arm.hpp"
#include "data/text.hpp"
#include "kinematics/random_arm.hpp"
#include "languages/named_languages.hpp"
#include "languages/written_program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> said_of_table(const CommandModel& model, const std::string& text, const JointVector& near) {
  const Program program = read_program(WrittenIn::csv, text, "p.csv", model.nominal.chain);
  std::vector<std::string> said;
  for (const Remark& warning : correct_program(text, program, model, {.near = near}).warnings)
    said.push_back(warning.sentence);
  return said;
}

TEST(RedundantArm, HasAnElbowThatPosesDoNotTell) {
  RandomStream stream{7651};
  const auto is_said = Contains(HasSubstr("poses do not say at which angles of its 7 joints the arm reaches them"));
  for (const int joints : {6, 7}) {
    Robot nominal;
    nominal.name = "arm";
    nominal.chain = random_arm(stream, joints, Convention::standard_dh);
    const CommandModel model = unbounded_model(nominal, random_robot(stream, nominal.chain, 0.0, 0.0));
    const JointVector q = random_joints(stream, nominal.chain);
    const Eigen::Isometry3d pose = forward(nominal.chain, q) * Eigen::Translation3d(nominal.chain.tool_m);
    const Eigen::Quaterniond turn(pose.linear());
    const Eigen::Vector3d point_mm = 1e3 * pose.translation();
    const std::vector<double> row{point_mm.x(), point_mm.y(), point_mm.z(), turn.w(), turn.x(), turn.y(), turn.z()};
    const std::string poses = "x_mm,y_mm,z_mm,qw,qx,qy,qz\n" + listed(row, 9, ",") + '\n';
    if (joints == 7) {
      EXPECT_THAT(said_of_table(model, poses, q), is_said);
    } else {
      EXPECT_THAT(said_of_table(model, poses, q), Not(is_said));
    }
    std::string heading, angles;
    for (int i = 0; i < joints; ++i) {
      heading += (i == 0 ? "q" : ",q") + std::to_string(i + 1) + "_rad";
      angles += (i == 0 ? "" : ",") + number_text(q[i]);
    }
    EXPECT_THAT(said_of_table(model, heading + '\n' + angles + '\n', q), Not(is_said));
  }
}

}  // namespace
}  // namespace demecal

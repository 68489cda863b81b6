// The inverse that is exported as C commands the joints that programs are corrected to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "corrected_arm.hpp"
#include "kinematics/forward.hpp"
#include "prediction/compiled_code.hpp"
#include "prediction/corrected_arm.hpp"
#include "programs/target_correction.hpp"
#include "symbolic/code.hpp"

namespace demecal {
namespace {

/// The code with a count `evaluated` of the poses that are compared with a goal.
std::string with_count(std::string code) {
  const std::string first = "cosine = -0.5;\n";
  const std::size_t body = code.find(first);
  EXPECT_NE(body, std::string::npos);
  return "static long evaluated;\n" + code.insert(body + first.size(), "  ++evaluated;\n");
}

/// The joints that the exported `corrected` commands, and what it says is left.
struct ExportedCommand {
  double left = 0.0;
  JointVector command;
};

std::string joints_listed(const JointVector& joints) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (Eigen::Index i = 0; i < joints.size(); ++i) text << (i == 0 ? "" : ",") << joints[i];
  return text.str();
}

/// To where the tool is at the stop, from joints of which one is half a turn elsewhere.
constexpr const char* kHalfTurned = R"code(
double half_turned(const double stop[N], int joint, double command[N]);
double half_turned(const double stop[N], int joint, double command[N]) {
  double goal[16];
  forward(stop, goal);
  for (int i = 0; i < N; ++i) command[i] = stop[i];
  command[joint] += 3.14159265358979;
  return inverse(goal, command);
}
)code";

std::vector<ExportedCommand> exported_commands(const CorrectedRobot& robot, const std::vector<JointVector>& stops,
                                               const std::string& call = "corrected(stops[i], command)") {
  Algebra algebra;
  std::ostringstream code;
  const Listing listing = listing_of(corrected_arm(algebra, robot, ""), robot, "An arm");
  code << code_of(listing, CodeLanguage::c) << inverse_in_c(listing, described_listing(algebra, robot, robot.tool("")))
       << "#include <stdio.h>\n"
       << kHalfTurned << "int main(void) {\n"
       << "  static const double stops[][N] = {";
  for (const JointVector& stop : stops) code << '{' << joints_listed(stop) << "},\n";
  code << "};\n  double command[N];\n  for (int i = 0; i < " << stops.size() << "; ++i) {\n    printf(\"%.17g\\n\", "
       << call << ");\n"
       << "    for (int k = 0; k < N; ++k) printf(\"%.17g\\n\", command[k]);\n  }\n  return 0;\n}\n";
  const CodeFolder folder;
  const std::string program = folder.path("commands");
  int failed = 0;
  const std::string said = output_of("cc -std=c99 -O1 -Wall -Wextra -Wno-missing-prototypes -Werror -o " + program +
                                         ' ' + folder.write("arm.c", with_count(code.str())) + " -lm",
                                     failed);
  EXPECT_EQ(failed, 0) << said;
  std::istringstream printed(output_of(program, failed));
  std::vector<ExportedCommand> commands(stops.size(), {0.0, JointVector::Zero(robot.chain.size())});
  for (ExportedCommand& one : commands) {
    printed >> one.left;
    for (double& joint : one.command) EXPECT_TRUE(printed >> joint);
  }
  return commands;
}

/// As programs are corrected.
InverseSolution applied(const CorrectedRobot& robot, const JointVector& stop) {
  const Eigen::Isometry3d goal = robot.sensor_from_base * forward(robot.described.chain, stop) * robot.tool("");
  return nearby_command(robot, goal, Stop(stop));
}

/// Wrong in links alone.
CorrectedRobot erring(RandomStream& stream, const Robot& nominal) {
  CorrectedRobot robot = random_robot(stream, nominal.chain, 1e-3, 1e-3);
  robot.described = nominal;
  robot.corrections.assign(nominal.chain.joints.size(), {});
  return robot;
}

TEST(ExportedInverse, StaysNearWhereTheArmIsSingularAsProgramsDo) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{7561};
  const Robot nominal = elbow_arm(stream);
  const CorrectedRobot robot = erring(stream, nominal);
  std::vector<JointVector> stops;
  for (const double wrist_rad : {0.0, 1e-6, 1e-3, 0.01, 0.03, 0.1, 0.3}) {
    for (int i = 0; i < 40; ++i) {
      stops.push_back(regular_joints(stream, nominal.chain));
      stops.back()[4] = wrist_rad;
    }
  }
  const std::vector<ExportedCommand> commands = exported_commands(robot, stops);
  int bounded = 0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const InverseSolution expected = applied(robot, stops[i]);
    const double left = std::hypot(expected.position_residual_m, 0.25 * expected.orientation_residual_rad);
    EXPECT_LT((commands[i].command - expected.q).cwiseAbs().maxCoeff(), 1e-5) << stops[i].transpose();
    EXPECT_NEAR(commands[i].left, left, 1e-6) << stops[i].transpose();
    bounded += commands[i].left > 1e-5 ? 1 : 0;
  }
  EXPECT_GT(bounded, 100) << "the arm has no exact inverse there";
}

TEST(ExportedInverse, OfArmsWithOtherNumbersOfJointsIsAsPrograms) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{7562};
  for (const int joints : {4, 5, 7}) {
    const Robot nominal = heavy(stream, random_arm(stream, joints, Convention::modified_dh, 0.0));
    const CorrectedRobot robot = erring(stream, nominal);
    std::vector<JointVector> stops;
    for (int i = 0; i < 100; ++i) stops.push_back(random_joints(stream, nominal.chain));
    const std::vector<ExportedCommand> commands = exported_commands(robot, stops);
    const double same_joints = joints > 6 ? 3e-3 : 1e-5;  // of many that reach the goal, they need not choose the same
    int same = 0;
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const InverseSolution expected = applied(robot, stops[i]);
      const double left = std::hypot(expected.position_residual_m, 0.25 * expected.orientation_residual_rad);
      const bool agrees = (commands[i].command - expected.q).cwiseAbs().maxCoeff() < same_joints;
      same += agrees && std::abs(commands[i].left - left) < 1e-6 ? 1 : 0;
    }
    EXPECT_GE(same, 90) << joints << " joints";
  }
}

TEST(ExportedInverse, TakesFewEvaluationsWhereTheArmIsRegular) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{7565};
  const Robot nominal = elbow_arm(stream);
  const CorrectedRobot robot = erring(stream, nominal);
  std::vector<JointVector> stops;
  for (int i = 0; i < 200; ++i) stops.push_back(regular_joints(stream, nominal.chain));
  const std::string call = "corrected(stops[i], command) < 1e-9 ? (double)evaluated : 1e300";
  const std::vector<ExportedCommand> commands = exported_commands(robot, stops, call);
  for (const ExportedCommand& one : commands) EXPECT_LT(one.left, 5.0 * static_cast<double>(stops.size()));
}

TEST(ExportedInverse, ReachesNothingHalfTurned) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{7563};
  const Robot nominal = elbow_arm(stream);
  const CorrectedRobot robot = erring(stream, nominal);
  std::vector<JointVector> stops;
  for (int i = 0; i < 20; ++i) stops.push_back(regular_joints(stream, nominal.chain));
  for (const int joint : {3, 5}) {
    const std::string call = "half_turned(stops[i], " + std::to_string(joint) + ", command)";
    const std::vector<ExportedCommand> commands = exported_commands(robot, stops, call);
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const Eigen::Isometry3d goal = robot.predict(Stop(stops[i]), "");
      const Eigen::Isometry3d reached = robot.predict(Stop(commands[i].command), "");
      EXPECT_TRUE(commands[i].left > 1e-6 || reached.isApprox(goal, 1e-5)) << stops[i].transpose();
    }
  }
}

}  // namespace
}  // namespace demecal

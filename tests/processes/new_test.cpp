// demecal new and demecal template: from files of other programs to files that other commands take at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "data/text.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/draft_data_set.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "program.hpp"
#include "random/random_stream.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string shipped_robot(const std::string& name) {
  return std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/" + name + ".yaml";
}

std::string comma_text(double value) {
  std::string text = number_text(std::round(1e3 * value) / 1e3);
  std::ranges::replace(text, '.', ',');
  return text;
}

/// A tracker's text with decimal commas and a log of joints with time stamps of another clock, of an arm whose second
/// joint is off by a milliradian. The log names joints by number and gives degrees, or by name and gives radians.
void write_measurement(const SmallJob& job, const std::string& robot_file, RandomStream& random,
                       const std::vector<std::string>& names = {}) {
  const Robot robot = load_robot(robot_file);
  std::ofstream tracker(job.path("tracker.txt")), log(job.path("joints.log"));
  tracker << "Survey of a robot\n\nTime [s];X [mm];Y [mm];Z [mm]\n";
  log << "timestamp";
  for (std::size_t j = 0; j < 6; ++j) log << '\t' << (names.empty() ? "j" + std::to_string(j + 1) : names[j]);
  log << '\n';
  JointVector before = JointVector::Zero(6);
  for (int pose = 0; pose < 40; ++pose) {
    JointVector q(6);
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Joint& joint = robot.chain.joints[static_cast<std::size_t>(j)];
      q[j] = random.real(std::max(joint.lower, -1.2), std::min(joint.upper, 1.2));
    }
    for (int row = 0; row < 30; ++row) {
      const double way = std::min(1.0, row / 12.0), time_s = 3.0 * pose + 0.1 * row;
      log << "10:" << (time_s < 60.0 ? "00" : "01") << ':' << (std::fmod(time_s, 60.0) < 9.95 ? "0" : "")
          << number_text(std::round(10.0 * std::fmod(time_s, 60.0)) / 10.0);
      for (Eigen::Index j = 0; j < 6; ++j) {
        const double angle_rad = (1.0 - way) * before[j] + way * q[j];
        log << '\t' << number_text(names.empty() ? degrees(angle_rad) : angle_rad);
      }
      log << '\n';
    }
    JointVector real = q;
    real[1] += 1e-3;
    const Eigen::Vector3d point_mm = 1e3 * tool_position(robot.chain, real);
    tracker << comma_text(500.0 + 3.0 * pose + 2.2) << ';' << comma_text(1500.0 - point_mm.y()) << ';'
            << comma_text(point_mm.x() - 300.0) << ';' << comma_text(point_mm.z()) << '\n';
    before = q;
  }
}

class FirstHour : public ::testing::TestWithParam<const char*> {};

TEST_P(FirstHour, MakesAModelOfFilesOfOtherPrograms) {
  const SmallJob job;
  RandomStream random{311};
  const std::string robot = shipped_robot(GetParam());
  write_measurement(job, robot, random);
  const Ended made = run("demecal", {"new", job.path("cell"), "--robot", robot, "--poses", job.path("tracker.txt"),
                                     job.path("joints.log")});
  ASSERT_EQ(made.code, 0) << made.err << made.out;
  EXPECT_THAT(made.out, HasSubstr("40 poses of"));
  EXPECT_THAT(made.out, HasSubstr("the offset of the clocks is found by the arm's motion"));
  EXPECT_THAT(made.err, HasSubstr("semicolons between 4 columns, decimal commas, headings in line 3 with units"));
  const Ended fitted = run("demecal", {"diagnose", job.path("cell/dataset.yaml"), "--declare",
                                       "registration,joint_offset", "--max-effects", "0", "--out", job.path("result")});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const Ended evaluated = run("demecal", {"evaluate", job.path("result/model.yaml"), job.path("cell/dataset.yaml")});
  EXPECT_EQ(evaluated.code, 0) << evaluated.err;
}

/// The same with both clocks in seconds, the tracker's 4 s ahead, a log that begins before and ends after, and a point
/// that lies where no robot file says.
void write_measurement_of_unknown_tool(const SmallJob& job, const Robot& robot, RandomStream& random) {
  std::ofstream tracker(job.path("tracker.csv")), log(job.path("joints.csv"));
  tracker << "time_s,x_mm,y_mm,z_mm\n";
  log << "time_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
  double time_s = 0.0;
  JointVector before = JointVector::Zero(6), q = before;
  const auto stand = [&](int rows) {
    for (int row = 0; row < rows; ++row, time_s += 0.1) {
      log << number_text(std::round(10.0 * time_s) / 10.0);
      const double way = std::min(1.0, row / 12.0);
      for (Eigen::Index j = 0; j < 6; ++j) log << ',' << number_text(degrees((1.0 - way) * before[j] + way * q[j]));
      log << '\n';
    }
    before = q;
  };
  stand(100);
  for (int pose = 0; pose < 40; ++pose) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Joint& joint = robot.chain.joints[static_cast<std::size_t>(j)];
      q[j] = random.real(std::max(joint.lower, -1.2), std::min(joint.upper, 1.2));
    }
    stand(30);
    JointVector real = q;
    real[1] += 1e-3;
    const Eigen::Vector3d point_mm = 1e3 * (forward(robot.chain, real) * Eigen::Vector3d(0.11, -0.07, 0.19));
    tracker << number_text(time_s - 0.8 + 4.0) << ',' << number_text(1500.0 - point_mm.y()) << ','
            << number_text(point_mm.x() - 300.0) << ',' << number_text(point_mm.z()) << '\n';
  }
  stand(100);
}

TEST(New, FindsTheOffsetOfClocksThatOverlapWhereTheToolIsUnknown) {
  const SmallJob job;
  RandomStream random{314};
  Robot robot = load_robot(shipped_robot("ur10"));
  write_measurement_of_unknown_tool(job, robot, random);
  const Ended made = run("demecal", {"new", job.path("cell"), "--robot", shipped_robot("ur10"), "--poses",
                                     job.path("tracker.csv"), job.path("joints.csv")});
  ASSERT_EQ(made.code, 0) << made.err << made.out;
  EXPECT_THAT(job.text("cell/dataset.yaml"), HasSubstr("offset_s: auto"));
  EXPECT_THAT(made.err, HasSubstr("the tool was fitted for it, "));
  const Ended fitted =
      run("demecal", {"diagnose", job.path("cell/dataset.yaml"), "--declare", "registration,tool,joint_offset",
                      "--max-effects", "0", "--out", job.path("result")});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
}

class FirstHourWithUrdf : public ::testing::TestWithParam<const char*> {};

TEST_P(FirstHourWithUrdf, TakesTheUrdfAsItIsAndALogWithItsJointsNames) {
  const SmallJob job;
  RandomStream random{313};
  const std::string urdf = std::string(DEMECAL_SOURCE_DIR) + "/../shared/data/urdf/" + GetParam() + ".urdf";
  ASSERT_EQ(run("demecal", {"robot", "import", urdf, "--out", job.path("arm.yaml")}).code, 0);
  const std::vector<std::string> names = joint_names(load_robot(job.path("arm.yaml")));
  ASSERT_EQ(names.size(), 6U);
  write_measurement(job, job.path("arm.yaml"), random, names);
  const Ended made = run(
      "demecal", {"new", job.path("cell"), "--urdf", urdf, "--poses", job.path("tracker.txt"), job.path("joints.log")});
  ASSERT_EQ(made.code, 0) << made.err << made.out;
  EXPECT_THAT(made.out, HasSubstr("40 poses of"));
  EXPECT_THAT(made.out, HasSubstr("taken to be rad"));
  const Ended fitted = run("demecal", {"diagnose", job.path("cell/dataset.yaml"), "--declare",
                                       "registration,joint_offset", "--max-effects", "0", "--out", job.path("result")});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
}

/// The joint angles of a KRL program's first target, rad.
JointVector first_krl_joints(const std::string& program) {
  JointVector joints(6);
  for (Eigen::Index j = 0; j < 6; ++j) {
    const std::string axis = "A" + std::to_string(j + 1) + " ";
    joints[j] = radians(std::stod(program.substr(program.find(axis, program.find("PTP")) + axis.size())));
  }
  return joints;
}

TEST(New, FindsTheToolSoThatProgramsWithItAreCorrectedAsTheyStand) {
  const SmallJob job;
  RandomStream random{315};
  const std::string urdf = std::string(DEMECAL_SOURCE_DIR) + "/../shared/data/urdf/kr6r900_2.urdf";
  ASSERT_EQ(run("demecal", {"robot", "import", urdf, "--out", job.path("arm.yaml")}).code, 0);
  const Robot robot = load_robot(job.path("arm.yaml"));
  write_measurement_of_unknown_tool(job, robot, random);
  const Ended made = run(
      "demecal", {"new", job.path("cell"), "--urdf", urdf, "--poses", job.path("tracker.csv"), job.path("joints.csv")});
  ASSERT_EQ(made.code, 0) << made.err << made.out;
  EXPECT_THAT(made.out, HasSubstr("where these poses have the measured point"));
  const Eigen::Vector3d tool_m(0.11, -0.07, 0.19);
  EXPECT_LT((load_robot(job.path("cell/robot.yaml")).chain.tool_m - tool_m).norm(), 3e-3);
  const Ended fitted =
      run("demecal", {"diagnose", job.path("cell/dataset.yaml"), "--declare", "registration,tool,joint_offset",
                      "--max-effects", "0", "--out", job.path("result")});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  std::ofstream(job.path("p.src")) << "DEF p()\n$BASE=$NULLFRAME\n$TOOL={X 110,Y -70,Z 190,A 0,B 0,C 0}\n"
                                      "PTP {A1 10,A2 -60,A3 70,A4 20,A5 50,A6 5}\nEND\n";
  const Ended applied =
      run("demecal", {"apply", job.path("result/model.yaml"), job.path("p.src"), "--out", job.path("q.src")});
  ASSERT_EQ(applied.code, 0) << applied.err;
  EXPECT_THAT(applied.err, Not(HasSubstr("not determined")));
  const auto point = [&](const JointVector& joints) { return forward(robot.chain, joints) * tool_m; };
  const JointVector programmed = first_krl_joints(job.text("p.src"));
  JointVector uncorrected = programmed, corrected = first_krl_joints(job.text("q.src"));
  for (JointVector* real : {&uncorrected, &corrected}) (*real)[1] += 1e-3;
  EXPECT_GT((point(uncorrected) - point(programmed)).norm(), 3e-4);
  EXPECT_LT((point(corrected) - point(programmed)).norm(), 5e-5);
}

INSTANTIATE_TEST_SUITE_P(OfArms, FirstHourWithUrdf, ::testing::Values("ur5", "irb120_3_58", "kr6r900_2"));

TEST(New, TakesContactsAndEitherAnArmsFileOrItsUrdf) {
  const SmallJob job;
  std::ofstream(job.path("touched.csv")) << "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,contact\n";
  const std::string robot = shipped_robot("ur10");
  std::ofstream table(job.path("touched.csv"), std::ios::app);
  for (int pose = 0; pose < 12; ++pose)
    table << 5 * pose << ",-60,80," << -100 + 2 * pose << ",-90," << 3 * pose << (pose < 6 ? ",left\n" : ",right\n");
  table.close();
  const Ended made =
      run("demecal", {"new", job.path("cell"), "--robot", robot, "--poses", job.path("touched.csv"), "--force"});
  EXPECT_THAT(made.out, HasSubstr("equal words under contact")) << made.err;
  EXPECT_THAT(job.text("cell/dataset.yaml"), HasSubstr("contact: contact"));
  EXPECT_EQ(run("demecal", {"new", job.path("other"), "--poses", job.path("touched.csv")}).code, 10);
  EXPECT_EQ(
      run("demecal", {"new", job.path("other"), "--robot", robot, "--urdf", robot, "--poses", job.path("touched.csv")})
          .code,
      10);
}

INSTANTIATE_TEST_SUITE_P(OfArms, FirstHour, ::testing::Values("ur10", "puma761", "elbow-offset"));

TEST(New, RefusesWhatCannotBeToldAndLeavesStrangersFiles) {
  const SmallJob job;
  const std::string robot = shipped_robot("ur10");
  std::ofstream(job.path("points.txt")) << "x y\n1 2\n";
  const Ended without = run("demecal", {"new", job.path("cell"), "--robot", robot, "--poses", job.path("points.txt")});
  EXPECT_EQ(without.code, 11);
  EXPECT_THAT(without.err, HasSubstr("no columns are called as the 6 joints may be"));
  EXPECT_FALSE(std::filesystem::exists(job.path("cell")));
  std::filesystem::create_directories(job.path("mine"));
  std::ofstream(job.path("mine/dataset.yaml")) << "mine\n";
  RandomStream random{312};
  write_measurement(job, robot, random);
  const Ended mine = run("demecal", {"new", job.path("mine"), "--robot", robot, "--poses", job.path("tracker.txt"),
                                     job.path("joints.log")});
  EXPECT_EQ(mine.code, 10) << mine.err;
}

TEST(New, LeavesNothingHalfMadeWhereTheDataDoNotFit) {
  const SmallJob job;
  const std::string robot = shipped_robot("ur10");
  const auto table = [&](const std::string& last) {
    std::ofstream file(job.path("poses.csv"));
    file << "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,payload_kg\n";
    for (int pose = 0; pose < 12; ++pose)
      file << 5 * pose << ",-60,80," << -100 + 2 * pose << ",-90," << 3 * pose << ",700," << 10 * pose << ",300,"
           << (pose < 11 ? "1" : last) << '\n';
  };
  const auto make = [&] {
    return run("demecal", {"new", job.path("cell"), "--robot", robot, "--poses", job.path("poses.csv")});
  };
  table("heavy");
  const Ended refused = make();
  EXPECT_EQ(refused.code, 11) << refused.out;
  EXPECT_THAT(refused.err, HasSubstr("poses.csv:13: 'heavy'"));
  EXPECT_THAT(refused.err, HasSubstr("cell: nothing was written there, since the data do not fit"));
  EXPECT_FALSE(std::filesystem::exists(job.path("cell")));

  // What an earlier run made, and nobody changed, stays as it was, and may be written anew.
  std::filesystem::create_directories(job.path("cell"));
  table("1");
  make();
  const std::string earlier = job.text("cell/dataset.yaml");
  EXPECT_THAT(earlier, HasSubstr("payload: payload_kg"));
  table("heavy");
  EXPECT_EQ(make().code, 11);
  EXPECT_EQ(job.text("cell/dataset.yaml"), earlier);
  table("1");
  EXPECT_NE(make().code, 10) << "the files are still demecal's own";
}

TEST(Template, PrintsAFileOrWritesItOnce) {
  const SmallJob job;
  const Ended printed = run("demecal", {"template", "robot"});
  EXPECT_EQ(printed.code, 0);
  EXPECT_THAT(printed.out, HasSubstr("demecal_robot: 1"));
  EXPECT_EQ(run("demecal", {"template", "job", "--out", job.path("first.yaml")}).code, 0);
  EXPECT_EQ(run("demecal", {"template", "job", "--out", job.path("first.yaml")}).code, 10);
  EXPECT_EQ(run("demecal", {"template", "cell"}).code, 10);
}

}  // namespace
}  // namespace demecal

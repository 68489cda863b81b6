// Every mistake that the benchmark makes, on one arm, and data sets that lack nothing; then what the rules say.
#include "data_check/check_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../errors/complaint.hpp"
#include "data_check/searches.hpp"
#include "fitting/fit.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "long_measurements.hpp"
#include "mistaken_case.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

using bench::MistakenCase;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<Robot>& arms() {
  static const std::vector<Robot> arms = bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots");
  return arms;
}

/// As commands check: copies first.
DataCheck checked(DataSet data) {
  std::vector<Finding> copies = take_out_copies(data);
  DataCheck check = check_data(data);
  for (Finding& copy : copies) check.findings.push_back(std::move(copy));
  return check;
}

std::vector<FindingKind> kinds_of(const DataCheck& check) {
  std::vector<FindingKind> kinds;
  for (const Finding& finding : check.findings) kinds.push_back(finding.kind);
  return kinds;
}

std::string sentences_of(const DataCheck& check) {
  std::string all;
  for (const Finding& finding : check.findings) all += finding.sentence + "\n";
  return all;
}

const MistakenCase& case_of(const std::string& what) {
  static const std::vector<MistakenCase> cases = bench::mistaken_cases({arms()[1]});
  for (const MistakenCase& one : cases)
    if (one.what == what) return one;
  ADD_FAILURE() << "no mistake is called " << what;
  return cases.front();
}

TEST(CheckData, NamesEveryMistakeOfTheBenchmark) {
  for (const MistakenCase& one : bench::mistaken_cases({arms()[0]})) {
    const DataCheck check = checked(one.data);
    EXPECT_THAT(kinds_of(check), Contains(*one.kind)) << one.what << "\n" << sentences_of(check);
    EXPECT_EQ(check.verdict(), contradicts(*one.kind) ? DataVerdict::contradiction : DataVerdict::suspicious)
        << one.what;
    for (const std::string& pose : one.poses) EXPECT_THAT(sentences_of(check), HasSubstr(pose)) << one.what;
  }
}

TEST(CheckData, FindsNothingWhereNothingIsWrong) {
  for (const MistakenCase& one : bench::unmistaken_cases(arms(), 24)) {
    EXPECT_THAT(sentences_of(checked(one.data)), IsEmpty()) << one.arm << " " << one.number;
  }
}

/// Poses along a smooth path, measured at a point that the robot's description does not know of.
DataSet smooth_path(const Robot& arm, double step_rad, std::uint64_t seed) {
  DataSet data;
  data.robot = arm;
  data.robot.chain.tool_m.setZero();
  data.frame = Frame::sensor;
  RandomStream random{seed};
  const Eigen::Isometry3d base(Eigen::Translation3d(2.8, -0.6, 0.4) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  std::vector<double> phases;
  for (int joint = 0; joint < arm.chain.size(); ++joint) phases.push_back(random.real(0.0, 6.0));
  for (int i = 0; i < 100; ++i) {
    MeasuredPose pose;
    pose.joints.resize(arm.chain.size());
    for (int joint = 0; joint < arm.chain.size(); ++joint)
      pose.joints[joint] =
          (1.0 + 0.3 * joint) * std::sin(step_rad * i * (0.9 + 0.4 * joint) + phases[static_cast<std::size_t>(joint)]);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    pose.position_m = base * (forward(arm.chain, pose.joints) * Eigen::Vector3d(0.08, 0.03, 0.12)) + 3e-5 * noise;
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

TEST(CheckData, DoesNotRefuseASmoothPathWithAnUnknownTool) {
  for (const Robot& arm : arms()) {
    for (const double step_rad : {0.004, 0.006}) {
      for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const DataCheck check = checked(smooth_path(arm, step_rad, seed));
        EXPECT_NE(check.verdict(), DataVerdict::contradiction) << arm.name << " " << seed << sentences_of(check);
      }
    }
  }
}

TEST(CheckData, RefusesASmoothPathWhoseRowsAreShifted) {
  for (const Robot& arm : arms()) {
    DataSet data = smooth_path(arm, 0.06, 1);
    for (std::size_t i = 0; i + 3 < data.poses.size(); ++i) data.poses[i].position_m = data.poses[i + 3].position_m;
    EXPECT_TRUE(checked(data).has(FindingKind::rows_shifted)) << arm.name;
  }
}

TEST(CheckData, SaysTheErrorAsGivenAndIfChanged) {
  const DataCheck check = checked(case_of("sign of an inner joint").data);
  ASSERT_FALSE(check.findings.empty());
  EXPECT_GT(check.findings.front().as_given_mm, 50.0);
  EXPECT_LT(check.findings.front().if_changed_mm, 1.0);
  EXPECT_THAT(check.findings.front().sentence, HasSubstr("is taken with the other sign"));
}

TEST(CheckData, NamesTwoMistakesAtOnce) {
  DataSet data = bench::unmistaken_cases({arms()[1]}, 1).front().data;
  for (MeasuredPose& pose : data.poses) {
    pose.joints[1] *= -1.0;
    pose.joints[3] *= -1.0;
  }
  const DataCheck check = checked(data);
  ASSERT_EQ(check.findings.size(), 2u) << sentences_of(check);
  for (const Finding& finding : check.findings) {
    EXPECT_EQ(finding.kind, FindingKind::joint_sign);
    EXPECT_TRUE(finding.joint == 1 || finding.joint == 3);
  }
}

TEST(CheckData, PutsExchangedRowsInOneSentence) {
  const DataCheck check = checked(case_of("two pairs of rows exchanged").data);
  EXPECT_EQ(check.findings.size(), 2u) << sentences_of(check);
  EXPECT_THAT(sentences_of(check), HasSubstr("fit if their measured points are exchanged"));
}

TEST(CheckData, TellsRowsOfOneNameByTheirLines) {
  DataSet data = case_of("two pairs of rows exchanged").data;
  for (MeasuredPose& pose : data.poses) pose.pose_id = "P11";
  EXPECT_THAT(sentences_of(checked(data)),
              ::testing::ContainsRegex("line [0-9]+ \\(P11\\) and line [0-9]+ \\(P11\\) fit"));
}

TEST(CheckData, SaysWhereTheSetsThatJudgeStandAtCalibrationPoses) {
  DataSet data = bench::unmistaken_cases({arms()[1]}, 1).front().data;
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  const auto measure_again = [&](std::size_t which) {
    MeasuredPose& pose = data.poses[accept[which]];
    const auto [set, id, line] = std::tuple(pose.set, pose.pose_id, pose.line);
    pose = data.poses[fitted[3 * which]];
    pose.set = set;
    pose.pose_id = id;
    pose.line = line;
    pose.joints[0] += 1e-5;
    *pose.position_m += Eigen::Vector3d(2e-5, 0, -1e-5);
  };
  measure_again(0);
  EXPECT_THAT(checked(data).findings, IsEmpty()) << "one pose may be a home that is measured again and again";
  for (std::size_t i = 1; i < 1 + accept.size() / 10; ++i) measure_again(i);
  const DataCheck check = checked(data);
  ASSERT_THAT(kinds_of(check), ElementsAre(FindingKind::shared_poses));
  EXPECT_EQ(check.findings[0].poses.size(), 1 + accept.size() / 10);
  EXPECT_THAT(check.findings[0].sentence, AllOf(HasSubstr(" accept poses stand at the joints of calibration poses"),
                                                HasSubstr("(" + data.poses[accept[0]].pose_id + ") at those of line "),
                                                HasSubstr("(" + data.poses[fitted[0]].pose_id + ")")));
}

TEST(CheckData, TakesCopiesOutSoThatTheyAreNoRepeats) {
  DataSet data = case_of("rows copied with their ids").data;
  const std::size_t before = data.poses.size();
  const std::vector<Finding> copies = take_out_copies(data);
  EXPECT_EQ(copies.size(), 2u);
  EXPECT_EQ(data.poses.size(), before - 2);
}

TEST(CheckData, SaysOfCopiesThatWereJoinedToOneLineThatTheyAreTwoRows) {
  DataSet data = case_of("rows copied with their ids").data;
  for (std::size_t i = 0; i < data.poses.size(); ++i) data.poses[i].line = i + 2;
  DataSet unnamed = data;
  for (MeasuredPose& pose : unnamed.poses) pose.pose_id = line_name(pose.line);
  EXPECT_THAT(take_out_copies(data).front().sentence, HasSubstr(" repeats line "));
  EXPECT_THAT(take_out_copies(unnamed).front().sentence,
              ::testing::ContainsRegex("^Line [0-9]+ repeats line [0-9]+ to the last digit"));
  data.poses.push_back(data.poses.front());
  const std::string line = std::to_string(data.poses.front().line) + " (" + data.poses.front().pose_id + ")";
  EXPECT_EQ(take_out_copies(data).front().sentence,
            "Two rows that belong to line " + line +
                " are alike to the last digit: a copy, not a second measurement; one is left out.");
}

TEST(CheckData, LeavesRepeatsOfCoarseDigitsAlone) {
  DataSet data = bench::unmistaken_cases({arms()[1]}, 1).front().data;
  for (MeasuredPose& pose : data.poses)
    for (double& value : *pose.position_m) value = metres(std::round(1e4 * value) / 10.0);
  data.poses.push_back(data.poses.front());
  EXPECT_THAT(take_out_copies(data), IsEmpty());
}

TEST(CheckData, RefusesJointsBeyondTheirLimitsUnlessAFindingSaysWhy) {
  DataSet data = bench::unmistaken_cases({arms()[1]}, 1).front().data;
  EXPECT_EQ(complaint([&] { require_joint_limits(data, {}); }), "");
  data.poses[3].joints[1] = radians(300.0);
  EXPECT_THAT(complaint([&] { require_joint_limits(data, {}); }), HasSubstr("far outside the limits of joint 2"));
  const DataCheck named{{{.kind = FindingKind::typing_error, .poses = {data.poses[3].pose_id}}}};
  EXPECT_EQ(complaint([&] { require_joint_limits(data, named); }), "");
}

TEST(CheckData, TakesSmallAnglesForRadiansWhereOnlyLengthsWereMeasured) {
  DataSet data = bench::unmistaken_cases({arms()[1]}, 1).front().data;
  for (MeasuredPose& pose : data.poses) {
    pose.distances_m = {pose.position_m->norm()};
    pose.position_m.reset();
  }
  data.anchors_m = {Eigen::Vector3d::Zero()};
  EXPECT_THAT(checked(data).findings, IsEmpty());
  for (MeasuredPose& pose : data.poses) pose.joints *= radians(1.0);
  EXPECT_THAT(kinds_of(checked(data)), Contains(FindingKind::unit));
}

TEST(CheckData, NamesPayloadsThatNoArmCarries) {
  DataSet data = long_measurements(1).front();
  for (MeasuredPose& pose : data.poses) pose.payload_kg = 8.0;
  data.robot.masses.clear();
  data.poses[7].payload_kg = 2000.0;
  EXPECT_FALSE(check_data(data).has(FindingKind::implausible_payload));
  data.poses[7].payload_kg = 5000.0;
  const auto told = [&] {
    const DataCheck check = check_data(data);
    const auto found = std::ranges::find(check.findings, FindingKind::implausible_payload, &Finding::kind);
    EXPECT_EQ(check.verdict(), DataVerdict::suspicious);
    return found == check.findings.end() ? Finding() : *found;
  };
  EXPECT_THAT(told().sentence, HasSubstr("up to 5000 kg"));
  EXPECT_THAT(told().sentence, HasSubstr("more than any robot carries (2300 kg)"));
  EXPECT_THAT(told().poses, ElementsAre(data.poses[7].pose_id));
  // An arm of 60 kg carries no 2000 kg.
  data.poses[7].payload_kg = 2000.0;
  data.robot.masses.assign(static_cast<std::size_t>(data.robot.chain.size()), {.mass_kg = 10.0});
  EXPECT_THAT(told().sentence, HasSubstr("more than all links of this arm weigh (60 kg)"));
  data.robot.masses.back().mass_kg = 0.0;  // not known
  EXPECT_FALSE(check_data(data).has(FindingKind::implausible_payload));
  data.robot.payload_kg = 1999.0;
  EXPECT_THAT(told().sentence, HasSubstr("more than this arm carries (1999 kg, `payload_kg`)"));
}

}  // namespace
}  // namespace demecal

// Data sets of several files: the same poses as of one, whatever programs wrote the files; and what is said of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "../errors/complaint.hpp"
#include "config/job_file.hpp"
#include "config/scenario_file.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/draft_data_set.hpp"
#include "drafting/preparation_file.hpp"
#include "drafting/templates.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "random/random_stream.hpp"
#include "temporary_folder.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kRobot = read_file(std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/ur10.yaml");

/// An arm that stands at some poses, measured there, and logged all the time.
struct MeasuredCell {
  TemporaryFolder folder;
  std::filesystem::path robot_file = folder.write("robot.yaml", kRobot);
  Robot robot = load_robot(robot_file);
  std::vector<JointVector> joints;
  std::vector<Eigen::Vector3d> points_m;  ///< in the instrument's frame

  MeasuredCell(RandomStream& random, int poses) {
    for (int pose = 0; pose < poses; ++pose) {
      JointVector q(6);
      for (Eigen::Index j = 0; j < 6; ++j) q[j] = random.real(-1.5, 1.5);
      joints.push_back(q);
      const Eigen::Vector3d base_m = tool_position(robot.chain, q);
      points_m.emplace_back(2.0 - base_m.y(), 0.5 + base_m.x(), base_m.z() + 0.3);
    }
  }
};

std::string with_comma(double value) {
  std::string text = number_text(std::round(1e4 * value) / 1e4);
  std::ranges::replace(text, '.', ',');
  return text;
}

/// As a tracker's program writes it: words first, semicolons, decimal commas, units in brackets.
std::string tracker_text(const MeasuredCell& cell, bool names, double first_time_s) {
  std::ostringstream text;
  text << "Inspection of a cell\r\nOperator: nobody\r\n\r\n"
       << (names ? "Point;" : "") << "Time;X [mm];Y [mm];Z [mm]\r\n";
  for (std::size_t i = 0; i < cell.points_m.size(); ++i) {
    if (names) text << "P" << i + 1 << ';';
    const double time_s = first_time_s + 4.0 * static_cast<double>(i);
    const int minutes = static_cast<int>(time_s) / 60;
    text << "24.11.2026 10:" << (minutes < 10 ? "0" : "") << minutes << ':'
         << (std::fmod(time_s, 60.0) < 10.0 ? "0" : "") << with_comma(std::round(std::fmod(time_s, 60.0)));
    for (const double value_m : cell.points_m[i]) text << ';' << with_comma(millimetres(value_m));
    text << "\r\n";
  }
  return text.str();
}

/// As a logger writes it: tabs, points, radians, ten rows a second.
std::string joint_log(const MeasuredCell& cell) {
  std::ostringstream text;
  text << "stamp\tj1 [rad]\tj2 [rad]\tj3 [rad]\tj4 [rad]\tj5 [rad]\tj6 [rad]\n";
  for (std::size_t i = 0; i < cell.joints.size(); ++i) {
    for (int row = 0; row < 40; ++row) {
      const double way = std::min(1.0, row / 15.0);
      const JointVector& from = cell.joints[i > 0 ? i - 1 : 0];
      text << number_text(100.0 + 4.0 * static_cast<double>(i) + 0.1 * row);
      for (Eigen::Index j = 0; j < 6; ++j) text << '\t' << number_text((1.0 - way) * from[j] + way * cell.joints[i][j]);
      text << '\n';
    }
  }
  return text.str();
}

std::string joints_by_name(const MeasuredCell& cell) {
  std::ostringstream text;
  text << "name,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
  for (std::size_t i = cell.joints.size(); i-- > 0;) {
    text << "P" << i + 1;
    for (const double q : cell.joints[i]) text << ',' << number_text(degrees(q));
    text << '\n';
  }
  return text.str();
}

void expect_poses(const DataSet& data, const MeasuredCell& cell) {
  ASSERT_EQ(data.poses.size(), cell.joints.size());
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    EXPECT_LT((data.poses[i].joints - cell.joints[i]).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((*data.poses[i].position_m - cell.points_m[i]).norm(), 1e-6);
  }
}

TEST(PoseFiles, AreJoinedByName) {
  RandomStream random{91};
  const MeasuredCell cell(random, 12);
  cell.folder.write("tracker.txt", tracker_text(cell, true, 0.0));
  cell.folder.write("joints.csv", joints_by_name(cell));
  const auto path = cell.folder.write("set.yaml", R"yaml(demecal_dataset: 1
robot: robot.yaml
poses:
  - {file: joints.csv, columns: {joints: [q1_deg, q2_deg, q3_deg, q4_deg, q5_deg, q6_deg], pose: name}}
  - {file: tracker.txt, columns: {position: ["X [mm]", Y, 5], pose: Point}}
join: {by: name}
)yaml");
  const DescribedDataSet read = load_described_data_set(path);
  expect_poses(read.data, cell);
  EXPECT_EQ(read.data.poses[3].pose_id, "P4");
  ASSERT_EQ(read.recognised.size(), 2u);
  EXPECT_THAT(read.recognised[0],
              HasSubstr("semicolons between 5 columns, decimal commas, headings in line 4 with units"));
  EXPECT_THAT(read.recognised[1], HasSubstr("12 rows joined by name"));
}

TEST(PoseFiles, AreJoinedByTimeWhateverTheClocks) {
  RandomStream random{92};
  const MeasuredCell cell(random, 15);
  cell.folder.write("tracker.txt", tracker_text(cell, false, 63.0));
  cell.folder.write("joints.txt", joint_log(cell));
  const auto path = cell.folder.write("set.yaml", R"yaml(demecal_dataset: 1
robot: robot.yaml
poses: [joints.txt, tracker.txt]
columns: {joints: [j1, j2, j3, j4, j5, j6], position: [X, Y, Z], time: Time}
join: {by: time, within_s: 0.1, offset_s: auto}
)yaml");
  EXPECT_THAT(complaint([&] { load_data_set(path); }), HasSubstr("joins rows by a column that"));
  cell.folder.write("set.yaml", R"yaml(demecal_dataset: 1
robot: robot.yaml
poses:
  - {file: joints.txt, columns: {joints: [2, 3, 4, 5, 6, 7], time: 1}}
  - {file: tracker.txt, columns: {position: [X, Y, Z], time: Time}}
join: {by: time, within_s: 0.1, offset_s: auto}
)yaml");
  const DescribedDataSet read = load_described_data_set(path);
  expect_poses(read.data, cell);
  EXPECT_THAT(read.recognised.back(), HasSubstr("(found by the arm's motion: arm and points then agree to "));
}

TEST(PoseFiles, SayWhichWereTakenWhileTheArmMovedHoweverNearRowsAreJoined) {
  RandomStream random{94};
  const MeasuredCell cell(random, 12);
  cell.folder.write("joints.txt", joint_log(cell));
  const auto path = cell.folder.write("set.yaml", R"yaml(demecal_dataset: 1
robot: robot.yaml
poses:
  - {file: joints.txt, columns: {joints: [2, 3, 4, 5, 6, 7], time: 1}}
  - {file: points.csv, columns: {position: [x_mm, y_mm, z_mm], time: time_s}}
join: {by: time, within_s: 0.06}
)yaml");
  const auto recognised = [&](double after_s) {
    std::string text = "time_s,x_mm,y_mm,z_mm\n";
    for (std::size_t i = 0; i < cell.points_m.size(); ++i) {
      text += number_text(100.0 + 4.0 * static_cast<double>(i) + after_s);
      for (const double value_m : cell.points_m[i]) text += ',' + number_text(millimetres(value_m));
      text += '\n';
    }
    cell.folder.write("points.csv", text);
    return load_described_data_set(path).recognised.back();
  };
  EXPECT_THAT(recognised(0.7), HasSubstr("the arm moves at 11 of 12 measured times"));  // it stands before the first
  EXPECT_THAT(recognised(3.0), HasSubstr("12 rows joined by time"));
}

TEST(PoseFiles, ThatDoNotBelongTogetherAreRefused) {
  RandomStream random{93};
  const MeasuredCell cell(random, 5);
  cell.folder.write("tracker.txt", tracker_text(cell, true, 0.0));
  cell.folder.write("joints.csv", joints_by_name(cell));
  const auto refusal = [&](const std::string& rest) {
    const auto path = cell.folder.write("set.yaml", "demecal_dataset: 1\nrobot: robot.yaml\n" + rest);
    return complaint([&] { load_data_set(path); });
  };
  const std::string files = "poses: [joints.csv, tracker.txt]\n";
  const std::string columns =
      "columns: {joints: [q1_deg, q2_deg, q3_deg, q4_deg, q5_deg, q6_deg], position: [X, Y, Z]}\n";
  EXPECT_THAT(refusal(files + columns), HasSubstr("set.yaml:3: poses names several files: `join` must say"));
  EXPECT_THAT(refusal(files + columns + "join: {by: name}\n"), HasSubstr("joins rows by a column that"));
  EXPECT_THAT(refusal(files + columns + "join: {by: time}\n"), HasSubstr("join.within_s is missing"));
  EXPECT_THAT(refusal(files + columns + "join: {by: order, within_s: 1}\n"), HasSubstr("says nothing"));
  EXPECT_THAT(refusal(files + "columns: {joints: [2, 3, 4, 5, 6, 7], position: [X, Y, Z]}\njoin: {by: order}\n"),
              HasSubstr("of which file?"));
  EXPECT_THAT(refusal("poses: [joints.csv, joints.csv]\n" + columns + "join: {by: order}\n"),
              HasSubstr("which is meant?"));
  EXPECT_THAT(refusal("poses: joints.csv\n" + columns + "join: {by: order}\n"), HasSubstr("`poses` names one"));
  EXPECT_THAT(refusal("poses: []\n" + columns), HasSubstr("must name one file at least"));
}

TEST(Drafts, OfFilesThatOtherProgramsWroteAreTakenAtOnce) {
  RandomStream random{94};
  for (const bool by_name : {true, false}) {
    const MeasuredCell cell(random, 14);
    const auto tracker = cell.folder.write("tracker.txt", tracker_text(cell, by_name, 63.0));
    const auto joints = cell.folder.write("joints.txt", by_name ? joints_by_name(cell) : joint_log(cell));
    const std::vector<GivenTable> tables = read_given_tables({joints, tracker}, 6, {});
    bool taken = false;
    for (const DataSetDraft& draft : draft_data_sets(tables, cell.folder.path(), "robot.yaml", 6, {})) {
      const auto path = cell.folder.write("first.yaml", draft.text);
      try {
        expect_poses(load_data_set(path), cell);
        taken = true;
        break;
      } catch (const InputError&) {
      }
    }
    EXPECT_TRUE(taken) << by_name;
  }
}

TEST(Drafts, SayWhatTheyAssume) {
  RandomStream random{95};
  const MeasuredCell cell(random, 9);
  std::ostringstream text;
  text << "j1 j2 j3 j4 j5 j6 x y z\n";
  for (std::size_t i = 0; i < cell.joints.size(); ++i) {
    for (const double q : cell.joints[i]) text << number_text(degrees(q)) << ' ';
    text << 1e3 * cell.points_m[i].transpose() << '\n';
  }
  const auto path = cell.folder.write("all.txt", text.str());
  const auto drafts = draft_data_sets(read_given_tables({path}, 6, {}), cell.folder.path(), "robot.yaml", 6, {});
  ASSERT_EQ(drafts.size(), 1u);
  EXPECT_THAT(drafts[0].assumed[0], HasSubstr("are taken to be deg, since the largest is"));
  EXPECT_THAT(drafts[0].assumed[1], HasSubstr("are taken to be mm"));
  const DataSet data = load_data_set(cell.folder.write("first.yaml", drafts[0].text));
  EXPECT_LT((data.poses[4].joints - cell.joints[4]).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Drafts, RefuseFilesWithoutJointsOrPoints) {
  const TemporaryFolder folder;
  const auto points = folder.write("points.txt", "a b\n1 2\n");
  EXPECT_THAT(complaint([&] { draft_data_sets(read_given_tables({points}, 6, {}), folder.path(), "r", 6, {}); }),
              HasSubstr("no columns are called as the 6 joints may be"));
}

TEST(Templates, OfEveryKindAreRead) {
  RandomStream random{96};
  const MeasuredCell cell(random, 10);
  const TemporaryFolder& folder = cell.folder;
  const auto write = [&](TemplateKind kind, const char* name) {
    return folder.write(name, template_text(kind, {}, folder.path()));
  };
  EXPECT_EQ(load_robot(write(TemplateKind::robot, "robot.yaml")).chain.size(), 6);
  std::string poses = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,pose_id\n";
  for (int i = 0; i < 5; ++i) poses += "1,2,3,4,5," + std::to_string(i) + ",100,200,300,P" + std::to_string(i) + "\n";
  folder.write("poses.csv", poses);
  std::string readings = "pose,x_mm,y_mm,z_mm\n";
  for (int i = 0; i < 5; ++i) readings += "P" + std::to_string(i) + ",1,2," + std::to_string(i) + "\n";
  folder.write("readings.txt", readings);
  EXPECT_EQ(load_data_set(write(TemplateKind::dataset, "dataset.yaml")).poses.size(), 5u);
  EXPECT_EQ(load_job(write(TemplateKind::job, "job.yaml")).seed, 1u);
  EXPECT_EQ(load_scenario(write(TemplateKind::scenario, "scenario.yaml")).name, "my simulation");
  EXPECT_EQ(load_preparation(write(TemplateKind::preparation, "preparation.yaml")).sets.size(), 1u);
}

TEST(Templates, AreFilledInByGivenFiles) {
  RandomStream random{97};
  const MeasuredCell cell(random, 10);
  const auto tracker = cell.folder.write("tracker.txt", tracker_text(cell, true, 0.0));
  const auto joints = cell.folder.write("joints.csv", joints_by_name(cell));
  const std::string text = template_text(TemplateKind::dataset, {cell.robot_file, joints, tracker}, cell.folder.path());
  EXPECT_THAT(text, HasSubstr("decimal commas"));
  expect_poses(load_data_set(cell.folder.write("filled.yaml", text)), cell);
  const std::string job = template_text(TemplateKind::job, {cell.folder.path() / "filled.yaml"}, cell.folder.path());
  EXPECT_THAT(job, HasSubstr("data: filled.yaml"));
  EXPECT_THAT(template_text(TemplateKind::robot, {joints}, "."), HasSubstr("# joint 6\n"));
}

TEST(UnknownKeys, AreToldTheKeysThatAreAllowedThere) {
  const TemporaryFolder folder;
  const auto path = folder.write("job.yaml", "demecal_job: 1\ndata: d.yaml\nislands: {per_join: 2}\n");
  EXPECT_THAT(complaint([&] { load_job(path); }),
              HasSubstr("the nearest is 'per_joint'. Keys that are allowed here: per_joint topology"));
}

}  // namespace
}  // namespace demecal

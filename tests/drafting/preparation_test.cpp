// The preparation that is shipped loads, and every fault in its files is named with file, line, value and rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "../config/sample_files.hpp"
#include "../config/temporary_folder.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/preparation_file.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "preparation/results.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kShipped = std::filesystem::path(DEMECAL_SOURCE_DIR) / "configs/preparation";
constexpr const char* kFile = "puma761-cords.yaml";

TEST(Preparation, ThatIsShippedGivesADataSetThatLoads) {
  const RawMeasurements raw = load_preparation(kShipped / kFile);
  const Prepared prepared = prepare_measurements(raw);
  for (const auto frame : {std::optional<FrameKind>(), {FrameKind::three_points}, {FrameKind::best_fit}}) {
    const TemporaryFolder folder;
    const DataSet data = prepared_data_set(raw, prepared, frame);
    const DataSet back = load_data_set(write_data_set(data, folder.path(), "prepared"));
    ASSERT_EQ(back.poses.size(), 36u);
    EXPECT_EQ(back.frame, frame ? Frame::base : Frame::sensor);
    for (std::size_t i = 0; i < back.poses.size(); ++i) {
      EXPECT_LT((*back.poses[i].position_m - *data.poses[i].position_m).norm(), 1e-14);
      EXPECT_LT((back.poses[i].joints - data.poses[i].joints).norm(), 1e-14);
    }
  }
  EXPECT_LT(prepared.programmed_from_joints_m, 1e-4);
  const ErrorStatistic statistic = error_statistic(raw, prepared);
  ASSERT_EQ(statistic.sets.size(), 2u);
  EXPECT_EQ(statistic.sets[0].readings, 72u);
  EXPECT_GT(statistic.sets[0].best_fit->error.rms_mm, 0.3);
  EXPECT_LT(statistic.sets[0].best_fit->error.rms_mm, statistic.sets[0].three_points->error.rms_mm);
  EXPECT_LT(*statistic.sets[0].spread_mm, 0.5);
}

TEST(Preparation, ReadsTablesOfJointsAndInstrumentsThatGiveCoordinates) {
  const TemporaryFolder folder;
  const Robot robot = load_robot(kShipped / "../robots/puma761.yaml");
  folder.write("robot.yaml", read_file(kShipped / "../robots/puma761.yaml"));
  std::string joints = "name,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,temperature_celsius\n",
              seen = "pose,x_mm,y_mm,z_mm\n";
  for (int i = 0; i < 5; ++i) {
    const JointVector q =
        (JointVector(6) << 20 + 9 * i, -30 - 7 * i * i, 150 - 8 * i, 5, -50 + 3 * i, 4 * i).finished();
    const Eigen::Vector3d at = 1e3 * tool_position(robot.chain, q * radians(1.0));
    const std::string name(1, static_cast<char>('a' + i));
    joints += name;
    for (const double angle : q) joints += "," + number_text(angle);
    joints += ",21.5\n";
    for (int repeat = 0; repeat < 2; ++repeat) {
      // the instrument's x axis is the base's y axis
      seen += name + "," + number_text(at.y()) + "," + number_text(-at.x()) + "," + number_text(at.z() + repeat) + "\n";
    }
  }
  folder.write("joints.csv", joints);
  folder.write("seen.csv", seen);
  folder.write("taught.csv", "x_mm,y_mm,z_mm\n0,-500,0\n400,-500,0\n0,-900,0\n");
  const auto file =
      folder.write("p.yaml",
                   "demecal_preparation: 1\nrobot: robot.yaml\ninstrument: points\nrepeats: keep\n"
                   "local_frame: {robot: [[500, 0, 0], [500, 400, 0], [900, 0, 0]], instrument: taught.csv}\n"
                   "sets: [{set: accept, joints: joints.csv, readings: seen.csv}]\n");
  const RawMeasurements raw = load_preparation(file);
  const Prepared prepared = prepare_measurements(raw);
  const DataSet data = prepared_data_set(raw, prepared, FrameKind::three_points);
  ASSERT_EQ(data.poses.size(), 10u);
  for (std::size_t row = 0; row < 10; ++row) {
    const MeasuredPose& pose = data.poses[row];
    EXPECT_EQ(pose.pose_id, std::string(1, static_cast<char>('a' + row / 2)));
    EXPECT_EQ(pose.set, PoseSet::accept);
    EXPECT_EQ(pose.temperature_celsius, 21.5);
    const Eigen::Vector3d error = *pose.position_m - tool_position(robot.chain, pose.joints);
    EXPECT_LT((error - Eigen::Vector3d(0, 0, row % 2 == 0 ? 0.0 : 1e-3)).norm(), 1e-9);
  }
  EXPECT_FALSE(prepared.fitted_to_calibration);
  EXPECT_NEAR(*error_statistic(raw, prepared).sets.at(0).spread_mm, std::sqrt(0.5), 1e-6);
}

TEST(Preparation, ReadsTablesOfInstrumentsAsOtherProgramsWriteThem) {
  const TemporaryFolder folder;
  folder.write("robot.yaml", read_file(kShipped / "../robots/puma761.yaml"));
  folder.write("joints.csv", "name,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\nP1,1,2,3,4,5,6\nP2,2,3,4,5,6,7\n");
  const auto file = folder.write("p.yaml",
                                 "demecal_preparation: 1\nrobot: robot.yaml\ninstrument: points\nsets: [{set: accept, "
                                 "joints: joints.csv, readings: seen.txt}]\n");
  const auto points = [&](const std::string& text) {
    folder.write("seen.txt", text);
    return load_preparation(file);
  };
  const auto expect_points = [&](const RawMeasurements& raw) {
    const Readings& readings = raw.sets.front().readings;
    ASSERT_EQ(readings.rows.size(), 2u);
    EXPECT_TRUE(readings.named);
    EXPECT_EQ(readings.rows[0].pose, "P1");
    EXPECT_LT((readings.rows[0].point_m - Eigen::Vector3d(1.5005, -0.25, 0.75)).norm(), 1e-12);
    EXPECT_LT((readings.rows[1].point_m - Eigen::Vector3d(1.6, 0.0, 0.8)).norm(), 1e-12);
  };
  const RawMeasurements spoken = points(
      "\xEF\xBB\xBFSurvey of a robot\r\n\r\nPoint;X [mm];Y [mm];Z [mm]\r\nP1;1500,5;-250,0;750,0\r\n"
      "P2;1600,0;0,0;800,0\r\n");
  expect_points(spoken);
  EXPECT_THAT(spoken.assumed.at(0), HasSubstr("semicolons between 4 columns, decimal commas"));
  expect_points(points("Name\tX_m\tY_m\tZ_m\nP1\t1.5005\t-0.25\t0.75\nP2\t1.6\t0\t0.8\n"));
  const RawMeasurements unitless = points("point,x,y,z\nP1,1500.5,-250,750\nP2,1600,0,800\n");
  expect_points(unitless);
  EXPECT_THAT(unitless.assumed.at(0), HasSubstr("points are taken to be in mm, since the largest number is 1600"));
}

/// A change to one of the files, and what the user must be told.
struct Bad {
  const char* name;
  const char* file;
  const char* from;  ///< what stands there once
  const char* to;
  const char* where;  ///< "FILE:LINE" or "FILE" of the fault
  const char* rule;
};

std::ostream& operator<<(std::ostream& stream, const Bad& bad) {
  return stream << bad.name;
}

class BadPreparations : public ::testing::TestWithParam<Bad> {};

TEST_P(BadPreparations, AreNamedWithFileLineValueAndRule) {
  const Bad& bad = GetParam();
  const TemporaryFolder folder;
  folder.write("robots/puma761.yaml", read_file(kShipped / "../robots/puma761.yaml"));
  for (const auto& entry : std::filesystem::directory_iterator(kShipped)) {
    const std::string name = entry.path().filename().string(), text = read_file(entry.path());
    folder.write("preparation/" + name, name == bad.file ? changed(text, bad.from, bad.to) : text);
  }
  const std::filesystem::path at = folder.path() / "preparation";
  const std::string said = complaint([&] { prepare_measurements(load_preparation(at / kFile)); });
  EXPECT_THAT(said, HasSubstr((at / bad.where).string() + ": "));
  EXPECT_THAT(said, HasSubstr(bad.rule));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadPreparations,
    ::testing::Values(
        Bad{"Version", kFile, "demecal_preparation: 1", "demecal_preparation: 2", "puma761-cords.yaml:2", "must be 1"},
        Bad{"UnknownKey", kFile, "top_cords_mm", "topcords_mm", "puma761-cords.yaml:8", "nearest is 'top_cords_mm'"},
        Bad{"UnknownSetKey", kFile, "points: vp,", "point: vp,", "puma761-cords.yaml:19", "'point': is no key"},
        Bad{"NoTriangle", kFile, "ab: 1420", "ab: 2800", "puma761-cords.yaml:7",
            "'2800, 1385.5, 1310.25': instrument.cords.triangle_mm must be the sides of a triangle"},
        Bad{"FlatTriangle", kFile, "ab: 1420", "ab: 2695.75", "puma761-cords.yaml:7", "that is not as flat as a line"},
        Bad{"NoSuchSide", kFile, "side: above", "side: up", "puma761-cords.yaml:10", "'up': "},
        Bad{"WrongSide", kFile, "side: above", "side: below", "puma761-cords.yaml", "in a mirror"},
        Bad{"CountsOfTwoKinds", kFile, "bar_mm: 500,", "bar_mm: 500, counts_per_mm: [1, 1, 1],", "puma761-cords.yaml:9",
            "must give either bar_mm and bar_counts or counts_per_mm"},
        Bad{"NoCounts", kFile, "encoders: {bar_mm: 500, bar_counts: [9937, 9956, 9926]}", "", "local-frame.csv:2",
            "has no instrument.cords.encoders"},
        Bad{"NoFile", kFile, "local-frame.csv", "frame.csv", "puma761-cords.yaml:14",
            "names a file that does not exist"},
        Bad{"NoSuchSet", kFile, "set: validation", "set: test", "puma761-cords.yaml:19", "'test': "},
        Bad{"NoSuchArray", kFile, "points: cp", "points: ccp", "calibration.v2", "the nearest is 'cp'"},
        Bad{"Tolerance", kFile, "tolerance_mm: 5\n", "tolerance_mm: 0.001\n", "local-frame.csv",
            "must agree within 0.001 mm (local_frame.tolerance_mm)"},
        Bad{"CordsThatDoNotMeet", "calibration.csv", "c_counts\n1,38622,", "c_counts\n1,386,", "calibration.csv:3",
            "do not meet"},
        Bad{"MissingCell", "validation.csv", "pose,a_counts,b_counts,c_counts\n1,",
            "pose,a_counts,b_counts,c_counts\n1,,", "validation.csv:3", "has 5 fields, but those below have 4"},
        Bad{"NotANumber", "validation.csv", "c_counts\n1,", "c_counts\n1,nan,1,2\n2,", "validation.csv:3",
            "'nan': column a_counts must be a finite number"},
        Bad{"PoseThatIsNone", "validation.csv", "c_counts\n1,", "c_counts\n13,", "validation.csv:3",
            "'13': is no point of "},
        Bad{"SpoiledProgram", "validation.v2", "#vp[1] ", "#vp[1] x ", "validation.v2:21", "'x': must be a number"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace demecal

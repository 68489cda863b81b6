// Measured poses from tables, and the rules a table must keep.
#include "data/read_poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/units.hpp"
#include "small_arm.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kHeading = "q1_deg,q2_deg,q3_mm,x_mm,y_mm,z_mm";

std::vector<MeasuredPose> read(const std::string& text, const ColumnMap& map = small_map(),
                               const AssumedUnits& units = {}) {
  return read_poses(table_of(text), map, units, small_arm(), {{"A", Eigen::Vector3d(0.0, 0.0, 0.1)}});
}

std::string refusal(const std::string& text, const ColumnMap& map = small_map(), const AssumedUnits& units = {}) {
  return complaint([&] { read(text, map, units); });
}

TEST(ReadPoses, ConvertsToMetresAndRadians) {
  const auto poses = read(kHeading + "\n90,-45,100,1,2,3\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_DOUBLE_EQ(poses[0].joints[0], radians(90.0));
  EXPECT_DOUBLE_EQ(poses[0].joints[1], radians(-45.0));
  EXPECT_DOUBLE_EQ(poses[0].joints[2], 0.1);
  EXPECT_DOUBLE_EQ(poses[0].position_m->z(), 0.003);
  EXPECT_EQ(poses[0].set, PoseSet::calibration);
  EXPECT_EQ(poses[0].line, 2u);
  EXPECT_FALSE(poses[0].orientation || poses[0].approach || poses[0].payload_kg || poses[0].time_s);
}

TEST(ReadPoses, TakesUnitsFromTheUserWhereNamesHaveNone) {
  const AssumedUnits units{find_unit("rad"), find_unit("m")};
  const auto poses =
      read("q1,q2,q3,x,y,z\n1.5,-0.5,0.1,1,2,3\n", small_map({"q1", "q2", "q3"}, {"x", "y", "z"}), units);
  EXPECT_EQ(poses[0].joints[0], 1.5);
  EXPECT_EQ(poses[0].joints[2], 0.1);
  EXPECT_EQ(poses[0].position_m->z(), 3.0);
}

TEST(ReadPoses, ReadsEveryCircumstance) {
  ColumnMap map = small_map();
  map.orientation = columns_named({"qw", "qx", "qy", "qz"});
  map.distances = columns_named({"l1_mm", "l2_m"});
  map.approach = columns_named({"s1", "s2", "s3"});
  map.torque = columns_named({"t1", "t2_nm", "t3"});
  map.payload = column("payload_kg");
  map.temperature = column("temperature_celsius");
  map.time = column("order");
  map.set = column("set");
  map.pose = column("pose_id");
  map.target = column("target_id");
  const auto poses =
      read(kHeading +
               ",qw,qx,qy,qz,l1_mm,l2_m,s1,s2,s3,t1,t2_nm,t3,payload_kg,temperature_celsius,order,set,pose_id,"
               "target_id\n40,-45,100,1,2,3,0.9995,0,0,0,500,0.25,-1,0,+1,-80.5,20,300,2.5,21,7,accept,P 1,A\n",
           map);
  const MeasuredPose& pose = poses[0];
  EXPECT_DOUBLE_EQ(pose.orientation->w(), 1.0);
  EXPECT_THAT(pose.distances_m, ElementsAre(0.5, 0.25));
  EXPECT_EQ(*pose.approach, ApproachSigns(Eigen::Vector3d(-1.0, 0.0, 1.0)));
  EXPECT_EQ(*pose.torque, JointVector(Eigen::Vector3d(-80.5, 20.0, 300.0)));
  EXPECT_EQ(pose.payload_kg, 2.5);
  EXPECT_EQ(pose.temperature_celsius, 21.0);
  EXPECT_EQ(pose.time_s, 7.0);
  EXPECT_EQ(pose.set, PoseSet::accept);
  EXPECT_EQ(pose.pose_id, "P 1");
  EXPECT_EQ(pose.target, "A");
}

TEST(ReadPoses, GivesRowsWithoutPoseColumnTheirOwnIds) {
  const auto poses = read(kHeading + "\n40,0,0,1,2,3\n\n41,0,0,1,2,3\n");
  EXPECT_EQ(poses[0].pose_id, "line 2");
  EXPECT_EQ(poses[1].pose_id, "line 4");
}

TEST(ReadPoses, TakesRowsAtEqualJointsForRepeatsWithoutPoseColumn) {
  ColumnMap map = small_map();
  map.set = column("set");
  const std::string rows = ",set\n40,0,0,1,2,3,accept\n50,0,0,1,2,3,accept\n40,0,0,1,2,3.1,accept\n";
  const auto poses = read(kHeading + rows + "40,0,0,1,2,3,validation\n", map);
  EXPECT_EQ(poses[1].pose_id, "line 3");
  EXPECT_EQ(poses[2].pose_id, "line 2");
  EXPECT_EQ(poses[3].pose_id, "line 5") << "sets share no pose";
}

TEST(ReadPoses, RefusesBadValuesWithTheirLineAndColumn) {
  const auto with = [](const std::string& row) { return refusal(kHeading + "\n40,0,0,1,2,3\n" + row + "\n"); };
  EXPECT_EQ(with("abc,0,0,1,2,3"), "poses.csv:3: 'abc': column q1_deg is not a number");
  EXPECT_EQ(with(",0,0,1,2,3"), "poses.csv:3: column q1_deg is empty where a number is expected");
  EXPECT_EQ(with("40,0,0,nan,2,3"),
            "poses.csv:3: 'nan': column x_mm must be a finite number: where nothing was measured leave the row out");
  EXPECT_EQ(with("40,0,0,1,-Inf,3"),
            "poses.csv:3: '-Inf': column y_mm must be a finite number: where nothing was measured leave the row out");
  EXPECT_EQ(with("40,0,0,\"1,5\",2,3"), "poses.csv:3: '1,5': column x_mm is not a number");
}

std::string complaint_about_limits(const std::string& rows) {
  return complaint([&] {
    check_joint_limits(read_poses(table_of(rows), small_map(), {}, small_arm(), {}), small_arm(), "poses.csv");
  });
}

TEST(JointLimits, AllowAToleranceAndNoMore) {
  EXPECT_EQ(complaint_about_limits(kHeading + "\n184,-184.9,309,1,2,3\n"), "");
  EXPECT_EQ(
      complaint_about_limits(kHeading + "\n40,0,0,1,2,3\n10,-200,0,1,2,3\n"),
      "poses.csv:3: '-200 deg': is far outside the limits of joint 2, -180 deg to 180 deg; correct the data, or the "
      "limits in the robot file");
  EXPECT_THAT(complaint_about_limits(kHeading + "\n40,0,320,1,2,3\n"), HasSubstr("limits of joint 3, 0 mm to 300 mm"));
}

TEST(ReadPoses, RefusesMapsThatDoNotFit) {
  const std::string rows = kHeading + "\n40,0,0,1,2,3\n";
  ColumnMap map = small_map({"q1_deg", "q2_deg"});
  EXPECT_EQ(refusal(rows, map), "set.yaml:5: columns.joints must name 3 columns, not 2");
  map = small_map({"q1_deg", "q2_deg", "q1_deg"});
  EXPECT_EQ(refusal(rows, map), "set.yaml:5: 'q1_deg': is named twice under columns");
  map = small_map({"q1_deg", "q9_deg", "q3_mm"});
  EXPECT_EQ(refusal(rows, map), "set.yaml:5: 'q9_deg': is no column of poses.csv; the nearest is 'q1_deg'");
  map = small_map({"q1_deg", "q2_deg", "q3_mm"}, {});
  EXPECT_EQ(refusal(rows, map),
            "set.yaml:4: columns must name position, orientation, distances or contact: nothing was measured");
  map = small_map({"q1_deg", "q2_deg", "q3_mm"}, {"x_mm", "y_mm"});
  EXPECT_EQ(refusal(rows, map), "set.yaml:5: columns.position must name 3 columns, not 2");
}

TEST(ReadPoses, RefusesBrokenCircumstances) {
  const auto with = [](const char* heading, const std::string& value, const auto& assign) {
    ColumnMap map = small_map();
    assign(map);
    return refusal(kHeading + "," + heading + "\n40,0,0,1,2,3," + value + "\n", map);
  };
  const auto approach = [](ColumnMap& map) { map.approach = columns_named({"s1", "s2", "s3"}); };
  const auto orientation = [](ColumnMap& map) { map.orientation = columns_named({"qw", "qx", "qy", "qz"}); };
  const auto distance = [](ColumnMap& map) { map.distances = columns_named({"l1_mm"}); };
  const auto payload = [](ColumnMap& map) { map.payload = column("payload_kg"); };
  const auto set = [](ColumnMap& map) { map.set = column("set"); };
  const auto pose = [](ColumnMap& map) { map.pose = column("pose"); };
  const auto target = [](ColumnMap& map) { map.target = column("target"); };
  EXPECT_EQ(with("s1,s2,s3", "1,0.5,0", approach),
            "poses.csv:2: '0.5': column s2 must be -1, 0 or 1: the sign of the joint's last motion");
  EXPECT_THAT(with("qw,qx,qy,qz", "0.7,0.7,0.7,0", orientation), HasSubstr("must be a unit quaternion w, x, y, z"));
  EXPECT_EQ(with("l1_mm", "0", distance), "poses.csv:2: '0': column l1_mm must be positive: it is a measured length");
  const auto torque = [](ColumnMap& map) { map.torque = columns_named({"t1_n", "t2", "t3"}); };
  EXPECT_EQ(with("t1_n,t2,t3", "1,2,3", torque),
            "set.yaml:5: 't1_n': ends in a unit of a force; it is expected to hold a torque and end in _nm");
  EXPECT_EQ(with("payload_kg", "-1", payload),
            "poses.csv:2: '-1': column payload_kg must not be negative: it is a mass");
  EXPECT_EQ(with("payload_kg", "1e9", payload),
            "poses.csv:2: '1e9': column payload_kg is more than any robot carries (100 t): is it in kg?");
  const auto temperature = [](ColumnMap& map) { map.temperature = column("temperature"); };
  EXPECT_EQ(with("temperature", "-300", temperature),
            "poses.csv:2: '-300': column temperature is no temperature of an arm: is it in deg C?");
  EXPECT_EQ(
      refusal(kHeading + "\n40,0,0,1,2,1e300\n"),
      "poses.csv:2: '1e300': column z_mm is farther than any instrument measures (100 km): correct it, or leave the "
      "row out");
  EXPECT_EQ(with("set", "training", set),
            "poses.csv:2: 'training': column set must be calibration, validation or accept");
  EXPECT_EQ(with("pose", "", pose), "poses.csv:2: column pose is empty where the name of a pose is expected");
  EXPECT_EQ(with("target", "B", target), "poses.csv:2: 'B': is no target of tools_mm; the nearest is 'A'");
  EXPECT_EQ(with("target", "", target), "");
}

TEST(ReadPoses, RefusesTemperaturesAndPayloadsThatAreOfAnotherUnitUnlessTheHeadingSaysTheUnit) {
  const auto with = [](const std::string& heading, const std::string& value, bool warm) {
    ColumnMap map = small_map();
    (warm ? map.temperature : map.payload) = column(heading);
    return refusal(kHeading + "," + heading + "\n40,0,0,1,2,3," + value + "\n", map);
  };
  for (const char* value : {"75.2", "297.15"})
    EXPECT_EQ(
        with("temperature", value, true),
        "poses.csv:2: '" + std::string(value) +
            "': column temperature is above 60 deg C, warmer than arms are, and the heading states no unit: end the "
            "name in _f or _k, or in _celsius if it is right");
  EXPECT_THAT(with("payload", "5000", false), HasSubstr("'5000': column payload is above 2300 kg"));
  EXPECT_EQ(with("temperature", "59.5", true), "");
  EXPECT_EQ(with("temperature_celsius", "75.2", true), "");
  EXPECT_EQ(with("temperature_f", "75.2", true), "");
  EXPECT_EQ(with("temperature_k", "297.15", true), "");
  EXPECT_EQ(with("payload", "2300", false), "");
  EXPECT_EQ(with("payload_kg", "5000", false), "");
  EXPECT_EQ(with("payload_g", "5000", false), "");
}

TEST(ReadPoses, SaysThatANumberHasItsThousandsApart) {
  const auto with = [](const std::string& value) {
    return refusal(kHeading + "\n40,0,0,1,2,3\n40,0,0,\"" + value + "\",2,3\n");
  };
  for (const char* value : {"3,070.733", "-1,003,070", "+3'070.733", "3 070.733"})
    EXPECT_EQ(with(value), "poses.csv:3: '" + std::string(value) +
                               "': column x_mm looks like a number with separators of thousands: export the table "
                               "without them");
  for (const char* value : {"3,07", "3070,733", "3,070'733", ",070", "a,070"})
    EXPECT_THAT(with(value), HasSubstr("is not a number")) << value;
}

TEST(ReadPoses, HoldsRepeatsOfAPoseTogether) {
  ColumnMap map = small_map();
  map.pose = column("pose");
  map.set = column("set");
  const std::string first = kHeading + ",pose,set\n40,0,0,1,2,3,a,accept\n";
  EXPECT_EQ(refusal(first + "40.00000001,0,0,1.1,2,3,a,accept\n", map), "");
  EXPECT_EQ(refusal(first + "40.1,0,0,1.1,2,3,a,accept\n", map),
            "poses.csv:3: 'a': joints differ from those of line 2, which has the same pose id");
  EXPECT_EQ(refusal(first + "40,0,0,1.1,2,3,a,validation\n", map),
            "poses.csv:3: 'a': is in another set than line 2, which has the same pose id");
}

TEST(ReadPoses, ReadsUncertaintiesOfCoordinatesOrOfAnInstrument) {
  ColumnMap map = small_map();
  map.sigma = columns_named({"s_mm"});
  const std::string row = "\n90,-45,100,300,400,0,";
  const auto one = read(kHeading + ",s_mm" + row + "0.1\n", map);
  EXPECT_LT((*one[0].position_covariance_m2 - 1e-8 * Eigen::Matrix3d::Identity()).norm(), 1e-20);
  map.sigma = columns_named({"sx_mm", "sy_mm", "sz_m"});
  const auto axes = read(kHeading + ",sx_mm,sy_mm,sz_m" + row + "0.1,0.2,0.001\n", map);
  EXPECT_LT((axes[0].position_covariance_m2->diagonal() - Eigen::Vector3d(1e-8, 4e-8, 1e-6)).norm(), 1e-18);
  map.sigma = columns_named({"range_mm", "azimuth_rad", "elevation_rad"});
  const auto instrument = read(kHeading + ",range_mm,azimuth_rad,elevation_rad" + row + "0.1,0.0004,0.0006\n", map);
  const Eigen::Matrix3d& covariance = *instrument[0].position_covariance_m2;
  const Eigen::Vector3d along(0.6, 0.8, 0.0), across(-0.8, 0.6, 0.0);
  EXPECT_NEAR(along.dot(covariance * along), 1e-8, 1e-18);
  EXPECT_NEAR(across.dot(covariance * across), 4e-8, 1e-18);  // 0.5 m away
  EXPECT_NEAR(covariance(2, 2), 9e-8, 1e-18);
}

TEST(ReadPoses, RefusesUncertaintiesThatAreNone) {
  ColumnMap map = small_map();
  map.sigma = columns_named({"s_mm"});
  EXPECT_THAT(refusal(kHeading + ",s_mm\n90,-45,100,1,2,3,0\n", map),
              HasSubstr("must be above 0: it is a standard uncertainty"));
  map.sigma = columns_named({"s_mm", "t_mm"});
  EXPECT_THAT(refusal(kHeading + ",s_mm,t_mm\n90,-45,100,1,2,3,1,1\n", map), HasSubstr("columns.sigma"));
  map.position.clear();
  map.orientation = columns_named({"x_mm", "y_mm", "z_mm", "q1_deg"});
  map.sigma = columns_named({"s_mm"});
  EXPECT_THAT(refusal(kHeading + ",s_mm\n90,-45,100,1,2,3,1\n", map), HasSubstr("is the uncertainty of a position"));
}

TEST(CheckRepeats, RefusesPointsOfOneNameThatLieApartInJoinedFiles) {
  std::vector<MeasuredPose> poses(2);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].pose_id = "P11";
    poses[i].line = 15 + 27 * i;
    poses[i].joints = JointVector::Zero(6);
    poses[i].position_m = Eigen::Vector3d(i == 0 ? 0.0 : 0.941, 0.2, 0.3);
  }
  check_repeats(poses, "tracker.txt");
  EXPECT_THAT(
      complaint([&] { check_repeats(poses, "tracker.txt", true); }),
      HasSubstr("tracker.txt:42: 'P11': was measured 941 mm from the point of line 15, which has the same name"));
  poses[1].position_m->x() = 1e-3;
  check_repeats(poses, "tracker.txt", true);
}

}  // namespace
}  // namespace demecal

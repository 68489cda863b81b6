// From counts, programs and taught points back to what a simulated arm did; and what does not match is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../errors/complaint.hpp"
#include "measured_arm.hpp"
#include "preparation/results.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(Prepared, GivesBackWhatTheArmDidInAllThreeFrames) {
  RandomStream stream{64, 1};
  for (int i = 0; i < 20; ++i) {
    const MeasuredArm arm = measured_arm(stream, 12, 2e-3);
    const RawMeasurements raw = raw_of(arm);
    const Prepared prepared = prepare_measurements(raw);
    const DataSet seen = prepared_data_set(raw, prepared, std::nullopt);
    const DataSet based = prepared_data_set(raw, prepared, FrameKind::three_points);
    const DataSet fitted = prepared_data_set(raw, prepared, FrameKind::best_fit);
    ASSERT_THAT(seen.poses, SizeIs(12));
    EXPECT_EQ(seen.frame, Frame::sensor);
    EXPECT_EQ(based.frame, Frame::base);
    EXPECT_EQ(seen.poses[2].pose_id, "#cp[3]");
    for (std::size_t p = 0; p < 12; ++p) {
      EXPECT_LT((seen.poses[p].joints - arm.joints[p]).norm(), 1e-12);
      EXPECT_LT((*seen.poses[p].position_m - arm.seen_m[p]).norm(), 1e-9);
      const Eigen::Vector3d in_base = arm.instrument_from_base.inverse() * arm.seen_m[p];
      EXPECT_LT((*based.poses[p].position_m - in_base).norm(), 1e-9);
      EXPECT_LT((*fitted.poses[p].position_m - in_base).norm(), 1e-2);
    }
  }
}

TEST(Prepared, FindsNoErrorWhereThereIsNone) {
  RandomStream stream{64, 2};
  const RawMeasurements raw = raw_of(measured_arm(stream, 10, 0.0));
  const ErrorStatistic statistic = error_statistic(raw, prepare_measurements(raw));
  EXPECT_LT(statistic.sets.at(0).three_points->error.max_mm, 1e-6);
  EXPECT_LT(statistic.sets.at(0).best_fit->error.max_mm, 1e-6);
  EXPECT_LT(statistic.apart->max_mm, 1e-6);
}

TEST(Prepared, ShowsThatTheThreePointFrameCarriesTheErrorOfItsPoints) {
  RandomStream stream{64, 3};
  RawMeasurements raw = raw_of(measured_arm(stream, 40, 1e-3));
  raw.local_frame->in_instrument_m[2] += Eigen::Vector3d(0, 0, 4e-3);
  const ErrorStatistic statistic = error_statistic(raw, prepare_measurements(raw));
  const SetStatistic& set = statistic.sets.at(0);
  EXPECT_GT(set.three_points->error.rms_mm, set.best_fit->error.rms_mm + 0.3);
  EXPECT_GT(statistic.apart->max_mm, 1.0);
  EXPECT_THAT(statistic_table(statistic, "cords"), HasSubstr("It carries the errors of its"));
}

TEST(Prepared, StatesTheErrorsThatTheArmHas) {
  RandomStream stream{64, 4};
  const MeasuredArm arm = measured_arm(stream, 15, 2e-3);
  const Prepared prepared = prepare_measurements(raw_of(arm));
  const auto errors_m = differences(prepared, FrameKind::three_points);
  for (std::size_t p = 0; p < 15; ++p) {
    const Eigen::Vector3d error_m = arm.instrument_from_base.inverse() * arm.seen_m[p] - arm.nominal_m(p);
    EXPECT_LT((errors_m[p] - error_m).norm(), 1e-9);
  }
}

TEST(Prepared, KeepsRepeatsOrAveragesThem) {
  RandomStream stream{64, 5};
  const MeasuredArm arm = measured_arm(stream, 6, 1e-3);
  RawMeasurements raw = raw_of(arm);
  std::string text = "pose,a_counts,b_counts,c_counts\n";
  std::vector<Eigen::Vector3d> sums_m(6, Eigen::Vector3d::Zero());
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (std::size_t p = 0; p < 6; ++p) {
      const Eigen::Vector3d point_m = arm.seen_m[p] + random_point(stream, 1e-4);
      sums_m[p] += point_m;
      text += "cp[" + std::to_string(p + 1) + "]," + arm.counts(point_m) + "\n";
    }
  }
  raw.sets[0].readings = read_readings(table_of(text), arm.cords);
  const Prepared prepared = prepare_measurements(raw);
  const DataSet averaged = prepared_data_set(raw, prepared, std::nullopt);
  EXPECT_EQ(averaged.file, raw.sets.front().joints.program.file) << "the lines of the poses are that file's";
  ASSERT_THAT(averaged.poses, SizeIs(6));
  for (std::size_t p = 0; p < 6; ++p) EXPECT_LT((*averaged.poses[p].position_m - sums_m[p] / 3.0).norm(), 1e-9);
  raw.repeats = Repeats::keep;
  const DataSet kept = prepared_data_set(raw, prepared, std::nullopt);
  ASSERT_THAT(kept.poses, SizeIs(18));
  EXPECT_EQ(kept.poses[0].pose_id, kept.poses[2].pose_id);
  EXPECT_NE(*kept.poses[0].position_m, *kept.poses[2].position_m);
  const SetStatistic set = error_statistic(raw, prepared).sets.at(0);
  EXPECT_EQ(set.readings, 18u);
  EXPECT_GT(*set.spread_mm, 0.03);
  EXPECT_LT(*set.spread_mm, 0.2);
}

TEST(Prepared, TellsPosesOfSeveralSetsApart) {
  RandomStream stream{64, 6};
  RawMeasurements raw = raw_of(measured_arm(stream, 6, 1e-3));
  raw.sets.push_back(raw.sets[0]);
  raw.sets[1].set = PoseSet::validation;
  const DataSet data = prepared_data_set(raw, prepare_measurements(raw), FrameKind::best_fit);
  EXPECT_EQ(data.poses.front().pose_id, "1:#cp[1]");
  EXPECT_EQ(data.poses.back().pose_id, "2:#cp[6]");
  EXPECT_THAT(poses_of(data, PoseSet::validation), SizeIs(6));
}

TEST(Prepared, RefusesMirroredMeasurements) {
  RandomStream stream{64, 7};
  MeasuredArm arm = measured_arm(stream, 10, 1e-3);
  arm.cords.side = PlaneSide::below;
  EXPECT_THAT(complaint([&] { prepare_measurements(raw_of(arm)); }), HasSubstr("in a mirror"));
}

TEST(Prepared, RefusesJointsThatTheDataSetCouldNotHold) {
  RandomStream stream{64, 8};
  MeasuredArm arm = measured_arm(stream, 10, 1e-3);
  arm.robot.chain.joints[0].upper = 0.01 + arm.joints[0][0];
  arm.joints[4][0] = arm.robot.chain.joints[0].upper + 0.5;
  EXPECT_THAT(complaint([&] { prepare_measurements(raw_of(arm)); }), HasSubstr("outside the limits of joint 1"));
}

TEST(FalseTargets, AreNominalLessErrorInTheScaleAndRoundingOfTheFile) {
  RandomStream stream{64, 9};
  const MeasuredArm arm = measured_arm(stream, 8, 2e-3);
  RawMeasurements raw = raw_of(arm);
  raw.sets[0].poses = point_file(arm.val2_poses("mcp"), arm.robot.chain, "mcp.v2");
  const Prepared prepared = prepare_measurements(raw);
  const std::vector<WrittenFile> files = false_targets(raw, prepared, FrameKind::three_points);
  ASSERT_THAT(files, SizeIs(1));
  EXPECT_EQ(files[0].name, "corrected.v2");
  const Program written = read_program(WrittenIn::val2, files[0].text, "corrected.v2", arm.robot.chain);
  const Program before = raw.sets[0].poses->program;
  ASSERT_EQ(written.targets.size(), 8u);
  for (std::size_t p = 0; p < 8; ++p) {
    const Eigen::Vector3d true_base_m = arm.instrument_from_base.inverse() * arm.seen_m[p];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double nominal_m = before.targets[p].position[axis].inside();
      const double expected_m = nominal_m - (true_base_m[static_cast<Eigen::Index>(axis)] - nominal_m);
      EXPECT_NEAR(written.targets[p].position[axis].inside(), expected_m, 1e-3 / 32.0 + 1e-9);
    }
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_EQ(written.targets[p].orientation[i].value, before.targets[p].orientation[i].value);
    }
  }
  EXPECT_TRUE(files[0].text.starts_with(".PROGRAM t1\n MOVE mcp[1]\n.END\n.LOCATIONS\nmcp[1] 16384 0 0 0 -16384 "));
}

TEST(FalseTargets, AreFoundBesideTheJointsAndElseArePositions) {
  RandomStream stream{64, 10};
  const MeasuredArm arm = measured_arm(stream, 5, 2e-3);
  RawMeasurements raw = raw_of(arm);
  const auto plain = false_targets(raw, prepare_measurements(raw), FrameKind::three_points);
  ASSERT_THAT(plain, SizeIs(1));
  EXPECT_EQ(plain[0].name, "corrected.csv");
  EXPECT_THAT(table_of(plain[0].text).rows, SizeIs(5));
  raw.sets[0].joints = point_file(arm.val2() + arm.val2_poses("mcp"), arm.robot.chain, "both.v2");
  const auto both = false_targets(raw, prepare_measurements(raw), FrameKind::three_points);
  ASSERT_THAT(both, SizeIs(1));
  EXPECT_EQ(both[0].name, "corrected.v2");
  EXPECT_TRUE(both[0].text.starts_with(arm.val2()));
}

TEST(NamedPoints, NameWhatDoesNotMatch) {
  RandomStream stream{64, 11};
  const MeasuredArm arm = measured_arm(stream, 4, 1e-3);
  const Program program = raw_of(arm).sets[0].joints.program;
  const auto points = named_points(program, PointKind::joints, "CP");
  const auto match = [&](const std::string& text) {
    return complaint([&] { rows_of_points(read_readings(table_of(text), {}), points, "cp.v2"); });
  };
  EXPECT_EQ(match("x_mm,y_mm,z_mm\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n"), "");
  EXPECT_THAT(match("x_mm,y_mm,z_mm\n1,2,3\n"), HasSubstr("has 1 reading, but cp.v2 has 4 points"));
  EXPECT_THAT(match("pose,x_mm,y_mm,z_mm\n5,1,2,3\n"), HasSubstr("readings.csv:2: '5': is no point of cp.v2"));
  EXPECT_THAT(match("pose,x_mm,y_mm,z_mm\n1,1,2,3\n2,1,2,3\ncp[4],1,2,3\n"),
              HasSubstr("'#cp[3]': is a point of cp.v2 without a reading"));
  EXPECT_THAT(complaint([&] { named_points(program, PointKind::joints, "ccp"); }),
              HasSubstr("has no points of joints of that name; the nearest is 'cp'"));
  const Program doubled = point_file(arm.val2() + ".LOCATIONS\n#cp[2] 1 2 3 4 5 6\n", arm.robot.chain, "d.v2").program;
  EXPECT_THAT(complaint([&] { named_points(doubled, PointKind::joints, ""); }),
              HasSubstr("d.v2:11: '#cp[2]': stands with other numbers in line 6"));
  const Program again = point_file(arm.val2() + arm.val2(), arm.robot.chain, "a.v2").program;
  EXPECT_THAT(named_points(again, PointKind::joints, ""), SizeIs(4));
}

TEST(Prepared, RefusesPointsThatTheProgramChanges) {
  RandomStream stream{64, 12};
  const MeasuredArm arm = measured_arm(stream, 4, 1e-3);
  const auto told = [&](const std::string& statements) {
    RawMeasurements raw = raw_of(arm);
    raw.sets[0].joints = point_file(".PROGRAM m\n" + statements + ".END\n" + arm.val2() + arm.val2_poses("mcp"),
                                    arm.robot.chain, "cp.v2");
    return complaint([&] { prepare_measurements(raw); });
  };
  EXPECT_EQ(told(" MOVE #cp[1]\n SET x = #cp[1]\n"), "");
  EXPECT_EQ(told(" HERE #other\n"), "");
  EXPECT_EQ(told(" HERE #cp[2]\n"), "") << "where the arm stood is what was measured";
  EXPECT_THAT(told(" HERE #cp[2]\n SET #cp[2] = #x\n"), HasSubstr("'#cp[2]': line 2 changes it"));
  EXPECT_THAT(told(" SET #cp[2] = #x\n"), AllOf(HasSubstr("'#cp[2]': line 2 changes it when the program runs"),
                                                HasSubstr("need not be those at which it was measured")));
  EXPECT_THAT(told(" SET #cp[n] = #x\n"), HasSubstr("line 2 changes it"));
  EXPECT_THAT(told(" SET mcp[3] = x\n"), HasSubstr("'mcp[3]': line 2 changes it"));
  const Program frame = point_file(
                            ".PROGRAM m\n SET p[2] = x\n.END\n.LOCATIONS\np[1] 1 0 0 0 1 0 0 0 1 500 0 0\n"
                            "p[2] 1 0 0 0 1 0 0 0 1 900 0 0\np[3] 1 0 0 0 1 0 0 0 1 500 300 0\n.END\n",
                            arm.robot.chain, "f.v2")
                            .program;
  EXPECT_THAT(complaint([&] { robot_points(frame, "p", arm.robot); }), HasSubstr("f.v2:6: 'p[2]': line 2 changes it"));
}

TEST(Prepared, TakesProgrammedPosesInTheFrameThatTheirProgramStates) {
  RandomStream stream{64, 13};
  const MeasuredArm arm = measured_arm(stream, 6, 1e-3);
  RawMeasurements raw = raw_of(arm);
  raw.sets[0].poses = point_file(arm.val2_poses("mcp"), arm.robot.chain, "mcp.v2");
  const Prepared plain = prepare_measurements(raw);
  const auto with_base = [&](const std::string& base) {
    std::string text = arm.val2_poses("mcp");
    return text.insert(text.find(" MOVE"), base);
  };
  const std::string moved = with_base(" BASE 100,-20,5,30\n");
  raw.sets[0].poses = point_file(moved, arm.robot.chain, "mcp.v2");
  const Prepared based = prepare_measurements(raw);
  const Eigen::Isometry3d world_from_base =
      Eigen::Translation3d(0.1, -0.02, 0.005) * Eigen::AngleAxisd(radians(30.0), Eigen::Vector3d::UnitZ());
  for (std::size_t i = 0; i < plain.poses.size(); ++i)
    EXPECT_LT((world_from_base * based.poses[i].nominal_m - plain.poses[i].nominal_m).norm(), 1e-12);
  const std::vector<WrittenFile> files = false_targets(raw, based, FrameKind::three_points);
  ASSERT_THAT(files, SizeIs(1));
  const Program written = read_program(WrittenIn::val2, files[0].text, "corrected.v2", arm.robot.chain);
  const std::vector<Eigen::Vector3d> errors_m = differences(based, FrameKind::three_points);
  for (std::size_t i = 0; i < errors_m.size(); ++i)
    EXPECT_LT((stated_point(written.targets.at(i)) - (based.poses[i].nominal_m - errors_m[i])).norm(), 1e-4);
  raw.sets[0].poses = point_file(with_base(" BASE x,y,z\n"), arm.robot.chain, "mcp.v2");
  EXPECT_THAT(complaint([&] { prepare_measurements(raw); }), HasSubstr("BASE is computed when the program runs"));
}

TEST(TaughtPoints, NameTheFault) {
  const RobotPoints robot = robot_points(ThreePoints{Eigen::Vector3d(0.5, 0, 0), {0.9, 0, 0}, {0.5, 0.3, 0}}, "p.yaml");
  const auto teach = [&](const std::string& rows) {
    const Readings readings = read_readings(table_of("x_mm,y_mm,z_mm\n" + rows), {});
    return complaint([&] { taught_points(robot, readings, 2e-3); });
  };
  EXPECT_EQ(teach("0,0,0\n400,0,1\n0,300,0\n"), "");
  EXPECT_THAT(teach("0,0,0\n400,0,0\n800,0,0\n"), HasSubstr("readings.csv: the three points of the local frame stand"));
  EXPECT_THAT(
      teach("0,0,0\n400,0,0\n0,303,0\n"),
      HasSubstr("points 3 and 1 of the local frame are 303.000 mm apart as measured, but 300.000 mm in p.yaml"));
}

}  // namespace
}  // namespace demecal

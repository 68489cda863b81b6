// One robot measured from several places: joined as one data set, fitted as one, and seen again by each of them.
#include "fitting/stations.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "errors/input_error.hpp"
#include "fitting/known_arm.hpp"
#include "fitting/placed_arm.hpp"
#include "parameters/observation.hpp"

namespace demecal {
namespace {

constexpr double kExactStation_m = 1e-7;

/// What a station measured of `arm` without noise; base and tool are its own.
DataSet measured_at(const KnownArm& arm, RandomStream& stream, const std::string& name, int poses, bool orientation) {
  KnownArm there = placed_at(arm, stream, name);
  measure(there, stream, {.orientation = orientation}, poses);
  for (std::size_t i = 0; i < there.data.poses.size(); ++i) there.data.poses[i].pose_id = std::to_string(i + 1);
  return there.data;
}

KnownArm misbuilt(RandomStream& stream, const Chain& chain) {
  KnownArm arm = perfect_arm(chain, Frame::sensor);
  misbuild(arm, stream, kAll);
  return arm;
}

double largest_miss_m(const CorrectedRobot& robot, const DataSet& data) {
  double largest = 0.0;
  for (const MeasuredPose& pose : data.poses) largest = std::max(largest, tool_error_m(robot, data, pose));
  return largest;
}

Fit fit_of(const DataSet& data) {
  return fit_declared(data, all_poses(data), kAll, nominal_robot(data));
}

TEST(Stations, OfAWrongArmAreFittedAsOneToTheLastDigit) {
  RandomStream stream{2101};
  for (const Chain& chain : {parallel_arm(), modified_arm(), seven_joint_arm()}) {
    const KnownArm arm = misbuilt(stream, chain);
    const bool orientation = stream.index(2) == 0;
    const DataSet joined =
        joined_stations({measured_at(arm, stream, "A", 25, orientation), measured_at(arm, stream, "B", 25, orientation),
                         measured_at(arm, stream, "C", 25, orientation)},
                        StationTools::own);
    ASSERT_EQ(joined.poses.size(), 75U);
    const Fit fit = fit_of(joined);
    EXPECT_EQ(fit.status, FitStatus::converged) << fit.sentence;
    EXPECT_LT(largest_miss_m(fit.robot, joined), kExactStation_m);
  }
}

TEST(Stations, AreSeenAgainByTheModelAloneAndTogether) {
  RandomStream stream{2102};
  const KnownArm arm = misbuilt(stream, parallel_arm());
  const DataSet a = measured_at(arm, stream, "A", 30, false), b = measured_at(arm, stream, "B", 30, false);
  const DataSet joined = joined_stations({a, b}, StationTools::own);
  const Fit fit = fit_of(joined);
  const std::vector<Station> found = stations_as_found(fit.robot, joined);
  ASSERT_EQ(found.size(), 2U);
  for (const DataSet& data : {a, b, joined}) {
    EXPECT_LT(largest_miss_m(seen_from_stations(fit.robot, found, data), data), kExactStation_m) << data.name;
  }
  const DataSet other = measured_at(arm, stream, "D", 30, false);
  EXPECT_THROW(seen_from_stations(fit.robot, found, joined_stations({a, other}, StationTools::own)), InputError);
}

TEST(Stations, MoveRowsAsDifferencesShow) {
  constexpr double kStep = 1e-6;
  RandomStream stream{2103};
  const KnownArm arm = misbuilt(stream, modified_arm());
  const DataSet joined = joined_stations(
      {measured_at(arm, stream, "A", 20, true), measured_at(arm, stream, "B", 20, true)}, StationTools::own);
  const Fit fit = fit_of(joined);
  const ParameterSpace space(fit.robot, free_parameters(joined, kAll));
  const RowScales scales{2.0, 0.5, 0.0};
  const Eigen::VectorXd change = Eigen::VectorXd::Zero(space.size());
  int of_stations = 0;
  for (std::size_t pose = 0; pose < joined.poses.size(); ++pose) {
    const Observation observation{pose, joined.poses[pose].joints};
    ScaledRows rows, before, after;
    scaled_rows(joined, space, space.at(change), observation, scales, rows);
    for (int i = 0; i < space.size(); ++i) {
      if (space.ids()[static_cast<std::size_t>(i)].kind != ParameterId::Kind::station) continue;
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space.size(), i);
      scaled_residual(joined, space.at(change - step).robot, observation, scales, before);
      scaled_residual(joined, space.at(change + step).robot, observation, scales, after);
      const Eigen::VectorXd slope = (after.residual - before.residual) / (2 * kStep);
      EXPECT_LT((rows.jacobian.col(i) - slope).norm(), 1e-6) << space.ids()[static_cast<std::size_t>(i)].name();
      ++of_stations;
    }
  }
  EXPECT_EQ(of_stations, 6 * 40);
}

TEST(Stations, ShareATool) {
  RandomStream stream{2104};
  const KnownArm arm = misbuilt(stream, parallel_arm());
  DataSet a = measured_at(arm, stream, "A", 20, false), b = measured_at(arm, stream, "B", 20, false);
  const DataSet joined = joined_stations({a, b}, StationTools::shared);
  std::set<std::string> targets;
  for (const MeasuredPose& pose : joined.poses) targets.insert(pose.target);
  EXPECT_EQ(targets, std::set<std::string>{""});
  b.robot.chain.tool_m.x() += 0.01;
  EXPECT_THROW(joined_stations({a, b}, StationTools::shared), InputError);
  EXPECT_NO_THROW(joined_stations({a, b}, StationTools::own));
}

TEST(Stations, KeepNamesApartAndClocksOut) {
  RandomStream stream{2105};
  const KnownArm arm = misbuilt(stream, parallel_arm());
  DataSet a = measured_at(arm, stream, "A", 20, false), b = measured_at(arm, stream, "A", 20, false);
  for (std::size_t i = 0; i < 20; ++i) {
    a.poses[i].time_s = static_cast<double>(i);
    b.poses[i].time_s = static_cast<double>(i) + 100.0;
  }
  const DataSet apart = joined_stations({a, b}, StationTools::own);
  std::set<std::string> ids;
  for (const MeasuredPose& pose : apart.poses) ids.insert(pose.pose_id);
  EXPECT_EQ(ids.size(), 40U);
  EXPECT_TRUE(apart.poses.back().time_s);
  EXPECT_NE(apart.stations[0].name, apart.stations[1].name);
  for (MeasuredPose& pose : b.poses) *pose.time_s -= 90.0;
  EXPECT_FALSE(joined_stations({a, b}, StationTools::own).poses.front().time_s);
}

TEST(Stations, OfAnotherArmOrOfDistancesAreRefused) {
  RandomStream stream{2106};
  const KnownArm arm = misbuilt(stream, parallel_arm());
  const DataSet a = measured_at(arm, stream, "A", 20, false);
  DataSet b = measured_at(arm, stream, "B", 20, false), c = b;
  b.robot.chain.joints[2].a_m += 0.01;
  EXPECT_THROW(joined_stations({a, b}, StationTools::own), InputError);
  c.poses[3].distances_m = {1.0};
  EXPECT_THROW(joined_stations({a, c}, StationTools::own), InputError);
}

}  // namespace
}  // namespace demecal

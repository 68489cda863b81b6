// How much each station's rows scatter, and that poses count by it.
#include "residuals/diagnosed_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fitting/known_arm.hpp"
#include "fitting/placed_arm.hpp"
#include "fitting/station_scales.hpp"
#include "fitting/stations.hpp"

namespace demecal {
namespace {

constexpr double kPrecise_m = 2e-5, kCoarse_m = 2e-4;

/// What a station measured of `arm`, base and tool its own; its accept poses without noise.
DataSet measured_at(const KnownArm& arm, RandomStream& stream, const std::string& name, const Instrument& instrument,
                    int poses) {
  constexpr int kUnseen = 200;
  KnownArm there = placed_at(arm, stream, name);
  measure(there, stream, instrument, poses);
  measure(there, stream, {.orientation = instrument.orientation}, kUnseen);
  for (std::size_t i = 0; i < there.data.poses.size(); ++i) {
    there.data.poses[i].pose_id = std::to_string(i + 1);
    if (i >= static_cast<std::size_t>(poses)) there.data.poses[i].set = PoseSet::accept;
  }
  return there.data;
}

KnownArm misbuilt(RandomStream& stream) {
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  misbuild(arm, stream, kAll);
  return arm;
}

DiagnosedModel fitted(const DataSet& data) {
  const DiagnosisProblem problem{data, kAll, poses_of(data, PoseSet::calibration), {}};
  return refined(problem, diagnosed_model(problem, fit_declared(data, problem.fitted, kAll, nominal_robot(data))), 12);
}

/// Where all poses count alike: their stations' frames are free, but nothing says that they scatter differently.
DiagnosedModel fitted_alike(DataSet data) {
  data.stations.clear();
  return fitted(data);
}

/// Root mean square at the unseen poses of a station.
double unseen_error_m(const DiagnosedModel& model, const DataSet& data, const std::string& station) {
  double squares = 0.0;
  int poses = 0;
  for (const std::size_t pose : poses_of(data, PoseSet::accept)) {
    if (data.poses[pose].station != station) continue;
    squares += std::pow(tool_error_m(model.robot, data, data.poses[pose]), 2);
    ++poses;
  }
  return std::sqrt(squares / poses);
}

MeasuredPose pose_of(const std::string& station) {
  MeasuredPose pose;
  pose.station = station;
  return pose;
}

double scale_m(const RowScales& scales, const std::string& station) {
  return scales.of(pose_of(station), kPosition);
}

TEST(StationScales, MakePosesCountByWhatTheirStationScatters) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream stream{2110, seed};
    const KnownArm arm = misbuilt(stream);
    const bool precise_first = seed % 2 == 1;
    const DataSet first = measured_at(arm, stream, "A", {.noise_m = precise_first ? kPrecise_m : kCoarse_m}, 60);
    const DataSet second = measured_at(arm, stream, "B", {.noise_m = precise_first ? kCoarse_m : kPrecise_m}, 60);
    const DataSet joined = joined_stations({first, second}, StationTools::own);
    const std::string precise = precise_first ? "" : "B", coarse = precise_first ? "B" : "";
    const DiagnosedModel model = fitted(joined);
    EXPECT_LT(unseen_error_m(model, joined, precise), 0.5 * unseen_error_m(fitted_alike(joined), joined, precise))
        << seed;
    EXPECT_NEAR(scale_m(model.scales, precise), kPrecise_m, 0.3 * kPrecise_m) << seed;
    EXPECT_NEAR(scale_m(model.scales, coarse), kCoarse_m, 0.3 * kCoarse_m) << seed;
  }
}

TEST(StationScales, OfLikeStationsChangeHardlyAnything) {
  double apart = 0.0, alike = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream stream{2111, seed};
    const KnownArm arm = misbuilt(stream);
    const DataSet joined = joined_stations({measured_at(arm, stream, "A", {.noise_m = kPrecise_m}, 60),
                                            measured_at(arm, stream, "B", {.noise_m = kPrecise_m}, 60)},
                                           StationTools::own);
    const DiagnosedModel model = fitted(joined);
    apart += std::pow(unseen_error_m(model, joined, ""), 2);
    alike += std::pow(unseen_error_m(fitted_alike(joined), joined, ""), 2);
    EXPECT_NEAR(scale_m(model.scales, "B") / scale_m(model.scales, ""), 1.0, 0.25) << seed;
  }
  EXPECT_NEAR(std::sqrt(apart / alike), 1.0, 0.02);
}

TEST(StationScales, OfOrientationsAreTheirOwn) {
  RandomStream stream{2112};
  const KnownArm arm = misbuilt(stream);
  const Instrument turns_well{.noise_m = kPrecise_m, .noise_rad = 5e-5, .orientation = true};
  const Instrument turns_badly{.noise_m = kPrecise_m, .noise_rad = 1e-3, .orientation = true};
  const DataSet joined =
      joined_stations({measured_at(arm, stream, "A", turns_well, 60), measured_at(arm, stream, "B", turns_badly, 60)},
                      StationTools::own);
  const RowScales scales = fitted(joined).scales;
  EXPECT_NEAR(scale_m(scales, "B") / scale_m(scales, ""), 1.0, 0.25);
  EXPECT_NEAR(scales.of(pose_of(""), kOrientation), 5e-5, 2e-5);
  EXPECT_NEAR(scales.of(pose_of("B"), kOrientation), 1e-3, 3e-4);
}

TEST(StationScales, OfOneStationAreThoseOfItsRows) {
  RandomStream stream{2113};
  const KnownArm arm = misbuilt(stream);
  const DataSet alone =
      joined_stations({measured_at(arm, stream, "A", {.noise_m = kPrecise_m}, 60)}, StationTools::own);
  EXPECT_TRUE(fitted(alone).scales.stations.empty());
}

/// Sums of rows whose variance is `variance` times that of the present scale.
RowSums sums(double rows, double variance) {
  RowSums own;
  own.freedom[kPosition] = rows;
  own.squares[kPosition] = rows * variance;
  return own;
}

TEST(StationScales, OfFewRowsAreNearThoseOfAllAndNeverFarApart) {
  const RowScales present{1e-4, 0.0, 0.0};
  const RowScales few = rescaled({{"", sums(300, 1.0)}, {"B", sums(3, 9.0)}}, present);
  EXPECT_LT(scale_m(few, "B"), 2.0 * scale_m(few, ""));
  EXPECT_GT(scale_m(few, "B"), 1.1 * scale_m(few, ""));
  const RowScales many = rescaled({{"", sums(300, 1.0)}, {"B", sums(300, 9.0)}}, present);
  EXPECT_NEAR(scale_m(many, "B") / scale_m(many, ""), 3.0, 0.15);
  const RowScales exact = rescaled({{"", sums(1e6, 0.0)}, {"B", sums(300, 1.0)}}, present);
  EXPECT_GE(scale_m(exact, ""), exact[kPosition] / 20.0 * (1.0 - 1e-12));
  EXPECT_LE(scale_m(exact, "B"), exact[kPosition] * 20.0 * (1.0 + 1e-12));
  const RowScales nothing = rescaled({{"", sums(0, 0.0)}, {"B", sums(0, 0.0)}}, present);
  EXPECT_EQ(scale_m(nothing, ""), 1e-4);
  EXPECT_EQ(scale_m(nothing, "B"), 1e-4);
  EXPECT_EQ(nothing[kOrientation], 0.0);
}

TEST(StationScales, StayAsTheyAreWhereTheyAreRight) {
  const RowScales found = rescaled({{"", sums(3e5, 1.0)}, {"B", sums(3e5, 9.0)}}, {1e-4, 0.0, 0.0});
  const RowScales again = rescaled({{"", sums(3e5, 1.0)}, {"B", sums(3e5, 1.0)}}, found);
  EXPECT_TRUE(scales_settled(found, again, 0.02));
  EXPECT_NEAR(scale_m(again, ""), 1e-4, 1e-7);
  EXPECT_NEAR(scale_m(again, "B"), 3e-4, 1e-7);
  const RowScales other = rescaled({{"", sums(3e5, 9.0)}, {"B", sums(3e5, 1.0)}}, {1e-4, 0.0, 0.0});
  EXPECT_EQ(other[kPosition], found[kPosition]);
  EXPECT_FALSE(scales_settled(found, other, 0.02)) << "stations changed places";
}

}  // namespace
}  // namespace demecal

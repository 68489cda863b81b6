// The generators of the benchmark of noise do what they say: each by a statistical property, and its faults by example.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "data_check/check_data.hpp"
#include "kinematics/units.hpp"
#include "mistakes/measured_arm.hpp"
#include "noise/bad_poses.hpp"
#include "noise/joint_courses.hpp"
#include "noise/measurement_noise.hpp"
#include "noise/noise_figures.hpp"
#include "noise/noisy_measurement.hpp"

namespace demecal::bench {
namespace {

constexpr std::size_t kMany = 40'000;

double mean_square(const Offsets& offsets) {
  double sum = 0.0;
  for (const Eigen::Vector3d& offset : offsets) sum += offset.squaredNorm();
  return sum / (3.0 * static_cast<double>(offsets.size()));
}

/// Between each value and the next, over all axes.
double correlation_of_neighbours(const Offsets& offsets) {
  double sum = 0.0;
  for (std::size_t i = 1; i < offsets.size(); ++i) sum += offsets[i].dot(offsets[i - 1]);
  return sum / (3.0 * static_cast<double>(offsets.size() - 1) * mean_square(offsets));
}

TEST(WhiteNoise, HasItsDeviationAndNoMemory) {
  RandomStream random{1};
  const Offsets noise = white_noise(kMany, 0.5, random);
  EXPECT_NEAR(std::sqrt(mean_square(noise)), 0.5, 0.005);
  EXPECT_NEAR(correlation_of_neighbours(noise), 0.0, 0.01);
}

TEST(CorrelatedNoise, CorrelatesNeighboursAndIsStationaryFromItsFirstPoint) {
  RandomStream random{2};
  const Offsets noise = correlated_noise(kMany, 0.9, 0.5, random);
  EXPECT_NEAR(correlation_of_neighbours(noise), 0.9, 0.01);
  EXPECT_NEAR(std::sqrt(mean_square(noise)), 0.5, 0.03);
  Offsets firsts;
  for (int series = 0; series < 4000; ++series) firsts.push_back(correlated_noise(1, 0.9, 0.5, random)[0]);
  EXPECT_NEAR(std::sqrt(mean_square(firsts)), 0.5, 0.02);
}

TEST(StudentNoise, HasItsDeviationAndHeavyTails) {
  RandomStream random{3};
  const Offsets noise = student_noise(kMany, 0.5, random);
  EXPECT_NEAR(std::sqrt(mean_square(noise)), 0.5, 0.05);
  int far = 0, within = 0;
  for (const Eigen::Vector3d& offset : noise) {
    for (const double element : offset) {
      far += std::abs(element) > 5.0 * 0.5 ? 1 : 0;
      within += std::abs(element) < 0.7649 * 0.5 / std::sqrt(3.0) ? 1 : 0;
    }
  }
  // P(|t3| > 5 sqrt(3)) = 0.0032, where a normal has 6e-7; half of all lie within the quartile 0.7649.
  EXPECT_NEAR(far / (3.0 * kMany), 0.0032, 0.0008);
  EXPECT_NEAR(within / (3.0 * kMany), 0.5, 0.01);
}

TEST(TrackerNoise, GrowsWithTheDistance) {
  RandomStream random{4};
  const Offsets near = tracker_noise(Offsets(kMany, {0.0, 0.0, 1.0}), 0.1, 0.2, random);
  const Offsets far = tracker_noise(Offsets(kMany, {0.0, 3.0, 4.0}), 0.1, 0.2, random);
  EXPECT_NEAR(std::sqrt(mean_square(near)), 0.3, 0.005);
  EXPECT_NEAR(std::sqrt(mean_square(far)), 1.1, 0.02);
}

TEST(Drifts, BeginAtNothingAndEndWhereTheySay) {
  const Eigen::Vector3d end(1.0, -2.0, 0.5);
  const Offsets settling = settling_drift(1000, end, 50.0), steady = steady_drift(101, end);
  EXPECT_TRUE(settling[0].isZero());
  EXPECT_TRUE(settling[50].isApprox((1.0 - std::exp(-1.0)) * end, 1e-12));
  EXPECT_TRUE(settling.back().isApprox(end, 1e-6));
  EXPECT_TRUE(steady[0].isZero());
  EXPECT_TRUE(steady[25].isApprox(0.25 * end, 1e-12));
  EXPECT_TRUE(steady.back().isApprox(end));
}

TEST(GrossErrors, AreAsManyAndAsLargeAsTheyShould) {
  RandomStream random{5};
  const Offsets errors = gross_errors(kMany, 0.02, 1e-3, 1.0, random);
  int bad = 0, below_30_mm = 0;
  for (const Eigen::Vector3d& error : errors) {
    if (error.isZero(0.0)) continue;
    ++bad;
    EXPECT_GE(error.norm(), 0.999e-3);
    EXPECT_LE(error.norm(), 1.001);
    below_30_mm += error.norm() < std::sqrt(1e-3) ? 1 : 0;
  }
  EXPECT_EQ(bad, 800);
  EXPECT_NEAR(below_30_mm / 800.0, 0.5, 0.06);
}

const JointRanges kRanges(6, {-2.0, 1.0});

double correlation_of_steps(const std::vector<JointVector>& course) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < course.size(); ++i) {
    const JointVector here = course[i].array() + 0.5;  // from the middle of the ranges
    squares += here.squaredNorm();
    if (i + 1 < course.size()) sum += here.dot(JointVector(course[i + 1].array() + 0.5));
  }
  return sum / squares;
}

TEST(JointCourse, StaysWithinItsRangesAndFillsThem) {
  for (const Course course : {Course::random, Course::path, Course::grid}) {
    RandomStream random{6};
    const std::vector<JointVector> places = joint_course(course, kRanges, 2000, random);
    JointVector least = places[0], most = places[0];
    for (const JointVector& joints : places) {
      least = least.cwiseMin(joints);
      most = most.cwiseMax(joints);
    }
    EXPECT_GE(least.minCoeff(), -2.0);
    EXPECT_LE(most.maxCoeff(), 1.0);
    EXPECT_LT(least.maxCoeff(), -1.6);
    EXPECT_GT(most.minCoeff(), 0.6);
  }
}

TEST(JointCourse, HasMemoryOnAPathAlone) {
  RandomStream random{7};
  EXPECT_NEAR(correlation_of_steps(joint_course(Course::random, kRanges, 4000, random)), 0.0, 0.03);
  EXPECT_GT(correlation_of_steps(joint_course(Course::path, kRanges, 4000, random)), 0.8);
}

TEST(JointCourse, GoesOverTheGridOneStepAtATime) {
  RandomStream random{8};
  const std::vector<JointVector> grid = joint_course(Course::grid, kRanges, 200, random);
  std::set<std::vector<double>> places;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    places.insert({grid[i][0], grid[i][1], grid[i][2]});
    if (i == 0) continue;
    const Eigen::Vector3d step = (grid[i] - grid[i - 1]).head<3>().cwiseAbs();
    EXPECT_EQ((step.array() > 1e-9).count(), 1) << i;
    EXPECT_LE(step.maxCoeff(), 3.0 / 5.0 + 1e-9);
  }
  EXPECT_EQ(places.size(), 200u);
}

NoiseCase case_of(const std::string& condition, int number) {
  return noise_cases(condition, number + 1).back();
}

TEST(NoiseCases, HaveSeedsOfTheirOwn) {
  std::set<std::uint64_t> seeds;
  for (const NoiseCondition& condition : noise_conditions()) {
    for (const NoiseCase& one : noise_cases(condition.name, 100)) seeds.insert(one.seed);
  }
  EXPECT_EQ(seeds.size(), 100 * noise_conditions().size());
  EXPECT_EQ(case_of("ideal", 5).seed, noise_cases("ideal", 60)[5].seed);
}

TEST(NoisyMeasurement, IsAFunctionOfItsCaseWithTheColumnsOfItsCondition) {
  for (const NoiseCondition& condition : noise_conditions()) {
    const NoiseCase one = case_of(condition.name, 6);
    const std::vector<Robot> arms{seven_joints()};
    const Scenario scenario = noisy_scene(one, arms);
    const DataSet first = measured_noisily(one, scenario), second = measured_noisily(one, scenario);
    const bool repeated = condition.noise == Noise::repeats;
    EXPECT_EQ(poses_of(first, PoseSet::calibration).size(), 100u) << condition.name;
    EXPECT_EQ(poses_of(first, PoseSet::validation).size(), repeated ? 52u : 50u) << condition.name;
    for (std::size_t i = 0; i < first.poses.size(); ++i) {
      EXPECT_EQ(*first.poses[i].position_m, *second.poses[i].position_m);
      EXPECT_EQ(first.poses[i].temperature_celsius.has_value(), condition.temperature);
      EXPECT_EQ(first.poses[i].time_s.has_value(), condition.time);
    }
    EXPECT_FALSE(check_data(first).verdict() == DataVerdict::contradiction) << condition.name;
  }
}

TEST(NoisyMeasurement, OfRepeatsSharesAnErrorThatIsMostOfTheNoise) {
  const NoiseCase one = case_of("repeats", 0);
  const Scenario scenario = noisy_scene(one, {seven_joints()});
  const DataSet data = measured_noisily(one, scenario);
  Offsets within;
  for (std::size_t i = 0; i < data.poses.size(); i += 4) {
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_EQ(data.poses[i].pose_id, data.poses[i + k].pose_id);
      within.push_back(*data.poses[i + k].position_m - *data.poses[i].position_m);
    }
  }
  EXPECT_NEAR(std::sqrt(mean_square(within) / 2.0), 1e-5, 2e-6);  // of two measurements of 0.01 mm each
}

TEST(CleanError, IsNothingForTheTrueArmAndIgnoresAMovedInstrumentWhereItDrifts) {
  for (const char* condition : {"ideal", "warm_drift"}) {
    const NoiseCase one = case_of(condition, 0);
    Scenario scenario = noisy_scene(one, {seven_joints()});
    scenario.joint_errors.clear();
    const DataSet fresh = fresh_poses(one, scenario);
    CorrectedRobot robot = nominal_robot(fresh);
    robot.chain.tool_m += scenario.tool_error_m;
    robot.tools[""].translation() += scenario.tool_error_m;
    robot.sensor_from_base = scenario.sensor_from_base;
    EXPECT_NEAR(clean_error_mm(one, robot, fresh), 0.0, 1e-9);
    robot.sensor_from_base.translation().x() += 2e-3;
    EXPECT_NEAR(clean_error_mm(one, robot, fresh), one.condition.noise == Noise::warming ? 0.0 : 2.0, 1e-9);
  }
}

TEST(BadPoses, AreThoseWhoseIdsAreReturned) {
  for (const char* condition : {"exchanged", "typing", "gross"}) {
    const NoiseCase one = case_of(condition, 0);
    const DataSet good = measured_noisily(one, noisy_scene(one, {seven_joints()}));
    DataSet bad = good;
    RandomStream random{9};
    std::vector<std::size_t> among = poses_of(good, PoseSet::calibration);
    const std::vector<std::string> ids = put_fault(one.condition.fault, bad, among, random);
    EXPECT_EQ(ids.size(), one.condition.fault == Fault::typing ? 1u : 2u);
    for (std::size_t i = 0; i < good.poses.size(); ++i) {
      const MeasuredPose &was = good.poses[i], &is = bad.poses[i];
      const bool same = was.joints == is.joints && *was.position_m == *is.position_m;
      EXPECT_EQ(same, std::ranges::count(ids, was.pose_id) == 0) << was.pose_id;
    }
  }
}

TEST(BadPoses, ExchangeNeighbouringDigitsAlone) {
  RandomStream random{10};
  std::set<long> seen;
  for (int i = 0; i < 200; ++i)
    seen.insert(std::lround(100.0 * degrees(with_digits_exchanged(radians(-12.34), random))));
  EXPECT_EQ(seen, (std::set<long>{-2134, -1324, -1243}));
  EXPECT_EQ(with_digits_exchanged(0.0, random), 0.0);
}

TEST(NoiseFigures, CountWhatIsFalseAndTakeQuantilesOfErrors) {
  NoisyCaseFigures good{.plan = case_of("path", 0), .arm = {}, .clean = {}};
  good.clean.clean_before_mm = good.clean.clean_after_mm = 0.02;
  NoisyCaseFigures wrong = good;
  wrong.false_effects = 2;
  wrong.clean.first_p = 0.04;
  wrong.clean.clean_after_mm = 0.03;
  const std::vector<NoiseFigure> figures = noise_figures({good, good, good, wrong});
  EXPECT_EQ(figures[0].value, 0.25);
  EXPECT_FALSE(figures[0].bound.kept_by(figures[0].value));
  EXPECT_EQ(figures[1].value, 0.25);
  EXPECT_NEAR(figures[4].value, 1.0 + 0.5 * 0.85, 1e-12);  // between the third and the fourth of four
  EXPECT_NEAR(figures[5].value, 1.5, 1e-12);
}

TEST(NoiseFigures, CountARefusalAsAnInfiniteError) {
  NoisyCaseFigures refused{.plan = case_of("exchanged", 0), .arm = {}, .clean = {}};
  refused.clean.clean_before_mm = refused.clean.clean_after_mm = 0.02;
  refused.bad = refused.clean;
  refused.bad->refused = true;
  refused.bad_poses_named = true;
  const std::vector<NoiseFigure> figures = noise_figures({refused});
  EXPECT_TRUE(std::isinf(figures[1].value));
  EXPECT_FALSE(figures[1].bound.kept_by(figures[1].value));
  EXPECT_EQ(figures[3].value, 1.0);
}

}  // namespace
}  // namespace demecal::bench

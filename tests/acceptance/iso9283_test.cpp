// The criteria of ISO 9283 are what its definitions give for scatter that the test chose.
#include "acceptance/iso9283.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sent_arm.hpp"

namespace demecal {
namespace {

const std::vector<Eigen::Vector3d> kScatter{{1e-5, 0, 0}, {-1e-5, 2e-5, 0}, {0, -2e-5, 3e-5}, {0, 0, -3e-5}};
const Eigen::Vector3d kOffset(3e-4, -4e-4, 1.2e-3);

TEST(Iso9283, PoseAccuracyIsTheDistanceOfTheBarycentre) {
  SentArm arm(3);
  const JointVector joints = arm.somewhere();
  for (const Eigen::Vector3d& scatter : kScatter) arm.add("P1", joints, kOffset + scatter);
  ASSERT_EQ(arm.poses().size(), 1U);
  EXPECT_NEAR(arm.poses().front().accuracy_m, 1.3e-3, 1e-12);  // 3, 4, 12: 13
  EXPECT_NEAR(*arm.criterion("AP").value_mm, 1.3, 1e-9);
}

TEST(Iso9283, RepeatabilityIsMeanPlusThreeDeviationsOfTheDistances) {
  SentArm arm(4);
  const JointVector joints = arm.somewhere();
  for (const Eigen::Vector3d& scatter : kScatter) arm.add("P1", joints, kOffset + scatter);
  const double lengths[] = {1e-5, std::sqrt(5.0) * 1e-5, std::sqrt(13.0) * 1e-5, 3e-5};
  double mean = 0.0, squares = 0.0;
  for (const double length : lengths) mean += length / 4.0;
  for (const double length : lengths) squares += (length - mean) * (length - mean) / 3.0;
  EXPECT_NEAR(*arm.criterion("RP").value_mm, 1e3 * (mean + 3.0 * std::sqrt(squares)), 1e-9);
}

TEST(Iso9283, VariationOfDirectionsIsTheLargestDistanceOfTheirBarycentres) {
  SentArm arm(5);
  const JointVector joints = arm.somewhere();
  const std::vector<std::pair<double, Eigen::Vector3d>> sides{
      {1, {1e-4, 0, 0}}, {-1, {-2e-4, 4e-4, 0}}, {0, {0, 0, 0}}};
  for (const auto& [sign, shift] : sides) {
    for (const Eigen::Vector3d& scatter : kScatter)
      arm.add("P1", joints, shift + scatter).approach = ApproachSigns::Constant(6, sign);
  }
  EXPECT_EQ(arm.poses().size(), 3U) << "repeats are of one side";
  EXPECT_NEAR(*arm.criterion("vAP").value_mm, 0.5, 1e-9);
}

TEST(Iso9283, DistanceAccuracyKnowsNothingOfTheFrame) {
  SentArm arm(6);
  const Eigen::Isometry3d elsewhere(Eigen::Translation3d(0.4, -2.0, 0.1) *
                                    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  constexpr double kScale = 1.0003;
  double longest_m = 0.0;
  std::vector<Eigen::Vector3d> sent;
  for (int i = 0; i < 12; ++i) {
    MeasuredPose& pose = arm.add("P" + std::to_string(i), arm.somewhere(), Eigen::Vector3d::Zero());
    for (const Eigen::Vector3d& other : sent) longest_m = std::max(longest_m, (other - *pose.position_m).norm());
    sent.push_back(*pose.position_m);
    pose.position_m = elsewhere * Eigen::Vector3d(kScale * *pose.position_m);
  }
  EXPECT_NEAR(*arm.criterion("AD").value_mm, 1e3 * (kScale - 1.0) * longest_m, 1e-9);
  EXPECT_GT(*arm.criterion("AP").value_mm, 100.0);
}

/// Three times the scatter, whose barycentre is `shift_m` from where the arm was sent, from `begin_s` on.
void add_series(SentArm& arm, const JointVector& joints, const Eigen::Vector3d& shift_m, double factor,
                double begin_s) {
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (const Eigen::Vector3d& scatter : kScatter) {
      arm.add("P1", joints, shift_m + factor * scatter).time_s = begin_s;
      begin_s += 30.0;
    }
  }
}

TEST(Iso9283, DriftIsTheChangeBetweenSeriesOfRepeats) {
  SentArm arm(7), once(8);
  const JointVector joints = arm.somewhere();
  for (int hour = 0; hour < 3; ++hour) add_series(arm, joints, (1.0 + hour) * kOffset, 1.0 + hour, 3600.0 * hour);
  add_series(once, once.somewhere(), kOffset, 1.0, 0.0);
  EXPECT_NEAR(*arm.criterion("dAP").value_mm, 2.6, 1e-9);
  EXPECT_NEAR(*arm.criterion("dRP").value_mm, 2.0 * *once.criterion("RP").value_mm, 1e-9);
}

TEST(Iso9283, RepeatabilityIsOfOneSeriesAndHoldsNoDrift) {
  SentArm drifting(12), once(13);
  const JointVector joints = drifting.somewhere();
  for (int series = 0; series < 3; ++series)
    add_series(drifting, joints, (1.0 + series) * kOffset, 1.0, 14400.0 * series);
  add_series(once, once.somewhere(), kOffset, 1.0, 0.0);
  EXPECT_NEAR(*drifting.criterion("RP").value_mm, *once.criterion("RP").value_mm, 1e-9);
}

TEST(Iso9283, RepeatsOfOneHourWithGapsOfAnyLengthAreOneSeries) {
  SentArm arm(14);
  const JointVector joints = arm.somewhere();
  add_series(arm, joints, kOffset, 1.0, 0.0);
  add_series(arm, joints, 2.0 * kOffset, 1.0, 900.0);  // nine minutes after the last
  EXPECT_FALSE(arm.criterion("dAP").value_mm);
  SentArm few(15);
  for (const double hour : {0.0, 1.0})
    for (const Eigen::Vector3d& scatter : kScatter) few.add("P1", joints, scatter).time_s = 3600.0 * hour;
  EXPECT_FALSE(few.criterion("dRP").value_mm) << "four repeats tell no repeatability";
}

TEST(Iso9283, PosesUnderOtherConditionsAreNoRepeats) {
  SentArm arm(16);
  const JointVector joints = arm.somewhere();
  for (const double payload_kg : {0.0, 5.0}) {
    for (const double celsius : {20.0, 23.0, 40.0}) {
      MeasuredPose& pose = arm.add("P1", joints, payload_kg * kOffset);
      pose.payload_kg = payload_kg;
      pose.temperature_celsius = celsius;
    }
  }
  EXPECT_EQ(arm.poses().size(), 4U) << "3 degrees make no other condition";
  EXPECT_NEAR(*arm.criterion("RP").value_mm, 0.0, 1e-9);
  EXPECT_EQ(errors_by_place(arm.poses()).mean_m.size(), 1U);
}

TEST(Iso9283, PosesWhoseLoggedJointsScatterAreOnePlaceWhateverTheirNames) {
  SentArm arm(17);
  const JointVector joints = arm.somewhere();
  for (int i = 0; i < 30; ++i) {
    JointVector logged = joints;
    logged[i % 6] += (i % 3 - 1) * 1e-5;
    arm.add("M" + std::to_string(i), logged, kOffset);
  }
  EXPECT_EQ(arm.poses().size(), 1U);
  JointVector elsewhere = joints;
  elsewhere[2] += 1e-2;
  arm.add("other", elsewhere, kOffset);
  EXPECT_EQ(errors_by_place(arm.poses()).single_m.size(), 2U);
}

TEST(Iso9283, SaysWhatWasNotMeasured) {
  SentArm arm(9);
  for (int i = 0; i < 5; ++i) arm.add("P" + std::to_string(i), arm.somewhere(), kOffset);
  for (const char* const symbol : {"RP", "vAP", "dAP", "dRP"}) {
    EXPECT_FALSE(arm.criterion(symbol).value_mm) << symbol;
    EXPECT_NE(arm.criterion(symbol).basis, "") << symbol;
  }
  EXPECT_TRUE(arm.criterion("AP").value_mm);
  EXPECT_TRUE(arm.criterion("AD").value_mm);
}

TEST(Iso9283, OfLengthsAloneHasAccuracyAndNothingElse) {
  SentArm arm(10);
  arm.data().anchors_m = {Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(0, 2, 0)};
  for (int i = 0; i < 3; ++i) {
    MeasuredPose& pose = arm.add("P" + std::to_string(i), arm.somewhere(), Eigen::Vector3d::Zero());
    for (const Eigen::Vector3d& anchor : arm.data().anchors_m)
      pose.distances_m.push_back((*pose.position_m - anchor).norm() + 2e-4);
    pose.position_m.reset();
  }
  EXPECT_NEAR(*arm.criterion("AP").value_mm, 0.2, 1e-9);
  for (const char* const symbol : {"RP", "vAP", "AD", "dAP"}) EXPECT_FALSE(arm.criterion(symbol).value_mm) << symbol;
}

}  // namespace
}  // namespace demecal

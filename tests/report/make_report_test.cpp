// The figures of a report that are computed from the data themselves.
#include "report/make_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "random/random_stream.hpp"
#include "residuals/structure.hpp"

namespace demecal {
namespace {

/// Poses that repeat `repeats` times with noise of `sigma_m` on each axis.
DataSet repeated(int poses, int repeats, double sigma_m) {
  RandomStream random{461};
  DataSet data;
  for (int pose = 0; pose < poses; ++pose) {
    const Eigen::Vector3d place(random.real(-1.0, 1.0), random.real(-1.0, 1.0), random.real());
    for (int repeat = 0; repeat < repeats; ++repeat) {
      MeasuredPose measured;
      measured.pose_id = "P" + std::to_string(pose);
      measured.position_m = place + sigma_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      data.poses.push_back(measured);
    }
  }
  return data;
}

TEST(NoiseFloor, IsTheStandardDeviationOfRepeatsPerAxis) {
  // 2400 degrees of freedom: the estimate's own standard deviation is 1.4 %.
  EXPECT_NEAR(*noise_floor_mm(repeated(400, 3, 5e-5)), 0.05, 0.05 * 0.06);
  EXPECT_NEAR(*noise_floor_mm(repeated(4, 2, 0.0)), 0.0, 1e-12);
}

TEST(NoiseFloor, IsOfTheRepeatsOfAllSetsWhateverTheLoopSays) {
  DataSet data = repeated(40, 3, 5e-5);
  for (std::size_t i = 0; i < data.poses.size(); ++i) data.poses[i].set = static_cast<PoseSet>(i / 3 % 3);
  const double floor_mm = *noise_floor_mm(data);
  for (MeasuredPose& pose : data.poses) pose.set = PoseSet::calibration;
  EXPECT_EQ(*noise_floor_mm(data), floor_mm);
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_NEAR(floor_mm, 1e3 * pure_error(data, all)->deviation_m, 1e-15);
}

TEST(NoiseFloor, IsUnknownWithoutRepeats) {
  EXPECT_EQ(noise_floor_mm(repeated(50, 1, 5e-5)), std::nullopt);
  EXPECT_EQ(noise_floor_mm(DataSet{}), std::nullopt);
}

TEST(NoiseFloor, DoesNotTakeDifferentTargetsForRepeats) {
  DataSet data = repeated(2, 2, 5e-5);
  for (std::size_t i = 0; i < data.poses.size(); ++i) data.poses[i].target = i % 2 == 0 ? "A" : "B";
  EXPECT_EQ(noise_floor_mm(data), std::nullopt);
}

}  // namespace
}  // namespace demecal

// Positions that a controller computed are told from measured ones, however coarse the file; measured ones never are.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "mistaken_case.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// The last places that joints, deg, and positions, mm, are written to; 0 writes all digits.
struct WrittenPlaces {
  double angle_deg = 0.0, position_mm = 0.0;
};

void round_to(double& value, double step) {
  if (step > 0.0) value = step * std::round(value / step);
}

/// A data set of every arm, with joints rounded so and positions by `point` of the joints.
std::vector<DataSet> tables_of(const WrittenPlaces& places,
                               const std::function<Eigen::Vector3d(const DataSet&, const MeasuredPose&)>& point) {
  std::vector<DataSet> all;
  for (const Robot& arm : bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots")) {
    DataSet data = bench::unmistaken_cases({arm}, 10).back().data;
    for (MeasuredPose& pose : data.poses) {
      for (double& joint : pose.joints) round_to(joint, radians(places.angle_deg));
      Eigen::Vector3d at = point(data, pose);
      for (double& value : at) round_to(value, metres(places.position_mm));
      pose.position_m = at;
    }
    all.push_back(std::move(data));
  }
  return all;
}

Eigen::Vector3d point_of(const Chain& chain, const DataSet& data, const MeasuredPose& pose) {
  const Eigen::Isometry3d base =
      Eigen::Translation3d(2.0, -1.0, 0.4) * Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.2, 0.1, 1.0).normalized());
  return base * (forward(chain, pose.joints) * nominal_tool(data, pose));
}

Eigen::Vector3d nominal_point(const DataSet& data, const MeasuredPose& pose) {
  return point_of(data.robot.chain, data, pose);
}

constexpr WrittenPlaces kPlaces[] = {{0.0, 0.0}, {1e-3, 1e-2}, {1e-2, 1e-1}, {1e-4, 1e-3}};

TEST(ComputedPositions, AreToldWhateverTheirPlaces) {
  for (const WrittenPlaces& places : kPlaces) {
    for (const DataSet& data : tables_of(places, nominal_point)) {
      const DataCheck check = check_data(data);
      EXPECT_TRUE(check.has(FindingKind::computed_positions)) << data.robot.name << " " << places.position_mm;
      EXPECT_EQ(check.verdict(), DataVerdict::suspicious) << data.robot.name;
    }
  }
}

TEST(ComputedPositions, MeasuredOnesOfAGoodArmAreNot) {
  RandomStream random{41};
  for (const WrittenPlaces& places : kPlaces) {
    const auto measured = [&](const DataSet& data, const MeasuredPose& pose) -> Eigen::Vector3d {
      Chain made = data.robot.chain;
      for (Joint& joint : made.joints) joint.theta_rad += radians(0.01);
      made.joints[2].a_m += 3e-4;
      return point_of(made, data, pose) + 5e-5 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    };
    for (const DataSet& data : tables_of(places, measured)) {
      const DataCheck check = check_data(data);
      EXPECT_EQ(check.verdict(), DataVerdict::plausible) << data.robot.name << " " << places.position_mm;
    }
  }
}

}  // namespace
}  // namespace demecal

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "baselines/baseline.hpp"
#include "baselines/regression.hpp"
#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline baselines {
namespace {

constexpr int kFoldsOfNetwork = 5;
constexpr std::array<std::size_t, 5> kCentres{10, 30, 100, 200, 400};
constexpr std::array<double, 4> kWidths{0.5, 1.0, 2.0, 4.0};  // in units of the root of the number of joints

struct Network {
  std::vector<Eigen::VectorXd> centres;
  double width = 1.0;
  Eigen::MatrixXd weights;  ///< (1 + centres) x 3

  /// 1 x (1 + centres): a constant, and each centre's Gaussian.
  Eigen::MatrixXd row(const Eigen::VectorXd& joints) const {
    Eigen::MatrixXd row(1, static_cast<Eigen::Index>(centres.size()) + 1);
    row(0, 0) = 1.0;
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const double distance = (joints - centres[k]).norm() / width;
      row(0, static_cast<Eigen::Index>(k) + 1) = std::exp(-0.5 * distance * distance);
    }
    return row;
  }
};

/// The first point, and then ever the one that is farthest from those taken.
std::vector<Eigen::VectorXd> farthest_points(const std::vector<Eigen::VectorXd>& points, std::size_t count) {
  std::vector<Eigen::VectorXd> chosen_points{points.front()};
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  while (chosen_points.size() < std::min(count, points.size())) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      distance[i] = std::min(distance[i], (points[i] - chosen_points.back()).squaredNorm());
    }
    const auto farthest = std::ranges::max_element(distance);
    if (*farthest == 0.0) break;
    chosen_points.push_back(points[static_cast<std::size_t>(farthest - distance.begin())]);
  }
  return chosen_points;
}

/// The constant is not held.
Eigen::VectorXd weight_of(const Network& network) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(network.centres.size()) + 1);
  weight[0] = 0.0;
  return weight;
}

struct Samples {
  std::vector<Eigen::VectorXd> joints;
  std::vector<Eigen::RowVector3d> error_m;
  std::vector<int> folds;
};

std::vector<RidgeSums> sums_of(const Samples& samples, const Network& network) {
  std::vector<BufferedRidgeSums> sums(kFoldsOfNetwork, BufferedRidgeSums(weight_of(network).size(), 3));
  for (std::size_t i = 0; i < samples.joints.size(); ++i) {
    sums[static_cast<std::size_t>(samples.folds[i])].add(network.row(samples.joints[i]), samples.error_m[i]);
  }
  std::vector<RidgeSums> by_fold;
  for (BufferedRidgeSums& fold : sums) by_fold.push_back(fold.sums());
  return by_fold;
}

Samples samples_of(const RegisteredArm& arm, const ScaledJoints& scaled) {
  Samples samples;
  std::vector<std::size_t> seen;
  for (const std::size_t i : arm.poses) {
    const MeasuredPose& pose = arm.data.poses[i];
    if (!pose.position_m) continue;
    seen.push_back(i);
    samples.joints.push_back(scaled(pose.joints));
    samples.error_m.emplace_back(
        (measured_point(arm.robot, pose) - arm.robot.predict(Stop(pose), pose.target).translation()).transpose());
  }
  samples.folds = assign_folds(arm.data, seen, kFoldsOfNetwork);
  return samples;
}

}  // namespace

BaselineFit fit_radial_basis(const RegisteredArm& arm) {
  const ScaledJoints scaled(arm.data, arm.poses);
  const Samples samples = samples_of(arm, scaled);
  if (samples.joints.empty()) return {nullptr, 0, "no positions were measured"};
  Network best;
  RidgeChoice least{0.0, std::numeric_limits<double>::infinity()};
  for (const std::size_t count : kCentres) {
    Network network{farthest_points(samples.joints, count), 1.0, {}};
    for (const double width : kWidths) {
      network.width = width * std::sqrt(static_cast<double>(arm.robot.chain.size()));
      const RidgeChoice choice = choose_ridge(sums_of(samples, network), weight_of(network));
      if (choice.cost >= least.cost) continue;
      least = choice;
      best = network;
    }
    if (count >= samples.joints.size()) break;
  }
  const RidgeSums all = sum_of_parts(sums_of(samples, best));
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(all.linear.rows(), 3);
  best.weights = ridge_solution(all, weight_of(best), least.ridge, none);
  std::ostringstream chosen;
  chosen << best.centres.size() << " centres, width " << best.width << ", ridge " << least.ridge;
  return {[best, scaled, robot = arm.robot](const MeasuredPose& pose) {
            Eigen::Isometry3d tool = robot.predict(Stop(pose), pose.target);
            tool.translation() += (best.row(scaled(pose.joints)) * best.weights).row(0).transpose();
            return tool;
          },
          arm.parameters + static_cast<int>(best.weights.size()), chosen.str()};
}

}  // namespace demecal::inline baselines

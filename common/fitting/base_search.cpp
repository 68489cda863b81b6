#include "fitting/base_search.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "data/spread_poses.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/effect.hpp"
#include "fitting/least_squares.hpp"
#include "kinematics/forward.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline fitting {
namespace {

/// What base and tool alone usually leave; only the ratio between the kinds matters here.
constexpr double kTypicalResidual_m = 1e-3, kTypicalResidual_rad = 2e-3;
constexpr int kFirstIterations = 10;
/// More than base and tool leave of most arms: the tool as described may have led to another minimum.
constexpr double kMisplaced_m = 1e-3;
constexpr double kFarLess = 0.25;  ///< of the cost, below which another minimum is taken: equals stay as they were

/// Every tool turned as the measured orientations have it on average, given the base.
void turn_tools(CorrectedRobot& robot, const DataSet& data, const std::vector<Observation>& observations) {
  std::map<std::string, Eigen::Matrix3d> sums;
  for (const Observation& observation : observations) {
    const MeasuredPose& pose = data.poses[observation.pose];
    if (!pose.orientation) continue;
    const Eigen::Matrix3d flange =
        robot.sensor_from_base.linear() * forward(robot.chain, observation.corrected).linear();
    const Eigen::Matrix3d tool = flange.transpose() * measured_orientation(robot, pose);
    sums.try_emplace(pose.target, Eigen::Matrix3d::Zero()).first->second += tool;
  }
  for (const auto& [target, sum] : sums) robot.tools.at(target).linear() = nearest_rotation(sum);
}

/// Without a tool to turn, measured orientations may be off by any fixed rotation: then only positions lead.
RowScales search_scales(const RowCounts& count, bool tool) {
  const bool lead = tool || count[kPosition] + count[kDistance] == 0;
  return {kTypicalResidual_m, lead ? kTypicalResidual_rad : 0.0, kTypicalResidual_m};
}

class BaseSearch {
 public:
  BaseSearch(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
             const CorrectedRobot& start, const FitOptions& options)
      : data_(data),
        start_(start),
        tool_(declared.tool),
        ids_(free_parameters(data, {.registration = declared.registration, .tool = declared.tool})),
        observations_(observe(data, spread_poses(poses, static_cast<std::size_t>(options.start_poses)), start)),
        scales_(search_scales(count_rows(data, observations_), tool_)) {}

  CorrectedRobot best_of(const std::vector<Eigen::Isometry3d>& bases) const {
    PlacedRobot best{start_};
    for (const Eigen::Isometry3d& base : bases) {
      PlacedRobot placed = refined(with_base(base), kFirstIterations);
      if (placed.cost < best.cost) best = std::move(placed);
    }
    best = refined(best.robot, 10 * kFirstIterations);
    if (!tool_ || root_mean_squares(data_, best.robot, observations_)[kPosition] < kMisplaced_m) return best.robot;
    PlacedRobot other{start_};
    for (const Eigen::Isometry3d& base : bases) {
      PlacedRobot placed = refined(with_tools(base), 5 * kFirstIterations);
      if (placed.cost < other.cost) other = std::move(placed);
    }
    other = refined(other.robot, 10 * kFirstIterations);
    return other.cost < kFarLess * best.cost ? other.robot : best.robot;
  }

  const std::vector<Observation>& observations() const { return observations_; }

 private:
  struct PlacedRobot {
    CorrectedRobot robot;
    double cost = std::numeric_limits<double>::infinity();
  };

  CorrectedRobot with_base(const Eigen::Isometry3d& base) const {
    CorrectedRobot robot = start_;
    robot.sensor_from_base = base;
    if (tool_) turn_tools(robot, data_, observations_);
    return robot;
  }

  /// The base so turned, its translation and the tools at least squares, in which measured positions are linear.
  CorrectedRobot with_tools(const Eigen::Isometry3d& base) const {
    CorrectedRobot robot = with_base(base);
    std::map<std::string, Eigen::Index> places;
    for (const Observation& observation : observations_)
      places.try_emplace(data_.poses[observation.pose].target, 3 + 3 * std::ssize(places));
    const auto rows = 3 * std::ssize(observations_), size = 3 + 3 * std::ssize(places);
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rows, size);
    Eigen::VectorXd points = Eigen::VectorXd::Zero(rows);
    for (Eigen::Index row = 0; row < rows; row += 3) {
      const Observation& observation = observations_[static_cast<std::size_t>(row / 3)];
      const MeasuredPose& pose = data_.poses[observation.pose];
      if (!pose.position_m) continue;
      const Eigen::Isometry3d flange = forward(robot.chain, observation.corrected);
      slopes.block<3, 3>(row, 0).setIdentity();
      slopes.block<3, 3>(row, places.at(pose.target)) = base.linear() * flange.linear();
      points.segment<3>(row) = measured_point(robot, pose) - base.linear() * flange.translation();
    }
    const Eigen::VectorXd placed = least_norm_solution(slopes, points);
    robot.sensor_from_base.translation() = placed.head<3>();
    for (const auto& [target, place] : places) robot.tools.at(target).translation() = placed.segment<3>(place);
    return robot;
  }

  PlacedRobot refined(const CorrectedRobot& robot, int iterations) const {
    const ParameterSpace space(robot, ids_);
    const LeastSquares problem{.data = data_,
                               .space = space,
                               .observations = observations_,
                               .scales = scales_,
                               .basis = Eigen::MatrixXd::Identity(space.size(), space.size()),
                               .prior = no_prior(space.size()),
                               .robust = false,
                               .max_iterations = iterations};
    const Minimum minimum = minimise(problem, Eigen::VectorXd::Zero(space.size()));
    return {space.at(minimum.change).robot, minimum.cost};
  }

  const DataSet& data_;
  const CorrectedRobot& start_;
  bool tool_;
  std::vector<ParameterId> ids_;
  std::vector<Observation> observations_;
  RowScales scales_;
};

/// The tool of an observation as the robot has it, in the robot's base.
Eigen::Vector3d point_in_base(const DataSet& data, const CorrectedRobot& robot, const Observation& observation) {
  return forward(robot.chain, observation.corrected) * robot.tool(data.poses[observation.pose].target).translation();
}

Eigen::Isometry3d base_through(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& point_in_base,
                               const Eigen::Vector3d& point_in_sensor) {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  base.linear() = rotation;
  base.translation() = point_in_sensor - rotation * point_in_base;
  return base;
}

struct RegisteredPoints {
  Eigen::Matrix3Xd in_base;
  Eigen::Matrix3Xd in_sensor;
};

/// The points of the observations that measured a position.
RegisteredPoints measured_points(const DataSet& data, const std::vector<Observation>& observations,
                                 const CorrectedRobot& robot) {
  RegisteredPoints points;
  for (const Observation& observation : observations) {
    const MeasuredPose& pose = data.poses[observation.pose];
    if (!pose.position_m) continue;
    const Eigen::Index n = points.in_base.cols();
    points.in_base.conservativeResize(3, n + 1);
    points.in_sensor.conservativeResize(3, n + 1);
    points.in_base.col(n) = point_in_base(data, robot, observation);
    points.in_sensor.col(n) = measured_point(robot, pose);
  }
  return points;
}

std::vector<Eigen::Isometry3d> candidates_from_points(const RegisteredPoints& points, int count) {
  std::vector<Eigen::Isometry3d> bases;
  bases.emplace_back(rigid_motion(points.in_base, points.in_sensor));
  const Eigen::Vector3d base_middle = points.in_base.rowwise().mean(),
                        sensor_middle = points.in_sensor.rowwise().mean();
  for (int i = 0; i < count; ++i) bases.push_back(base_through(spread_rotation(i, count), base_middle, sensor_middle));
  return bases;
}

/// No direction, the six of a cube's faces and the eight of its corners.
std::vector<Eigen::Vector3d> cube_directions() {
  std::vector<Eigen::Vector3d> places;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int off = std::abs(x) + std::abs(y) + std::abs(z);
        if (off != 2) places.push_back(Eigen::Vector3d(x, y, z).stableNormalized());
      }
    }
  }
  return places;
}

struct ToolMiddle {
  Eigen::Vector3d in_base = Eigen::Vector3d::Zero();
  double distance_m = 0.0;
};

/// The mean point of the tool and its mean distance from the anchors.
ToolMiddle tool_middle(const DataSet& data, const std::vector<Observation>& observations, const CorrectedRobot& robot) {
  ToolMiddle middle;
  double distances = 0.0;
  for (const Observation& observation : observations) {
    middle.in_base += point_in_base(data, robot, observation) / static_cast<double>(observations.size());
    for (const double distance : data.poses[observation.pose].distances_m)
      middle.distance_m += distance, distances += 1;
  }
  if (distances > 0) middle.distance_m /= distances;
  return middle;
}

double distance_misfit(const DataSet& data, const std::vector<Observation>& observations, CorrectedRobot robot,
                       const Eigen::Isometry3d& base) {
  robot.sensor_from_base = base;
  return root_mean_squares(data, robot, observations)[kDistance];
}

std::vector<Eigen::Isometry3d> candidates_from_distances(const DataSet& data,
                                                         const std::vector<Observation>& observations,
                                                         const CorrectedRobot& robot, int count) {
  const ToolMiddle middle = tool_middle(data, observations, robot);
  Eigen::Vector3d anchors = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& anchor : data.anchors_m) anchors += anchor / static_cast<double>(data.anchors_m.size());
  std::vector<std::pair<double, Eigen::Isometry3d>> ranked;
  for (int i = 0; i < count; ++i) {
    for (const Eigen::Vector3d& place : cube_directions()) {
      const Eigen::Isometry3d base =
          base_through(spread_rotation(i, count), middle.in_base, anchors + middle.distance_m * place);
      ranked.emplace_back(distance_misfit(data, observations, robot, base), base);
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::Isometry3d> bases;
  for (int i = 0; i < count; ++i) bases.push_back(ranked[static_cast<std::size_t>(i)].second);
  return bases;
}

}  // namespace

CorrectedRobot locate_base_and_tools(const DataSet& data, std::span<const std::size_t> poses,
                                     const DeclaredModel& declared, const CorrectedRobot& start,
                                     const FitOptions& options) {
  const bool is_placed = has_instrument(data) || !has_contacts(data);
  if (options.starts == 0 || !is_placed || !(declared.registration || declared.tool)) return start;
  CorrectedRobot without_effects = start;
  without_effects.effects.clear();
  without_effects.contacts.clear();  // the base is found by what instruments say
  const BaseSearch search(data, poses, declared, without_effects, options);
  std::vector<Eigen::Isometry3d> bases{start.sensor_from_base};
  if (declared.registration && data.frame == Frame::sensor) {
    const auto others = base_candidates(data, search.observations(), without_effects, options.starts);
    bases.insert(bases.end(), others.begin(), others.end());
  }
  CorrectedRobot placed = search.best_of(bases);
  placed.effects = start.effects;
  return placed;
}

std::vector<Eigen::Isometry3d> base_candidates(const DataSet& data, const std::vector<Observation>& observations,
                                               const CorrectedRobot& robot, int count) {
  const RegisteredPoints points = measured_points(data, observations, robot);
  if (points.in_base.cols() > 0) return candidates_from_points(points, count);
  if (count_rows(data, observations)[kDistance] > 0) return candidates_from_distances(data, observations, robot, count);
  std::vector<Eigen::Isometry3d> bases;
  for (int i = 0; i < count; ++i) bases.emplace_back(spread_rotation(i, count));
  return bases;
}

Eigen::Matrix3d spread_rotation(int index, int count) {
  constexpr double kPsi = 1.533751168755204288118;  // the root of psi^4 = psi + 4
  const double s = index + 0.5, share = s / count;
  const double alpha = 2 * std::numbers::pi * s / std::numbers::sqrt2, beta = 2 * std::numbers::pi * s / kPsi;
  const double inner = std::sqrt(share), outer = std::sqrt(1 - share);
  return Eigen::Quaterniond(outer * std::cos(beta), inner * std::sin(alpha), inner * std::cos(alpha),
                            outer * std::sin(beta))
      .toRotationMatrix();
}

}  // namespace demecal::inline fitting

#include "simulation/touching.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline simulation {
namespace {

constexpr double kThere_m = 1e-9;
constexpr double kStep = 1e-6;        ///< of difference quotients, rad or m
constexpr double kLongestStep = 0.3;  ///< rad or m
constexpr int kMostContactSteps = 60;
constexpr int kMostStarts = 200;

Eigen::Vector3d point_at(const SimulatedRobot& robot, const Visit& visit) {
  return robot.true_pose(visit).translation();
}

Eigen::Matrix3Xd slopes_at(const SimulatedRobot& robot, const Visit& visit) {
  Eigen::Matrix3Xd slopes(3, visit.commanded.size());
  for (Eigen::Index joint = 0; joint < slopes.cols(); ++joint) {
    Visit ahead = visit, behind = visit;
    ahead.commanded[joint] += kStep;
    behind.commanded[joint] -= kStep;
    slopes.col(joint) = (point_at(robot, ahead) - point_at(robot, behind)) / (2.0 * kStep);
  }
  return slopes;
}

/// Gauss and Newton's shortest steps; nothing where they do not arrive.
std::optional<Visit> led_to(const SimulatedRobot& robot, const Eigen::Vector3d& goal, Visit visit,
                            const JointVector& from) {
  constexpr double kDamping = 1e-8;  ///< m^2
  for (int step = 0; step < kMostContactSteps; ++step) {
    visit.approach = signs_of_move(from, visit.commanded);
    const Eigen::Vector3d off = goal - point_at(robot, visit);
    if (off.norm() < kThere_m) return visit;
    const Eigen::Matrix3Xd slopes = slopes_at(robot, visit);
    const Eigen::Matrix3d square = slopes * slopes.transpose() + kDamping * Eigen::Matrix3d::Identity();
    Eigen::VectorXd change = slopes.transpose() * solve_pivoted(square, off);
    const double largest = change.cwiseAbs().maxCoeff();
    if (largest > kLongestStep) change *= kLongestStep / largest;
    visit.commanded += change;
  }
  return std::nullopt;
}

bool within_limits(const JointVector& joints, const Chain& chain) {
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    if (joints[joint] < link.lower || joints[joint] > link.upper) return false;
  }
  return true;
}

}  // namespace

ApproachSigns signs_of_move(const JointVector& from, const JointVector& to) {
  constexpr double kSmallestMove = 2e-3;  ///< rad or m
  ApproachSigns signs(to.size());
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    const double move = to[i] - from[i];
    signs[i] = move > kSmallestMove ? 1.0 : move < -kSmallestMove ? -1.0 : 0.0;
  }
  return signs;
}

const TouchedPoint& touched_by(const Scenario& scenario, PoseSet set, std::size_t pose) {
  std::vector<const TouchedPoint*> points;
  for (const TouchedPoint& point : scenario.touched)
    if (point.for_acceptance == (set == PoseSet::accept)) points.push_back(&point);
  if (points.empty())
    for (const TouchedPoint& point : scenario.touched) points.push_back(&point);
  DEMECAL_CHECK(!points.empty(), "a scenario without contacts");
  return *points[pose % points.size()];
}

Visit touching_visit(const Scenario& scenario, const SimulatedRobot& robot, const TouchedPoint& point, Visit start,
                     const JointVector& from, RandomStream& random) {
  Eigen::Vector3d goal = point.at_m;
  for (double& element : goal) element += scenario.play_m * random.normal();
  for (int attempt = 0; attempt < kMostStarts; ++attempt) {
    const std::optional<Visit> there = led_to(robot, goal, start, from);
    if (there && within_limits(there->commanded, scenario.robot.chain)) return *there;
    start.commanded = draw_poses(scenario, 1, random).front();
  }
  throw InputError({scenario.robot_file, 0}, point.contact,
                   "is a contact that the arm cannot touch within its limits from where the poses are drawn: move "
                   "contacts.points_mm, or widen cuboid or joint_ranges");
}

}  // namespace demecal::inline simulation

#include "parameters/arm_size.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline parameters {
namespace {

constexpr int kPostures = 24;

/// A length of the tool is believed of nothing: it takes what a link's length could take as well.
constexpr double kAnyLength_m = 1.0;

/// How far a parameter may go before anything was measured, m or rad; 0 of those that make no part of the arm larger.
double believed_deviation(const ParameterId& id) {
  if (id.kind == ParameterId::Kind::tool_translation) return kAnyLength_m;
  if (id.kind != ParameterId::Kind::link) return 0.0;
  return id.is_angle() ? kMakersDeviation_rad : kMakersDeviation_m;
}

/// Postures all over the joints' ranges, no two joints in step.
JointVector posture(const Chain& chain, int number) {
  JointVector joints(chain.size());
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    const double turns = (number + 1) * std::sqrt(joint + 0.5);
    joints[joint] = std::lerp(link.lower, link.upper, turns - std::floor(turns));
  }
  return joints;
}

/// The targets whose tools are free; where none is, all that the robot has.
std::vector<std::string> targets_with_free_tools(const ParameterSpace& space) {
  std::set<std::string> targets;
  for (const ParameterId& id : space.ids())
    if (id.kind == ParameterId::Kind::tool_translation) targets.insert(id.target);
  if (targets.empty())
    for (const auto& [target, tool] : space.reference().tools) targets.insert(target);
  return {targets.begin(), targets.end()};
}

/// Tool points in many postures: how they move per deviation of each parameter, and where they are, m. The last three
/// columns shift all of them.
struct PointsInPostures {
  Eigen::MatrixXd motions;
  Eigen::VectorXd points;
};

PointsInPostures points_in_postures(const ParameterSpace& space, const Eigen::VectorXd& deviations) {
  const ModelPoint here = space.at(Eigen::VectorXd::Zero(space.size()));
  const std::vector<std::string> targets = targets_with_free_tools(space);
  const Eigen::Index n = space.size(), rows = 3 * kPostures * std::ssize(targets);
  PointsInPostures all{Eigen::MatrixXd(rows, n + 3), Eigen::VectorXd(rows)};
  ToolMotion motion;
  Eigen::Index row = 0;
  for (const std::string& target : targets) {
    for (int number = 0; number < kPostures; ++number, row += 3) {
      space.move_tool(here, posture(space.reference().chain, number), {}, target, motion);
      all.motions.block(row, 0, 3, n) = motion.twists.topRows<3>() * deviations.asDiagonal();
      all.motions.block<3, 3>(row, n).setIdentity();
      all.points.segment<3>(row) = motion.predicted.translation();
    }
  }
  return all;
}

}  // namespace

Eigen::VectorXd arm_size_slopes(const ParameterSpace& space) {
  constexpr double kRidge = 1e-6;        ///< keeps apart what hardly differs from running away against each other
  constexpr double kLargerAlike = 2e-3;  ///< of the arm's extent: how far off its own image the larger arm may be
  const Eigen::Index n = space.size();
  Eigen::VectorXd deviations(n), slopes = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) deviations[i] = believed_deviation(space.ids()[static_cast<std::size_t>(i)]);
  if (deviations.isZero(0.0)) return slopes;
  const PointsInPostures all = points_in_postures(space, deviations);
  const Eigen::Index rows = all.points.size();
  Eigen::MatrixXd held(rows + n + 3, n + 3);
  held << all.motions, kRidge * Eigen::MatrixXd::Identity(n + 3, n + 3);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(rows + n + 3);
  wanted.head(rows) = all.points;
  const Eigen::VectorXd larger = least_norm_solution(held, wanted);
  const Eigen::VectorXd about_m = all.points - all.motions.rightCols<3>() * larger.tail<3>();
  if (!((all.points - all.motions * larger).norm() < kLargerAlike * about_m.norm())) return slopes;
  for (Eigen::Index i = 0; i < n; ++i)
    if (space.ids()[static_cast<std::size_t>(i)].kind == ParameterId::Kind::link) slopes[i] = larger[i] / deviations[i];
  const double whole = slopes.cwiseProduct(deviations).squaredNorm();
  return whole > 0.0 ? Eigen::VectorXd(slopes / whole) : slopes;
}

}  // namespace demecal::inline parameters

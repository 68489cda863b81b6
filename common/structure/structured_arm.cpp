#include "structure/structured_arm.hpp"

#include <algorithm>

#include "kinematics/forward.hpp"
#include "kinematics/rotation_vector.hpp"

namespace demecal {
namespace {

/// The flange in the base's frame; every gene's screw, in their order, goes to `visit`.
template <typename Visit>
Eigen::Isometry3d walk_genes(const StructuredArm& arm, const JointVector& commanded, const Visit& visit) {
  std::size_t next = 0;
  const auto insert = [&](int place, Eigen::Isometry3d& frame) {
    if (place == 0) return;
    for (const Gene& gene : arm.genome[static_cast<std::size_t>(place - 1)]) {
      visit(Screw{gene.rotates, frame.linear().col(gene.axis), frame.translation()});
      advance(frame, Elementary{LinkParameter::theta, gene.rotates, gene.axis}, arm.values[next++]);
    }
  };
  return walk(
      arm.robot.chain, arm.robot.corrected_joints(commanded), [](int, LinkParameter, const Screw&) {}, insert);
}

void turn(Eigen::Isometry3d& frame, const Eigen::Vector3d& shift, const Eigen::Vector3d& by) {
  frame.translation() += shift;
  frame.linear() = rotation_of(by) * frame.linear();
}

}  // namespace

Eigen::Isometry3d StructuredArm::predict(const JointVector& commanded, const std::string& target) const {
  return robot.sensor_from_base * walk_genes(*this, commanded, [](const Screw&) {}) * robot.tool(target);
}

StructureMotion motion_of(const StructuredArm& arm, const StructureFreedom& freedom, const JointVector& commanded,
                          const std::string& target) {
  std::vector<Screw> screws;
  const Eigen::Isometry3d flange = walk_genes(arm, commanded, [&](const Screw& screw) { screws.push_back(screw); });
  const Eigen::Isometry3d point = flange * arm.robot.tool(target);
  const Eigen::Isometry3d& base = arm.robot.sensor_from_base;
  StructureMotion motion{base * point, {}};
  const int before = freedom.before_genes();
  motion.twists.setZero(6, before + static_cast<Eigen::Index>(screws.size()));
  if (freedom.base) {
    motion.twists.topLeftCorner<3, 3>().setIdentity();
    motion.twists.block<3, 3>(3, 3).setIdentity();
    const Eigen::Vector3d arm_m = motion.predicted.translation() - base.translation();
    for (int i = 0; i < 3; ++i) motion.twists.col(3 + i).head<3>() = Eigen::Vector3d::Unit(i).cross(arm_m);
  }
  const auto own = std::ranges::find(freedom.tools, target);
  if (own != freedom.tools.end()) {
    const Eigen::Matrix3d axes = (base * flange).linear();
    const Eigen::Index at = (freedom.base ? 6 : 0) + freedom.tool_size() * (own - freedom.tools.begin());
    motion.twists.block<3, 3>(0, at) = axes;
    if (freedom.tool_turns) motion.twists.block<3, 3>(3, at + 3) = axes;
  }
  for (std::size_t i = 0; i < screws.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> twist = twist_at(screws[i], point.translation());
    const auto column = before + static_cast<Eigen::Index>(i);
    motion.twists.col(column).head<3>() = base.linear() * twist.head<3>();
    motion.twists.col(column).tail<3>() = base.linear() * twist.tail<3>();
  }
  return motion;
}

StructuredArm changed(const StructuredArm& arm, const StructureFreedom& freedom, const Eigen::VectorXd& change) {
  StructuredArm result = arm;
  Eigen::Index next = 0;
  if (freedom.base) {
    turn(result.robot.sensor_from_base, change.head<3>(), change.segment<3>(3));
    next = 6;
  }
  for (const std::string& target : freedom.tools) {
    const Eigen::Vector3d by = freedom.tool_turns ? change.segment<3>(next + 3) : Eigen::Vector3d::Zero().eval();
    turn(result.robot.tools.at(target), change.segment<3>(next), by);
    next += freedom.tool_size();
  }
  for (double& value : result.values) value += change[next++];
  return result;
}

}  // namespace demecal

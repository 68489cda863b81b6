#include "fitting/parameter_space.hpp"

#include <utility>

#include "errors/check.hpp"
#include "fitting/rotation_vector.hpp"

namespace demecal {
namespace {

using Kind = ParameterId::Kind;
using Twist = Eigen::Matrix<double, 6, 1>;

/// The rotation vectors a change holds, of the base and of each target's tool.
struct Turns {
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  std::map<std::string, Eigen::Vector3d> tools;
};

Turns turns_of(const std::vector<ParameterId>& ids, const Eigen::VectorXd& change) {
  Turns turns;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double value = change[static_cast<Eigen::Index>(i)];
    if (ids[i].kind == Kind::base_rotation) turns.base[ids[i].index] = value;
    if (ids[i].kind == Kind::tool_rotation) {
      turns.tools.try_emplace(ids[i].target, Eigen::Vector3d::Zero()).first->second[ids[i].index] = value;
    }
  }
  return turns;
}

void add(CorrectedRobot& robot, const ParameterId& id, double change) {
  switch (id.kind) {
    case Kind::base_translation:
      robot.sensor_from_base.translation()[id.index] += change;
      return;
    case Kind::tool_translation:
      robot.tools.at(id.target).translation()[id.index] += change;
      return;
    case Kind::link:
      robot.chain.joints[static_cast<std::size_t>(id.index)].parameter(id.link) += change;
      return;
    case Kind::base_rotation:
    case Kind::tool_rotation:
      return;
  }
}

/// What of a pose's prediction the twists of base and tool parameters are made from, in the measurements' frame.
struct Frames {
  Eigen::Matrix3d base;
  Eigen::Matrix3d flange;
  Eigen::Vector3d base_to_tool;
};

Twist twist_of(const ParameterId& id, const ModelPoint& point, const Frames& frames, const LinkJacobian& links) {
  Twist twist = Twist::Zero();
  switch (id.kind) {
    case Kind::base_translation:
      twist[id.index] = 1.0;
      break;
    case Kind::base_rotation:
      twist.tail<3>() = point.base_turns.col(id.index);
      twist.head<3>() = point.base_turns.col(id.index).cross(frames.base_to_tool);
      break;
    case Kind::tool_translation:
      twist.head<3>() = frames.flange.col(id.index);
      break;
    case Kind::tool_rotation:
      twist.tail<3>() = frames.flange * point.tool_turns.at(id.target).col(id.index);
      break;
    case Kind::link: {
      const auto link = links.col(id.index * kLinkParameters + static_cast<int>(id.link));
      twist.head<3>() = frames.base * link.head<3>();
      twist.tail<3>() = frames.base * link.tail<3>();
      break;
    }
  }
  return twist;
}

bool is_of_other_tool(const ParameterId& id, const std::string& target) {
  return (id.kind == Kind::tool_translation || id.kind == Kind::tool_rotation) && id.target != target;
}

}  // namespace

ParameterSpace::ParameterSpace(CorrectedRobot reference, std::vector<ParameterId> ids)
    : reference_(std::move(reference)), ids_(std::move(ids)) {}

ModelPoint ParameterSpace::at(const Eigen::VectorXd& change) const {
  DEMECAL_CHECK(change.size() == size(), change.size() << " changes of " << size() << " parameters");
  ModelPoint point{reference_, Eigen::Matrix3d::Identity(), {}};
  for (int i = 0; i < size(); ++i) add(point.robot, ids_[static_cast<std::size_t>(i)], change[i]);
  const Turns turns = turns_of(ids_, change);
  point.robot.sensor_from_base.linear() = rotation_of(turns.base) * reference_.sensor_from_base.linear();
  point.base_turns = left_jacobian(turns.base);
  for (const auto& [target, turn] : turns.tools) {
    point.robot.tools.at(target).linear() = rotation_of(turn) * reference_.tool(target).linear();
    point.tool_turns[target] = left_jacobian(turn);
  }
  return point;
}

void ParameterSpace::move_tool(const ModelPoint& point, const JointVector& actual, const std::string& target,
                               ToolMotion& motion) const {
  const CorrectedRobot& robot = point.robot;
  const Eigen::Isometry3d& tool = robot.tool(target);
  const Kinematics at = differential_kinematics(robot.chain, actual, tool.translation());
  const Eigen::Isometry3d flange = robot.sensor_from_base * at.flange;
  motion.predicted = flange * tool;
  const Frames frames{robot.sensor_from_base.linear(), flange.linear(),
                      motion.predicted.translation() - robot.sensor_from_base.translation()};
  motion.twists.resize(6, size());
  for (int i = 0; i < size(); ++i) {
    const ParameterId& id = ids_[static_cast<std::size_t>(i)];
    if (is_of_other_tool(id, target)) {
      motion.twists.col(i).setZero();
    } else {
      motion.twists.col(i) = twist_of(id, point, frames, at.links);
    }
  }
}

double parameter_value(const CorrectedRobot& robot, const ParameterId& id) {
  switch (id.kind) {
    case Kind::base_translation:
      return robot.sensor_from_base.translation()[id.index];
    case Kind::base_rotation:
      return vector_of(robot.sensor_from_base.linear())[id.index];
    case Kind::tool_translation:
      return robot.tool(id.target).translation()[id.index];
    case Kind::tool_rotation:
      return vector_of(robot.tool(id.target).linear())[id.index];
    case Kind::link:
      return robot.chain.joints[static_cast<std::size_t>(id.index)].parameter(id.link);
  }
  DEMECAL_CHECK(false, "parameter kind " << static_cast<int>(id.kind));
}

Eigen::MatrixXd value_jacobian(const ParameterSpace& space, const ModelPoint& point) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(space.size(), space.size());
  const auto turned = [](const Eigen::Isometry3d& frame, const Eigen::Matrix3d& turns) -> Eigen::Matrix3d {
    return left_jacobian(vector_of(frame.linear())).inverse() * turns;
  };
  for (int i = 0; i < space.size(); ++i) {
    const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
    if (!(id.is_angle() && id.kind != Kind::link) || id.index != 0) continue;
    jacobian.block<3, 3>(i, i) = id.kind == Kind::base_rotation
                                     ? turned(point.robot.sensor_from_base, point.base_turns)
                                     : turned(point.robot.tool(id.target), point.tool_turns.at(id.target));
  }
  return jacobian;
}

}  // namespace demecal

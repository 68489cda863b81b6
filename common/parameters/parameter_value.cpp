#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "errors/check.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline parameters {

using Kind = ParameterId::Kind;

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
    case Kind::contact:
      return 0.0;
    case Kind::station: {
      const auto found = robot.stations.find(id.target);
      if (found == robot.stations.end()) return 0.0;
      return id.index < 3 ? found->second.translation()[id.index] : vector_of(found->second.linear())[id.index - 3];
    }
    case Kind::effect:
      return static_cast<std::size_t>(id.index) < robot.effects.size()
                 ? robot.effects[static_cast<std::size_t>(id.index)].value(static_cast<std::size_t>(id.coefficient))
                 : 0.0;
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
    if (id.kind == Kind::base_rotation && id.index == 0)
      jacobian.block<3, 3>(i, i) = turned(point.robot.sensor_from_base, point.base_turns);
    if (id.kind == Kind::tool_rotation && id.index == 0)
      jacobian.block<3, 3>(i, i) = turned(point.robot.tool(id.target), point.tool_turns.at(id.target));
    if (id.kind == Kind::station && id.index == 3)
      jacobian.block<3, 3>(i, i) = turned(point.robot.stations.at(id.target), point.station_turns.at(id.target));
  }
  return jacobian;
}

}  // namespace demecal::inline parameters

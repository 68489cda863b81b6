#include "parameters/parameter_space.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "errors/check.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"
#include "parameters/arm_size.hpp"
#include "prediction/contact_place.hpp"

namespace demecal::inline parameters {
namespace {

using Kind = ParameterId::Kind;
using Twist = SmallMotion;

/// The rotation vectors a change holds, of the base, of each target's tool and of each station.
struct RotationVectors {
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  std::map<std::string, Eigen::Vector3d> tools, stations;
};

RotationVectors rotation_vectors_of(const std::vector<ParameterId>& ids, const Eigen::VectorXd& change) {
  RotationVectors turns;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double value = change[static_cast<Eigen::Index>(i)];
    if (ids[i].kind == Kind::base_rotation) turns.base[ids[i].index] = value;
    if (ids[i].kind == Kind::tool_rotation) {
      turns.tools.try_emplace(ids[i].target, Eigen::Vector3d::Zero()).first->second[ids[i].index] = value;
    }
    if (ids[i].kind == Kind::station && ids[i].index >= 3) {
      turns.stations.try_emplace(ids[i].target, Eigen::Vector3d::Zero()).first->second[ids[i].index - 3] = value;
    }
  }
  return turns;
}

void add_change(CorrectedRobot& robot, const ParameterId& id, double change) {
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
    case Kind::effect:
      robot.effects[static_cast<std::size_t>(id.index)].values[static_cast<std::size_t>(id.coefficient)] += change;
      return;
    case Kind::contact:
      if (id.index < 3 || id.index == kRadiusMotion) {  // rotations wait until their whole vector is known
        ContactPlace& place = robot.contacts.at({id.target, id.set});
        place = moved_place(place, id.index, change);
      }
      return;
    case Kind::station:
      if (id.index < 3) robot.stations.at(id.target).translation()[id.index] += change;
      return;
    case Kind::base_rotation:
    case Kind::tool_rotation:
      return;
  }
}

/// What of a pose's prediction the twists of base and tool parameters are made from, in the measurements' frame.
struct TwistFrames {
  Eigen::Matrix3d base;
  Eigen::Matrix3d flange;
  Eigen::Vector3d base_to_tool;
};

Twist twist_of(const ParameterId& id, const ModelPoint& point, const TwistFrames& frames, const LinkJacobian& links) {
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
    case Kind::effect:   // added by motion, since one coefficient may move several places
    case Kind::contact:  // added for the poses that touch it
    case Kind::station:  // added for the poses measured from it
      break;
  }
  return twist;
}

bool is_of_other_tool(const ParameterId& id, const std::string& target) {
  return (id.kind == Kind::tool_translation || id.kind == Kind::tool_rotation) && id.target != target;
}

/// Fills predicted pose and twists of everything but effects.
void move_declared(const std::vector<ParameterId>& ids, const ModelPoint& point, const Kinematics& kinematics,
                   const std::string& target, ToolMotion& motion) {
  const CorrectedRobot& robot = point.robot;
  const Eigen::Isometry3d flange = robot.sensor_from_base * kinematics.flange;
  motion.predicted = flange * robot.tool(target);
  const TwistFrames frames{robot.sensor_from_base.linear(), flange.linear(),
                           motion.predicted.translation() - robot.sensor_from_base.translation()};
  motion.twists.resize(6, static_cast<Eigen::Index>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto twist = motion.twists.col(static_cast<Eigen::Index>(i));
    if (is_of_other_tool(ids[i], target)) {
      twist.setZero();
    } else {
      twist = twist_of(ids[i], point, frames, kinematics.links);
    }
  }
}

/// Moves everything as the instrument's own effects show it.
void move_by_sensor(const SmallMotion& sensor, ToolMotion& motion) {
  if (sensor.isZero(0.0)) return;
  const Eigen::Isometry3d shown = moved(Eigen::Isometry3d::Identity(), sensor);
  motion.predicted = shown * motion.predicted;
  for (auto twist : motion.twists.colwise()) {
    twist.head<3>() = (shown.linear() * twist.head<3>()).eval();
    twist.tail<3>() = (shown.linear() * twist.tail<3>()).eval();
  }
}

/// The twist of a tool point (measurements' frame) per unit of an effect's motion.
class EffectTwists {
 public:
  EffectTwists(const Chain& chain, const Displacement& displaced, const DisplacedKinematics& arm,
               const Eigen::Isometry3d& sensor_from_base, const Eigen::Vector3d& predicted_m)
      : chain_(chain),
        displaced_(displaced),
        arm_(arm),
        base_(moved(Eigen::Isometry3d::Identity(), displaced.sensor) * sensor_from_base),
        predicted_m_(predicted_m),
        in_base_m_(base_.inverse() * predicted_m) {}

  Twist operator()(const UnitMotion& unit) const {
    if (unit.place == kSensorPlace) {
      return unit_twist(Eigen::Isometry3d::Identity(), displaced_.sensor, unit.axis, predicted_m_);
    }
    const auto place = static_cast<std::size_t>(unit.place);
    const Twist twist = is_joint_motion(chain_, unit)
                            ? Twist(arm_.kinematics.drives.col(unit.place))
                            : unit_twist(arm_.places[place], displaced_.places.col(unit.place), unit.axis, in_base_m_);
    Twist turned;
    turned << base_.linear() * twist.head<3>(), base_.linear() * twist.tail<3>();
    return turned;
  }

 private:
  const Chain& chain_;
  const Displacement& displaced_;
  const DisplacedKinematics& arm_;
  Eigen::Isometry3d base_;
  Eigen::Vector3d predicted_m_, in_base_m_;
};

}  // namespace

ParameterSpace::ParameterSpace(CorrectedRobot reference, std::vector<ParameterId> ids)
    : reference_(std::move(reference)), ids_(std::move(ids)), effect_columns_(reference_.effects.size()) {
  for (int i = 0; i < size(); ++i) {
    const ParameterId& id = ids_[static_cast<std::size_t>(i)];
    if (id.kind == Kind::station) reference_.stations.try_emplace(id.target, Eigen::Isometry3d::Identity());
    if (id.kind != Kind::effect) continue;
    DEMECAL_CHECK(id.index < std::ssize(reference_.effects), id.name() << " of " << reference_.effects.size());
    const auto effect = static_cast<std::size_t>(id.index), coefficient = static_cast<std::size_t>(id.coefficient);
    auto& columns = effect_columns_[effect];
    if (columns.size() <= coefficient) columns.resize(coefficient + 1, -1);
    columns[coefficient] = i;
    auto& values = reference_.effects[effect].values;
    if (values.size() <= coefficient) values.resize(coefficient + 1, 0.0);
  }
  const bool touches = std::ranges::any_of(ids_, [](const ParameterId& id) { return id.kind == Kind::contact; });
  size_slopes_ = Eigen::VectorXd::Zero(size());
  if (touches) size_slopes_ = arm_size_slopes(*this);
}

ModelPoint ParameterSpace::at(const Eigen::VectorXd& change) const {
  constexpr double kSmallest = 0.1;  ///< no arm, but a step of a search may go there
  DEMECAL_CHECK(change.size() == size(), change.size() << " changes of " << size() << " parameters");
  ModelPoint point{reference_, Eigen::Matrix3d::Identity(), {}};
  point.size = std::max(kSmallest, 1.0 + size_slopes_.dot(change));
  for (int i = 0; i < size(); ++i) add_change(point.robot, ids_[static_cast<std::size_t>(i)], change[i]);
  const RotationVectors turns = rotation_vectors_of(ids_, change);
  point.robot.sensor_from_base.linear() = rotation_of(turns.base) * reference_.sensor_from_base.linear();
  point.base_turns = left_jacobian(turns.base);
  for (const auto& [target, turn] : turns.tools) {
    point.robot.tools.at(target).linear() = rotation_of(turn) * reference_.tool(target).linear();
    point.tool_turns[target] = left_jacobian(turn);
  }
  for (const auto& [station, turn] : turns.stations) {
    point.robot.stations.at(station).linear() = rotation_of(turn) * reference_.stations.at(station).linear();
    point.station_turns[station] = left_jacobian(turn);
  }
  for (int i = 0; i < size(); ++i) {
    const ParameterId& id = ids_[static_cast<std::size_t>(i)];
    if (id.kind != Kind::contact || id.index < 3 || id.index == kRadiusMotion) continue;
    point.contact_turns.try_emplace({id.target, id.set}, Eigen::Vector3d::Zero()).first->second[id.index - 3] =
        change[i];
  }
  for (const auto& [group, turn] : point.contact_turns) {
    Eigen::Isometry3d& frame = point.robot.contacts.at(group).frame;
    frame.linear() = (frame.linear() * rotation_of(turn)).eval();
  }
  return point;
}

void ParameterSpace::move_contact(const ModelPoint& point, const ContactGroup& group, ToolMotion& motion) const {
  const auto place = point.robot.contacts.find(group);
  if (place == point.robot.contacts.end()) return;
  const auto turned = point.contact_turns.find(group);
  const Eigen::Vector3d turn = turned == point.contact_turns.end() ? Eigen::Vector3d::Zero() : turned->second;
  for (int i = 0; i < size(); ++i) {
    const ParameterId& id = ids_[static_cast<std::size_t>(i)];
    if (id.kind != Kind::contact || id.set != group.set || id.target != group.contact) continue;
    motion.twists.col(i).head<3>() += equivalent_motion(place->second, id.index, turn, motion.predicted.translation());
  }
}

void ParameterSpace::move_station(const ModelPoint& point, const std::string& station, ToolMotion& motion) const {
  const auto turns = point.station_turns.find(station);
  if (turns == point.station_turns.end()) return;
  const Eigen::Vector3d lever_m = motion.predicted.translation() - point.robot.stations.at(station).translation();
  for (int i = 0; i < size(); ++i) {
    const ParameterId& id = ids_[static_cast<std::size_t>(i)];
    if (id.kind != Kind::station || id.target != station) continue;
    auto twist = motion.twists.col(i);  // of the tool the other way, which reads the same
    if (id.index < 3) {
      twist[id.index] -= 1.0;
    } else {
      const Eigen::Vector3d turn = turns->second.col(id.index - 3);
      twist.head<3>() -= turn.cross(lever_m);
      twist.tail<3>() -= turn;
    }
  }
}

void ParameterSpace::move_tool(const ModelPoint& point, const JointVector& corrected,
                               const std::vector<EffectMotion>& motions, const std::string& target,
                               ToolMotion& motion) const {
  const CorrectedRobot& robot = point.robot;
  const Eigen::Vector3d& point_m = robot.tool(target).translation();
  if (motions.empty()) {
    move_declared(ids_, point, differential_kinematics(robot.chain, corrected, point_m), target, motion);
    return;
  }
  const Displacement displaced = displacement(robot.chain, robot.effects, motions);
  const DisplacedKinematics arm =
      differential_kinematics(robot.chain, corrected + displaced.joints, point_m, displaced.places);
  move_declared(ids_, point, arm.kinematics, target, motion);
  move_by_sensor(displaced.sensor, motion);
  const EffectTwists twist(robot.chain, displaced, arm, robot.sensor_from_base, motion.predicted.translation());
  for (const auto& [effect, unit] : motions) {
    const auto& columns = effect_columns_[static_cast<std::size_t>(effect)];
    const auto coefficient = static_cast<std::size_t>(unit.coefficient);
    if (coefficient >= columns.size() || columns[coefficient] < 0) continue;
    motion.twists.col(columns[coefficient]) += unit.size * twist(unit);
  }
}

}  // namespace demecal::inline parameters

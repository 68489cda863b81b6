#include "kinematics/forward.hpp"

#include "kinematics/angles.hpp"

namespace demecal::inline kinematics {
namespace {

constexpr auto kStays = [](int, Eigen::Isometry3d&) {};

/// Moves places as told, and nothing where a place does not move.
auto by(const PlaceMotions& motions) {
  return [&motions](int place, Eigen::Isometry3d& frame) {
    if (!motions.col(place).isZero(0.0)) frame = moved(frame, motions.col(place));
  };
}

void check_places(const Chain& chain, const PlaceMotions& motions) {
  DEMECAL_CHECK(motions.cols() == chain.size() + 1, motions.cols() << " motions for " << chain.size() << " joints");
}

int moving_column(const Chain& chain, int joint) {
  const bool revolute = is_revolute(chain, joint);
  return joint * kLinkParameters + static_cast<int>(revolute ? LinkParameter::theta : LinkParameter::d);
}

}  // namespace

Eigen::Isometry3d forward(const Chain& chain, const JointVector& q) {
  return walk(
      chain, q, [](int, LinkParameter, const Screw&) {}, kStays);
}

FixedTurns::FixedTurns(const Chain& chain) : chain_(chain) {
  for (std::size_t i = 0; i < chain.joints.size(); ++i)
    for (const Elementary& transform : elementary_transforms(chain.convention))
      if (transform.rotates && transform.parameter != moving_parameter(chain.joints[i]))
        turns_[i * kLinkParameters + static_cast<std::size_t>(transform.parameter)] =
            turn_by(chain.joints[i].parameter(transform.parameter));
}

Eigen::Isometry3d forward(const FixedTurns& turns, const JointVector& q) {
  return walk(
      turns.chain(), turns, q, [](int, LinkParameter, const Screw&) {}, kStays);
}

Eigen::Vector3d tool_position(const Chain& chain, const JointVector& q) {
  return forward(chain, q) * chain.tool_m;
}

Kinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  ScrewList screws;
  const Eigen::Isometry3d flange = walk(
      chain, q, [&](int joint, LinkParameter parameter, const Screw& screw) { screws(joint, parameter, screw); },
      kStays);
  return screws.kinematics(chain, flange, point_m);
}

Kinematics differential_kinematics(const FixedTurns& turns, const JointVector& q, const Eigen::Vector3d& point_m) {
  ScrewList screws;
  const Eigen::Isometry3d flange = walk(
      turns.chain(), turns, q,
      [&](int joint, LinkParameter parameter, const Screw& screw) { screws(joint, parameter, screw); }, kStays);
  return screws.kinematics(turns.chain(), flange, point_m);
}

Jacobian joint_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  return differential_kinematics(chain, q, point_m).joints;
}

LinkJacobian link_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  return differential_kinematics(chain, q, point_m).links;
}

Jacobian by_drives(const Chain& chain, Jacobian by_commands) {
  // From the last joint on: what a coupling leads to is then by its drive already.
  for (auto coupling = chain.couplings.rbegin(); coupling != chain.couplings.rend(); ++coupling)
    by_commands.col(coupling->from) -= coupling->factor * by_commands.col(coupling->joint);
  return by_commands;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& frame, const SmallMotion& motion) {
  Eigen::Isometry3d result = frame;
  result.translation() += frame.linear() * motion.head<3>();
  result.linear() = frame.linear() * rotation_of(motion.tail<3>());
  return result;
}

SmallMotion unit_twist(const Eigen::Isometry3d& frame, const SmallMotion& motion, int axis,
                       const Eigen::Vector3d& point) {
  if (axis < 3) return twist_at({false, frame.linear().col(axis), frame.translation()}, point);
  const Eigen::Vector3d turn = motion.tail<3>();
  Eigen::Vector3d direction = frame.linear().col(axis - 3);
  if (!turn.isZero(0.0)) direction = frame.linear() * left_jacobian(turn).col(axis - 3);
  return twist_at({true, direction, frame * motion.head<3>()}, point);
}

Eigen::Isometry3d forward(const Chain& chain, const JointVector& q, const PlaceMotions& motions) {
  check_places(chain, motions);
  return walk(
      chain, q, [](int, LinkParameter, const Screw&) {}, by(motions));
}

DisplacedKinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m,
                                            const PlaceMotions& motions) {
  check_places(chain, motions);
  DisplacedKinematics result;
  ScrewList screws;
  const Eigen::Isometry3d flange = walk(
      chain, q, [&](int joint, LinkParameter parameter, const Screw& screw) { screws(joint, parameter, screw); },
      [&](int place, Eigen::Isometry3d& frame) {
        result.places[static_cast<std::size_t>(place)] = frame;
        by(motions)(place, frame);
      });
  result.kinematics = screws.kinematics(chain, flange, point_m);
  return result;
}

Kinematics ScrewList::kinematics(const Chain& chain, const Eigen::Isometry3d& flange,
                                 const Eigen::Vector3d& point_m) const {
  Kinematics result;
  result.flange = flange;
  const Eigen::Vector3d point = flange * point_m;
  result.links.resize(6, chain.size() * kLinkParameters);
  for (int column = 0; column < result.links.cols(); ++column) {
    result.links.col(column) = twist_at(screws_[static_cast<std::size_t>(column)], point);
  }
  result.drives.resize(6, chain.size());
  for (int joint = 0; joint < chain.size(); ++joint) {
    result.drives.col(joint) = result.links.col(moving_column(chain, joint));
  }
  result.joints = result.drives;
  for (const CommandCoupling& coupling : chain.couplings)
    result.joints.col(coupling.from) += coupling.factor * result.drives.col(coupling.joint);
  return result;
}

}  // namespace demecal::inline kinematics

// An arm as files draw it: Denavit-Hartenberg rows or a URDF's origins and axes, joints that count the other way or
// from another zero, and what stands before and behind the chain; and the chain that moves in the same way.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal::inline kinematics {

/// A place by the numbers of a URDF's origin: a shift, and angles about the fixed axes x, then y, then z.
struct Origin {
  Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy_rad = Eigen::Vector3d::Zero();

  bool operator==(const Origin&) const = default;
};

Eigen::Isometry3d pose_of(const Origin& origin);
/// The origin of a pose: of the angles that make it up, those nearest to `near`.
Origin origin_of(const Eigen::Isometry3d& pose, const Origin& near = {});

/// A joint as it is drawn. Its own value is direction * command + offset.
struct DrawnJoint {
  std::string name{};
  Joint row{};             ///< type and limits (of the command); its numbers where it is drawn as a row
  Origin origin{};         ///< drawn by axes: its link's frame at value 0, in the link before
  Eigen::Vector3d axis{};  ///< drawn by axes: in its own frame, any length but 0
  int direction = 1;       ///< 1 or -1
  double offset = 0.0;     ///< rad or m
};

/// A positioner as it is drawn: from what the arm stands on to the workpiece.
struct DrawnPositioner {
  std::vector<DrawnJoint> joints;
  Origin workpiece{};            ///< in the last joint's frame
  Origin base{}, first_joint{};  ///< of the arm, as they are drawn without the positioner
};

struct DrawnArm {
  bool by_axes = false;  ///< by a URDF's origins and axes, which have no convention
  Convention convention = Convention::modified_dh;
  std::vector<DrawnJoint> joints;
  Origin base{}, flange{};
  std::vector<CommandCoupling> couplings{};
  std::vector<Eigen::Vector3d> centres_m{};  ///< of the links' masses, each in its link's frame; empty: unknown
  /// Where there is one, `joints` begin with its joints, backwards from the workpiece.
  std::optional<DrawnPositioner> positioner{};
};

/// The arm, drawn by axes, as a workpiece sees it: the positioner's joints, taken backwards, stand before the arm's, so
/// that the one nearest to the workpiece is joint 1. They have the same values as before.
DrawnArm behind_positioner(const DrawnArm& arm, const std::vector<DrawnJoint>& positioner, const Origin& workpiece);

/// The chain of a drawn arm: its joints' values are the commands, and its axes point as the joints count.
struct EquivalentChain {
  Chain chain;  ///< without a tool
  /// Of every joint, the drawn frame of its link in the frame of the chain's link.
  std::vector<Eigen::Isometry3d> drawn_links;
};

/// Rows are kept as they are where a joint counts along its axis, and turned about x by half a turn where it does not.
/// Origins and axes become rows of modified Denavit-Hartenberg with Hayati's beta between near-parallel axes, so that
/// no number is far larger than the arm; frames stay near the drawn ones along axes.
EquivalentChain equivalent_chain(const DrawnArm& arm);

/// The origins, one a joint, of an arm drawn by axes that moves as `chain`, whose rows are those of
/// equivalent_chain(arm) with other numbers: every joint's frame stays where it was drawn along and about its axis, as
/// far as the rows leave it.
std::vector<Origin> origins_of(const DrawnArm& arm, const Chain& chain);

}  // namespace demecal::inline kinematics

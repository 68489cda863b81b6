// Where an arm may go, and where it can be measured: limits, walls, obstacles, and the instrument's view; and how much
// room the arm takes: capsules about the lines from joint to joint, and how far bodies are from each other.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// All points within `radius_m` of a line from one point to another.
struct Capsule {
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
};

/// The smallest distance between two straight lines of finite length, m; either may be a point.
double segment_distance(const Eigen::Vector3d& from1, const Eigen::Vector3d& to1, const Eigen::Vector3d& from2,
                        const Eigen::Vector3d& to2);

/// How far the surfaces of two capsules are apart, m; below 0 where they meet.
double clearance(const Capsule& one, const Capsule& other);

/// A part of the arm: the line along one of a link's offsets, or from the flange to a target.
struct ArmPart {
  int link = 0;          ///< whose offset it is, from 0; the number of joints: the tool
  double begin_m = 0.0;  ///< where it begins and ends along the arm, from the base
  double end_m = 0.0;
  Capsule body;
};

/// The parts from the base on, at joint values `q`. `radii_m`: of every link and, last, the tool; `targets_m`: where
/// parts lead to from the flange, last link's frame.
std::vector<ArmPart> arm_parts(const Chain& chain, const JointVector& q, const std::vector<double>& radii_m,
                               const std::vector<Eigen::Vector3d>& targets_m);

/// Whether two parts of an arm meet. Parts that are near each other along the arm always do, or can never: they do not
/// count.
bool parts_meet(const ArmPart& one, const ArmPart& other);

/// The sum of all lengths that links may have from the first joint that turns on, m: a rail carries an arm and makes it
/// no thicker.
double reach_m(const Chain& chain);

/// No part of an arm is thinner: smaller radii are metres written for millimetres.
inline constexpr double kLeastRadius_m = 5e-3;

/// What is assumed of an arm whose thickness nobody states: so much of its reach.
std::vector<double> assumed_radii(const Chain& chain);

/// Allowed are points whose height along the unit vector `normal` is `height_m` at least; base frame.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double height_m = 0.0;
  bool of_arm = false;  ///< the whole arm keeps to it; otherwise its tool point alone
};

/// The tool's direction, fixed on the flange, stays within a cone; base frame.
struct ToolCone {
  Eigen::Vector3d tool_direction = Eigen::Vector3d::UnitZ();  ///< flange frame
  Eigen::Vector3d about = -Eigen::Vector3d::UnitZ();
  double half_angle_rad = std::numbers::pi;
};

/// Where the instrument is, and from where it sees the target.
struct Instrument {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< base frame
  double nearest_m = 0.0, farthest_m = 1e3;
  std::optional<Eigen::Vector3d> target_direction{};  ///< flange frame: where the target looks; none: everywhere
  double half_angle_rad = std::numbers::pi;           ///< at which it still reflects
  bool measures_orientation = false;
  bool line_of_sight = true;  ///< the beam must pass the arm and the obstacles
};

/// Where sockets may be put that the tool is to touch, and what is known between two of them.
struct SocketRoom {
  std::optional<Eigen::AlignedBox3d> box{};  ///< m, base frame; none: wherever the tool gets
  std::optional<double> length_m{};          ///< between the two sockets of one block; none: sockets stand alone
  double length_sigma_m = 2e-5;              ///< its standard uncertainty
};

struct WorkCell {
  std::optional<Eigen::AlignedBox3d> tool_box;  ///< m, base frame
  std::vector<HalfSpace> half_spaces;
  std::vector<Capsule> obstacles;
  std::vector<double> radii_m;  ///< of every link and, last, the tool; empty: assumed_radii()
  std::optional<ToolCone> tool_cone;
  std::optional<Instrument> instrument;
  std::vector<std::optional<Interval>> ranges;  ///< of the joints, within their limits; empty: the limits
  std::optional<double> noise_m;                ///< of a measured position, standard deviation per axis
  SocketRoom sockets{};                         ///< for measuring without an instrument
};

/// What is assumed where nobody describes the cell: an arm of usual thickness, and nothing below the plane it stands
/// on, where its base frame says which that is.
WorkCell assumed_cell(const Robot& robot);

/// Whether base frames like this one's lie in the plane the arm stands on: its first link rises from it.
bool stands_on_base_plane(const Robot& robot);

/// To what controllers take: 0.001 deg and 0.001 mm.
JointVector rounded(const Chain& chain, JointVector joints);

/// Why a pose cannot be used.
enum class Obstruction { none, limits, tool_box, half_space, itself, obstacle, tool_cone, range, target_cone, sight };
inline constexpr std::size_t kObstructions = 10;
/// As people call it: "outside the tool's box".
std::string_view to_string(Obstruction obstruction);

/// The arm in its cell.
class FeasibleSpace {
 public:
  /// `targets_m`: all that are measured, last link's frame; none: the robot's tool point.
  FeasibleSpace(Robot robot, WorkCell cell, std::vector<Eigen::Vector3d> targets_m = {});

  /// Whose radii are those assumed where none are stated.
  const WorkCell& cell() const { return cell_; }
  const Robot& robot() const { return robot_; }
  /// Of every joint: within its limits, 2 % of them off their ends, at most one turn about their middle.
  const std::vector<Interval>& ranges() const { return ranges_; }

  /// What keeps the arm from being measured there, or one of its targets.
  Obstruction obstruction(const JointVector& joints) const;
  /// The same of passing there: the instrument need not see it, nor the tool keep to its cone, and joints whose range
  /// nobody states may be anywhere within their limits.
  Obstruction in_passing(const JointVector& joints) const;
  /// The ends of all parts of the arm: a part moves by no more than its ends.
  std::vector<Eigen::Vector3d> part_ends(const JointVector& joints) const;
  /// Joints uniform in the ranges, feasible or not.
  JointVector draw(RandomStream& random) const;

 private:
  /// The arm at some joints.
  struct Posture {
    Eigen::Isometry3d flange;
    std::vector<Eigen::Vector3d> targets_m;  ///< base frame
    std::vector<ArmPart> parts;
  };
  Posture posture(const JointVector& joints) const;
  Obstruction of_bodies(const Posture& posture) const;
  Obstruction of_view(const Posture& posture) const;
  Obstruction of_view(const Posture& posture, const Eigen::Vector3d& target_m) const;

  Robot robot_;
  WorkCell cell_;
  std::vector<Eigen::Vector3d> targets_m_;
  std::vector<Interval> ranges_, passing_ranges_;
};

}  // namespace demecal::inline planning

#include "planning/cell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline planning {
namespace {

constexpr double kNoLength_m = 1e-3;

double clamped_share(double share) {
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace

double segment_distance(const Eigen::Vector3d& from1, const Eigen::Vector3d& to1, const Eigen::Vector3d& from2,
                        const Eigen::Vector3d& to2) {
  constexpr double kTiny = 1e-18;
  const Eigen::Vector3d along1 = to1 - from1, along2 = to2 - from2, between = from1 - from2;
  const double square1 = along1.squaredNorm(), square2 = along2.squaredNorm();
  const double dot = along1.dot(along2), ahead1 = along1.dot(between), ahead2 = along2.dot(between);
  const double spread = square1 * square2 - dot * dot;  // 0 where the lines are parallel, or one is a point
  double share1 = 0.0, share2 = 0.0;
  if (square1 > kTiny) {
    if (spread > kTiny * square1 * std::max(square2, 1.0))
      share1 = clamped_share((dot * ahead2 - ahead1 * square2) / spread);
    else if (square2 <= kTiny)
      share1 = clamped_share(-ahead1 / square1);
  }
  if (square2 > kTiny) share2 = (dot * share1 + ahead2) / square2;
  if (share2 < 0.0 || share2 > 1.0) {
    share2 = clamped_share(share2);
    if (square1 > kTiny) share1 = clamped_share((dot * share2 - ahead1) / square1);
  }
  return (between + share1 * along1 - share2 * along2).norm();
}

double clearance(const Capsule& one, const Capsule& other) {
  return segment_distance(one.from_m, one.to_m, other.from_m, other.to_m) - one.radius_m - other.radius_m;
}

std::vector<ArmPart> arm_parts(const Chain& chain, const JointVector& q, const std::vector<double>& radii_m,
                               const std::vector<Eigen::Vector3d>& targets_m) {
  std::vector<ArmPart> parts;
  Eigen::Vector3d here = Eigen::Vector3d::Zero();
  double along = 0.0;
  const auto reach = [&](const Eigen::Vector3d& point, int link) {
    const double length = (point - here).norm();
    if (length < kNoLength_m) return;
    parts.push_back({link, along, along + length, {here, point, radii_m[static_cast<std::size_t>(link)]}});
    along += length;
    here = point;
  };
  int link = 0;
  const Eigen::Isometry3d flange = walk(
      chain, q,
      [&](int joint, LinkParameter, const Screw& screw) {
        reach(screw.origin, link);
        link = joint;
      },
      [](int, Eigen::Isometry3d&) {});
  reach(flange.translation(), link);
  const Eigen::Vector3d end_m = here;
  const double arm_m = along;
  for (const Eigen::Vector3d& target_m : targets_m) {
    here = end_m;
    along = arm_m;
    reach(flange * target_m, chain.size());
  }
  return parts;
}

bool parts_meet(const ArmPart& one, const ArmPart& other) {
  constexpr double kFolded = 1.25;  // two bodies this close along the arm touch by construction
  const double between = std::max(one.begin_m, other.begin_m) - std::min(one.end_m, other.end_m);
  if (between < kFolded * 2.0 * (one.body.radius_m + other.body.radius_m)) return false;
  return clearance(one.body, other.body) < 0.0;
}

double reach_m(const Chain& chain) {
  // A rail that carries the arm makes it no thicker.
  auto first = std::ranges::find_if(chain.joints, [](const Joint& joint) { return is_revolute(joint); });
  if (first == chain.joints.end()) first = chain.joints.begin();
  double reach = chain.tool_m.norm();
  for (auto joint = first; joint != chain.joints.end(); ++joint) {
    reach += std::abs(joint->a_m) + std::abs(joint->d_m);
    if (!is_revolute(*joint)) reach += std::max(std::abs(joint->lower), std::abs(joint->upper));
  }
  return reach;
}

std::vector<double> assumed_radii(const Chain& chain) {
  constexpr double kLink = 0.04, kTool = 0.015;  // of the reach: of usual industrial arms
  std::vector<double> radii(chain.joints.size() + 1, kLink * reach_m(chain));
  radii.back() = kTool * reach_m(chain);
  for (double& radius : radii) radius = std::max(radius, kLeastRadius_m);
  return radii;
}

namespace {

Interval planned_range(const Joint& joint, const std::optional<Interval>& stated) {
  Interval range{joint.lower, joint.upper};
  if (stated) range = {std::max(range.lower, stated->lower), std::min(range.upper, stated->upper)};
  const double margin = stated ? 0.0 : kLimitMargin * (range.upper - range.lower);
  range = {range.lower + margin, range.upper - margin};
  if (!stated && is_revolute(joint) && range.upper - range.lower > 2.0 * std::numbers::pi) {
    const double middle = 0.5 * (range.lower + range.upper);
    range = {middle - std::numbers::pi, middle + std::numbers::pi};
  }
  return range;
}

bool all_within(const std::vector<Interval>& ranges, const JointVector& joints) {
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double value = joints[static_cast<Eigen::Index>(i)];
    if (value < ranges[i].lower || value > ranges[i].upper) return false;
  }
  return true;
}

/// The angle between two directions, rad.
double angle_between(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

}  // namespace

JointVector rounded(const Chain& chain, JointVector joints) {
  constexpr double kFine_mm = 1e-3;
  constexpr double kFine_deg = 1e-3;
  for (int i = 0; i < chain.size(); ++i) {
    const double fine = is_revolute(chain, i) ? radians(kFine_deg) : metres(kFine_mm);
    joints[i] = std::round(joints[i] / fine) * fine;
  }
  return joints;
}

bool stands_on_base_plane(const Robot& robot) {
  constexpr double kRises_m = 0.02;
  const Joint& first = robot.chain.joints.front();
  return is_revolute(first) && first.d_m > kRises_m;
}

WorkCell assumed_cell(const Robot& robot) {
  WorkCell cell;
  cell.radii_m = assumed_radii(robot.chain);
  if (stands_on_base_plane(robot)) cell.half_spaces.push_back({Eigen::Vector3d::UnitZ(), 0.0, true});
  return cell;
}

std::string_view to_string(Obstruction obstruction) {
  constexpr std::array<std::string_view, kObstructions> kWords{"feasible",
                                                               "outside the joints' ranges",
                                                               "outside the tool's box",
                                                               "beyond a half-space",
                                                               "the arm meets itself",
                                                               "the arm meets an obstacle",
                                                               "outside the tool's cone",
                                                               "out of the instrument's range",
                                                               "the target looks away from the instrument",
                                                               "the line of sight is blocked"};
  return kWords[static_cast<std::size_t>(obstruction)];
}

FeasibleSpace::FeasibleSpace(Robot robot, WorkCell cell, std::vector<Eigen::Vector3d> targets_m)
    : robot_(std::move(robot)), cell_(std::move(cell)), targets_m_(std::move(targets_m)) {
  if (cell_.radii_m.empty()) cell_.radii_m = assumed_radii(robot_.chain);
  if (targets_m_.empty()) targets_m_.push_back(robot_.chain.tool_m);
  for (std::size_t i = 0; i < robot_.chain.joints.size(); ++i) {
    const Joint& joint = robot_.chain.joints[i];
    const std::optional<Interval> stated = i < cell_.ranges.size() ? cell_.ranges[i] : std::nullopt;
    ranges_.push_back(planned_range(joint, stated));
    passing_ranges_.push_back(stated ? ranges_.back() : Interval{joint.lower, joint.upper});
  }
}

FeasibleSpace::Posture FeasibleSpace::posture(const JointVector& joints) const {
  Posture posture{forward(robot_.chain, joints), {}, arm_parts(robot_.chain, joints, cell_.radii_m, targets_m_)};
  for (const Eigen::Vector3d& target_m : targets_m_) posture.targets_m.push_back(posture.flange * target_m);
  return posture;
}

Obstruction FeasibleSpace::of_bodies(const Posture& posture) const {
  constexpr double kOnBase_m = 1e-6;  // the foot of the arm stands in the plane that the rest keeps off
  const auto in_box = [&](const Eigen::Vector3d& target_m) { return cell_.tool_box->contains(target_m); };
  if (cell_.tool_box && !std::ranges::all_of(posture.targets_m, in_box)) return Obstruction::tool_box;
  for (const HalfSpace& space : cell_.half_spaces) {
    for (const Eigen::Vector3d& target_m : posture.targets_m)
      if (space.normal.dot(target_m) < space.height_m) return Obstruction::half_space;
    if (!space.of_arm) continue;
    for (const ArmPart& part : posture.parts) {
      if (part.begin_m < kOnBase_m) continue;
      const double lowest = std::min(space.normal.dot(part.body.from_m), space.normal.dot(part.body.to_m));
      const bool on_foot = part.link == 0;
      if (!on_foot && lowest - part.body.radius_m < space.height_m) return Obstruction::half_space;
    }
  }
  for (std::size_t i = 0; i < posture.parts.size(); ++i) {
    for (const Capsule& obstacle : cell_.obstacles)
      if (clearance(posture.parts[i].body, obstacle) < 0.0) return Obstruction::obstacle;
    for (std::size_t k = 0; k < i; ++k)
      if (parts_meet(posture.parts[i], posture.parts[k])) return Obstruction::itself;
  }
  return Obstruction::none;
}

Obstruction FeasibleSpace::of_view(const Posture& posture, const Eigen::Vector3d& target_m) const {
  constexpr double kOnFlange_m = 1e-3;
  const Instrument& instrument = *cell_.instrument;
  const Eigen::Vector3d to_instrument = instrument.position_m - target_m;
  const double distance = to_instrument.norm();
  if (distance < instrument.nearest_m || distance > instrument.farthest_m) return Obstruction::range;
  if (instrument.target_direction) {
    const Eigen::Vector3d looks = posture.flange.linear() * *instrument.target_direction;
    if (angle_between(looks, to_instrument) > instrument.half_angle_rad) return Obstruction::target_cone;
  }
  if (!instrument.line_of_sight) return Obstruction::none;
  const Capsule beam{instrument.position_m, target_m, 0.0};
  for (const Capsule& obstacle : cell_.obstacles)
    if (clearance(beam, obstacle) < 0.0) return Obstruction::sight;
  // What carries targets ends the beam: the tool, or the last link where a target is on it.
  for (const ArmPart& part : posture.parts) {
    const bool carries = part.link == robot_.chain.size() || (part.body.to_m - target_m).norm() < kOnFlange_m;
    if (!carries && clearance(beam, part.body) < 0.0) return Obstruction::sight;
  }
  return Obstruction::none;
}

Obstruction FeasibleSpace::of_view(const Posture& posture) const {
  if (!cell_.instrument) return Obstruction::none;
  for (const Eigen::Vector3d& target_m : posture.targets_m)
    if (const Obstruction view = of_view(posture, target_m); view != Obstruction::none) return view;
  return Obstruction::none;
}

Obstruction FeasibleSpace::in_passing(const JointVector& joints) const {
  return all_within(passing_ranges_, joints) ? of_bodies(posture(joints)) : Obstruction::limits;
}

std::vector<Eigen::Vector3d> FeasibleSpace::part_ends(const JointVector& joints) const {
  std::vector<Eigen::Vector3d> ends;
  const Eigen::Isometry3d flange = walk(
      robot_.chain, joints, [&](int, LinkParameter, const Screw& screw) { ends.push_back(screw.origin); },
      [](int, Eigen::Isometry3d&) {});
  ends.push_back(flange.translation());
  for (const Eigen::Vector3d& target_m : targets_m_) ends.push_back(flange * target_m);
  return ends;
}

Obstruction FeasibleSpace::obstruction(const JointVector& joints) const {
  if (!all_within(ranges_, joints)) return Obstruction::limits;
  const Posture posture = this->posture(joints);
  if (cell_.tool_cone) {
    const Eigen::Vector3d direction = posture.flange.linear() * cell_.tool_cone->tool_direction;
    if (angle_between(direction, cell_.tool_cone->about) > cell_.tool_cone->half_angle_rad)
      return Obstruction::tool_cone;
  }
  const Obstruction body = of_bodies(posture);
  return body == Obstruction::none ? of_view(posture) : body;
}

JointVector FeasibleSpace::draw(RandomStream& random) const {
  JointVector joints(static_cast<Eigen::Index>(ranges_.size()));
  for (std::size_t i = 0; i < ranges_.size(); ++i)
    joints[static_cast<Eigen::Index>(i)] = random.real(ranges_[i].lower, ranges_[i].upper);
  return rounded(robot_.chain, joints);
}

}  // namespace demecal::inline planning

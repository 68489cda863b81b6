#include "urdf/urdf_arm.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline urdf {
namespace {

constexpr double kShortestAxis = 1e-6;
constexpr double kEndless_rad = 100.0;    ///< limits beyond are written where there are none
constexpr double kAssumedTravel_m = 1.0;  ///< of a sliding joint that states no limits

constexpr double kFarthest_m = 100.0;  ///< as in robot files
constexpr double kFar_m = 5.0;         ///< from one joint to the next: farther than arms reach

[[noreturn]] void refuse(const UrdfFile& urdf, const UrdfJoint& joint, const std::string& rule) {
  throw InputError({urdf.file, joint.line}, joint.name, rule);
}

void require_link(const UrdfFile& urdf, const std::string& name, const char* option) {
  std::vector<std::string> known;
  for (const UrdfLink& link : urdf.links) known.push_back(link.name);
  if (std::ranges::find(known, name) != known.end()) return;
  throw InputError({urdf.file, 0}, name,
                   std::string("is no link of this file (") + option + "); nearest is " + nearest_name(name, known));
}

void require_near(const UrdfFile& urdf, const UrdfJoint& joint) {
  const double far_m = joint.origin.xyz_m.cwiseAbs().maxCoeff();
  if (far_m > kFarthest_m)
    refuse(urdf, joint,
           "stands " + number_text(far_m) + " m from link " + joint.parent +
               ", and may stand 100 m away: the file counts in metres; where its lengths are mm, divide all by 1000");
}

/// Says what may be in mm or degrees.
void note_units(const UrdfJoint& joint, std::vector<std::string>& notes) {
  const double far_m = joint.origin.xyz_m.cwiseAbs().maxCoeff();
  if (far_m > kFar_m)
    notes.push_back("joint " + joint.name + " stands " + number_text(far_m) + " m from link " + joint.parent +
                    ", farther than arms reach: the file counts in metres, and this may be mm");
  const auto no_radians = [](double angle) {
    return std::abs(angle) > kTurn_rad || (std::abs(angle) >= 4.0 && angle == std::round(angle));
  };
  const Eigen::Vector3d& rpy = joint.written_rpy;
  const auto odd = std::ranges::find_if(rpy, no_radians);
  if (odd != rpy.end())
    notes.push_back("joint " + joint.name + " or its links are turned by an angle of " + number_text(*odd) +
                    ": the file counts in radians, and this may be degrees");
}

/// The way from one link to another: up over fixed joints, and down.
struct Way {
  Eigen::Isometry3d up = Eigen::Isometry3d::Identity();  ///< of the link where it turns, in the first link's frame
  bool straight = true;                                  ///< it only leads down
  std::vector<const UrdfJoint*> down;
};

bool hangs_on(const UrdfFile& urdf, const std::string& below, const std::string& above) {
  std::string at = below;
  for (const UrdfJoint* joint = nullptr; at != above; at = joint->parent) {
    joint = urdf.joint_to(at);
    if (joint == nullptr) return false;
  }
  return true;
}

Way way_between(const UrdfFile& urdf, const std::string& base, const std::string& tip) {
  Way way;
  std::string at = base;
  while (!hangs_on(urdf, tip, at)) {
    const UrdfJoint* joint = urdf.joint_to(at);
    if (joint == nullptr || moves(*joint)) {
      throw InputError({urdf.file, urdf.link(tip).line}, tip,
                       "is a link that does not hang on link " + base + ", nor on a link that " + base +
                           " is fixed to; the arm must lead from --base to --tip");
    }
    require_near(urdf, *joint);
    way.up = way.up * pose_of(joint->origin).inverse();
    way.straight = false;
    at = joint->parent;
  }
  way.down = joints_down(urdf, at, tip);
  return way;
}

void set_limits(const UrdfJoint& joint, Joint& row, std::vector<std::string>& notes) {
  const bool slides = joint.type == UrdfType::prismatic;
  row.type = slides ? JointType::prismatic : JointType::revolute;
  row.lower = std::min(joint.lower, joint.upper);
  row.upper = std::max(joint.lower, joint.upper);
  if (joint.lower > joint.upper)
    notes.push_back("joint " + joint.name + " has its lower limit above the upper one; they were exchanged");
  const bool stated = row.lower < row.upper;
  if (slides && !stated) {
    notes.push_back("joint " + joint.name + " states no limits; -1000 to 1000 mm were written: correct limits_mm");
    row.lower = -kAssumedTravel_m;
    row.upper = kAssumedTravel_m;
  }
  const bool beyond = stated && std::max(-row.lower, row.upper) > kEndless_rad;
  if (slides || (joint.type == UrdfType::revolute && stated && !beyond)) return;
  if (joint.type == UrdfType::revolute && !stated)
    notes.push_back("joint " + joint.name + " states no limits and is taken to turn on and on (type: continuous)");
  constexpr double kDegrees_rad = 1000.0;  // more is written where there are no limits
  if (beyond && joint.type == UrdfType::revolute && row.upper - row.lower < kDegrees_rad)
    notes.push_back("joint " + joint.name + " has limits of " + number_text(row.lower) + " to " +
                    number_text(row.upper) +
                    " rad, more than any arm turns, and is taken to turn on and on: they may be in degrees");
  row.endless = true;
  row.upper = kTurn_rad;
  row.lower = -row.upper;
}

void check_moving(const UrdfFile& urdf, const UrdfJoint& joint, const Way& way, std::vector<std::string>& notes) {
  if (joint.type > UrdfType::fixed) {
    refuse(urdf, joint,
           "is a " + std::string(to_string(joint.type)) +
               " joint, which no serial arm has; say --base LINK and --tip LINK on one side of it");
  }
  if (joint.axis.norm() < kShortestAxis)
    refuse(urdf, joint,
           "has an axis of zero length: it must be the direction that the joint turns about or slides along");
  if (std::abs(joint.axis.norm() - 1.0) > 1e-3) {
    notes.push_back("the axis of joint " + joint.name + " has length " +
                    number_text(std::round(1e6 * joint.axis.norm()) / 1e6) + " and is taken as a direction");
  }
  if (!joint.mimics) return;
  if (std::ranges::any_of(way.down, [&](const UrdfJoint* other) { return other->name == *joint.mimics; }))
    refuse(urdf, joint,
           "follows joint " + *joint.mimics +
               " (mimic) of the same arm: an arm all of whose joints are "
               "commanded by themselves is needed");
  notes.push_back("joint " + joint.name + " follows joint " + *joint.mimics +
                  " (mimic), which is not part of this arm; it is taken as a joint of its own");
}

DrawnJoint drawn(const UrdfJoint& joint, const std::optional<Eigen::Isometry3d>& before,
                 std::vector<std::string>& notes) {
  DrawnJoint made{.name = joint.name, .origin = joint.origin, .axis = joint.axis};
  set_limits(joint, made.row, notes);
  if (before) made.origin = origin_of(*before * pose_of(joint.origin), joint.origin);
  if (made.origin.rpy_rad.cwiseAbs().maxCoeff() > kTurn_rad) made.origin = origin_of(pose_of(made.origin));
  return made;
}

/// What moves with a joint, up to the next one, in its child link's frame.
struct MovedBodies {
  LinkMass mass{};
  bool stated = false;  ///< a mass above 0
  /// Nothing where a link with a mass states none, or one that no body has.
  std::optional<Eigen::Matrix3d> inertia_kgm2{};
  std::string without{};  ///< the first such link
};

MovedBodies bodies_between(const UrdfFile& urdf, const UrdfJoint& after, const UrdfJoint* next,
                           std::vector<std::string>& notes) {
  struct Part {
    std::string link;
    Eigen::Isometry3d pose;
  };
  MovedBodies sum;
  std::vector<InertialBody> bodies;
  std::vector<Part> parts{{after.child, Eigen::Isometry3d::Identity()}};
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    const UrdfLink& link = urdf.link(part.link);
    if (const auto& mass = link.mass; mass && mass->mass_kg > 0.0) {
      sum.stated = true;
      const Eigen::Vector3d centre_m = part.pose * mass->centre_m;
      const double both_kg = sum.mass.mass_kg + mass->mass_kg;
      sum.mass.centre_m += mass->mass_kg / both_kg * (centre_m - sum.mass.centre_m);
      sum.mass.mass_kg = both_kg;
      const std::string fault = link.inertia_kgm2 ? fault_of_inertia(*link.inertia_kgm2) : "";
      if (!fault.empty()) notes.push_back("the inertia of link " + link.name + " is left out: it " + fault);
      if (sum.without.empty() && (!fault.empty() || !link.inertia_kgm2)) sum.without = link.name;
      if (link.inertia_kgm2)
        bodies.push_back({{mass->mass_kg, centre_m}, turned_inertia(*link.inertia_kgm2, origin_of(part.pose))});
    }
    for (const UrdfJoint* joint : urdf.joints_from(part.link)) {
      if (joint != next) parts.push_back({joint->child, part.pose * pose_of(joint->origin)});
    }
  }
  if (sum.stated && sum.without.empty()) sum.inertia_kgm2 = joint_inertia(bodies, sum.mass.centre_m);
  return sum;
}

void set_masses(const UrdfFile& urdf, UrdfArm& arm) {
  bool any = false;
  std::string unknown, without;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const UrdfJoint* next = i + 1 < arm.joints.size() ? arm.joints[i + 1] : nullptr;
    const MovedBodies bodies = bodies_between(urdf, *arm.joints[i], next, arm.notes);
    arm.masses.push_back(bodies.mass);
    arm.inertias.push_back(bodies.inertia_kgm2);
    if (!bodies.stated) unknown += (unknown.empty() ? "" : ", ") + arm.joints[i]->child;
    if (!bodies.without.empty()) without += (without.empty() ? "" : ", ") + bodies.without;
    any = any || bodies.stated;
  }
  const bool none = std::ranges::none_of(arm.inertias, [](const auto& inertia) { return inertia.has_value(); });
  if (none) arm.inertias.clear();
  if (!none && !without.empty())
    arm.notes.push_back("no inertia is written of what moves with link " + without + ", which states none that holds");
  if (!any) {
    arm.masses.clear();
  } else if (!unknown.empty()) {
    arm.notes.push_back("no mass is stated of " + unknown + "; 0 kg was written: correct `links` or leave it out");
  }
  const auto same = [&](const LinkMass& mass) { return mass.mass_kg == arm.masses.front().mass_kg; };
  if (arm.masses.size() > 1 && std::ranges::all_of(arm.masses, same))
    arm.notes.emplace_back(
        "all links have the same mass, as if nobody had weighed them: correct `links` or leave it out");
}

/// Says where a link of the name by which ROS calls the controller's frame (REP 199) stands elsewhere than the base.
void note_controller_base(const UrdfFile& urdf, UrdfArm& arm) {
  const std::string controllers = "base";
  if (std::ranges::find(urdf.links, controllers, &UrdfLink::name) == urdf.links.end()) return;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::string at = controllers;
  while (at != arm.base) {
    const UrdfJoint* joint = urdf.joint_to(at);
    if (joint == nullptr || moves(*joint)) return;
    pose = pose_of(joint->origin) * pose;
    at = joint->parent;
  }
  const Eigen::Vector3d at_mm = 1e3 * pose.translation();
  const double turn_deg = degrees(Eigen::AngleAxisd(pose.linear()).angle());
  if (at_mm.norm() < 1e-3 && turn_deg < 1e-4) return;
  const auto rounded = [](double value) { return number_text(std::round(1e3 * value) / 1e3 + 0.0); };
  arm.notes.push_back("positions count from link " + arm.base +
                      "; link base, from which controllers count, stands at [" + rounded(at_mm.x()) + ", " +
                      rounded(at_mm.y()) + ", " + rounded(at_mm.z()) + "] mm there, turned by " + rounded(turn_deg) +
                      " deg. Where positions and robot programs count from it, import with --base base "
                      "--tip " +
                      arm.tip);
}

}  // namespace

UrdfArm arm_between(const UrdfFile& urdf, const std::optional<std::string>& base,
                    const std::optional<std::string>& tip) {
  UrdfArm arm;
  if (base) require_link(urdf, *base, "--base");
  if (tip) require_link(urdf, *tip, "--tip");
  arm.base = base ? *base : root_link(urdf);
  arm.tip = tip ? *tip : tip_link(urdf, arm.base, arm.notes);
  if (!base) note_controller_base(urdf, arm);
  const Way way = way_between(urdf, arm.base, arm.tip);
  arm.drawing.by_axes = true;
  Eigen::Isometry3d fixed = way.up;
  bool direct = way.straight;  // no fixed place stands before the next origin
  Origin last;                 // the last fixed origin, where there is but one
  for (const UrdfJoint* joint : way.down) {
    require_near(urdf, *joint);
    note_units(*joint, arm.notes);
    if (!moves(*joint)) {
      last = direct ? joint->origin : origin_of(fixed * pose_of(joint->origin), joint->origin);
      fixed = fixed * pose_of(joint->origin);
      direct = false;
      continue;
    }
    check_moving(urdf, *joint, way, arm.notes);
    arm.drawing.joints.push_back(drawn(*joint, direct ? std::nullopt : std::optional(fixed), arm.notes));
    arm.joints.push_back(joint);
    arm.before.push_back(fixed);
    fixed = Eigen::Isometry3d::Identity();
    direct = true;
    last = {};
  }
  const bool turns = last.rpy_rad.cwiseAbs().maxCoeff() > kTurn_rad;
  arm.drawing.flange = turns ? origin_of(pose_of(last)) : last;
  const std::size_t count = arm.joints.size();
  if (count == 0 || count > static_cast<std::size_t>(kMaxJoints)) {
    throw InputError({urdf.file, 0}, std::to_string(count),
                     "is the number of moving joints from link " + arm.base + " to link " + arm.tip +
                         "; an arm has 1 to " + std::to_string(kMaxJoints) + ": say --base LINK and --tip LINK");
  }
  set_masses(urdf, arm);
  return arm;
}

}  // namespace demecal::inline urdf

// The serial arm between two links of a URDF, which links these are where the user does not say, and a URDF with other
// origins: the user's own with nothing else changed, or a new one of links without bodies.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data/link_inertia.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/urdf_file.hpp"

namespace demecal::inline urdf {

struct UrdfArm {
  std::string base, tip;  ///< links
  DrawnArm drawing;  ///< by axes; fixed joints are part of the next moving joint's origin, the last ones the flange
  std::vector<const UrdfJoint*> joints;   ///< the moving joints, of the file that was read
  std::vector<Eigen::Isometry3d> before;  ///< of every moving joint: the fixed places before its own origin
  std::vector<LinkMass> masses;    ///< of what moves with each joint, in its child link's frame; empty: not stated
  LinkInertias inertias;           ///< one for each of `masses`, in the same frames; empty: none is stated
  std::vector<std::string> notes;  ///< sentences: what was assumed
};

/// The arm from `base` (the root link where it is not given) to `tip` (the one link that the arm ends at). Throws
/// InputError where links are unknown, several could be meant, or what lies between them is no serial arm. `urdf` must
/// outlive the result.
UrdfArm arm_between(const UrdfFile& urdf, const std::optional<std::string>& base,
                    const std::optional<std::string>& tip);

/// The joints from a link above to a link below, in this order. Throws InputError where `below` is not below it.
std::vector<const UrdfJoint*> joints_down(const UrdfFile& urdf, const std::string& above, const std::string& below);

/// The one link that is the child of no joint. Throws InputError that names them where there are several.
std::string root_link(const UrdfFile& urdf);

/// The link at which the arm from `base`, or from the nearest link that this is fixed to, ends: behind all other
/// joints, where several links are fixed there, tool0 or the only one that does not stand where the last moving link
/// does. A sentence on that choice is appended to `notes`. Throws InputError that names the links where several arms
/// begin there.
std::string tip_link(const UrdfFile& urdf, const std::string& base, std::vector<std::string>& notes);

struct NewOrigin {
  const UrdfJoint* joint;
  Origin origin;
};

/// The text that the joints were read from with other origins; every byte outside of their numbers stays. Origins that
/// are the old ones within 1e-12 m and rad stay as they are written.
std::string with_origins(const std::string& text, const std::vector<NewOrigin>& origins);

/// A URDF of an arm that was not drawn as one: links base, link_1 .. link_n and flange. Couplings are left out.
std::string plain_urdf(const Robot& robot, const Chain& chain);

}  // namespace demecal::inline urdf

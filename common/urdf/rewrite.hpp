// A URDF with other origins: the user's own with nothing else changed, or a new one of links without bodies.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/urdf_file.hpp"

namespace demecal::inline urdf {

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

// Which links of a URDF an arm begins and ends at, where the user does not say.
#pragma once

#include <string>
#include <vector>

#include "urdf/urdf_file.hpp"

namespace demecal::inline urdf {

/// The joints from a link above to a link below, in this order. Throws InputError where `below` is not below it.
std::vector<const UrdfJoint*> joints_down(const UrdfFile& urdf, const std::string& above, const std::string& below);

/// The one link that is the child of no joint. Throws InputError that names them where there are several.
std::string root_link(const UrdfFile& urdf);

/// The link at which the arm from `base` ends: behind all other joints, where several links are
/// fixed there, tool0 or the only one that does not stand where the last moving link does. A sentence on that choice is
/// appended to `notes`. Throws InputError that names the links where several arms begin there.
std::string tip_link(const UrdfFile& urdf, const std::string& base, std::vector<std::string>& notes);

}  // namespace demecal::inline urdf

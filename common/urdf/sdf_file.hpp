// An SDF (SDFormat 1.4 to 1.12) of one model read into the links and joints of a URDF: SDFs state where links stand in
// the model or in each other, URDFs where a joint stands in the link before.
#pragma once

#include <string>

#include "urdf/urdf_file.hpp"
#include "urdf/xml.hpp"

namespace demecal::inline urdf {

/// Frames become links that are fixed to what they are attached to. A joint whose frame is not that of its child leads
/// to a link of the joint's name, which the child is fixed to. Throws InputError with file, line, value and rule.
UrdfFile parse_sdf(const XmlElement& root, const std::string& file);

/// A URDF or an SDF, whichever the first element says it is.
UrdfFile parse_urdf_or_sdf(const std::string& text, const std::string& file);

}  // namespace demecal::inline urdf

// Links and joints of an SDF as they are written, before it is known where their frames stand.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "urdf/urdf_file.hpp"
#include "urdf/xml.hpp"
#include "urdf/xml_values.hpp"

namespace demecal::inline urdf {

inline constexpr const char* kWorldFrame = "world";
inline constexpr int kFirstWithFrames = 7;  ///< version 1.7: from there on poses and axes name the frames they are in

struct WrittenJoint {
  UrdfJoint joint{};    ///< parent and child: links or frames
  std::string frame{};  ///< its own: how other elements name it
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  std::string axis_in{};         ///< a frame
  std::optional<double> held{};  ///< rad or m: where both limits are, which hold it there
};

/// `minor`: of the version, 4 for 1.4.
WrittenJoint read_sdf_joint(const XmlValues& values, const XmlElement& element, int minor);
UrdfLink read_sdf_link(const XmlValues& values, const XmlElement& element);

}  // namespace demecal::inline urdf

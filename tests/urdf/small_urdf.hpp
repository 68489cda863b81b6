// URDFs made up for tests.
#pragma once

#include <string>

#include "errors/input_error.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"

namespace demecal {

inline std::string link_xml(const std::string& name, const std::string& inside = "") {
  return inside.empty() ? "  <link name=\"" + name + "\"/>\n" : "  <link name=\"" + name + "\">" + inside + "</link>\n";
}

/// A joint one line long.
inline std::string joint_xml(const std::string& name, const std::string& type, const std::string& parent,
                             const std::string& child, const std::string& inside = "") {
  return "  <joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" +
         child + "\"/>" + inside + "</joint>\n";
}

inline std::string robot_xml(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"made up\">\n" + inside + "</robot>\n";
}

/// base - j1 - a - j2 - b - fixed - tip, with limits.
inline std::string two_joints(const std::string& more = "") {
  const std::string limits = "<axis xyz=\"0 0 1\"/><limit lower=\"-2\" upper=\"2\" effort=\"0\" velocity=\"0\"/>";
  return robot_xml(link_xml("base") + link_xml("a") + link_xml("b") + link_xml("tip") +
                   joint_xml("j1", "revolute", "base", "a", "<origin xyz=\"0 0 0.5\"/>" + limits) +
                   joint_xml("j2", "revolute", "a", "b", "<origin xyz=\"0.4 0 0\" rpy=\"1.5707963 0 0\"/>" + limits) +
                   joint_xml("end", "fixed", "b", "tip", "<origin xyz=\"0 0.1 0\"/>") + more);
}

/// What refuses it; "accepted" where nothing does.
inline std::string complaint_of(const std::string& text, const std::string& tip = "") {
  try {
    const UrdfFile urdf = parse_urdf(text, "arm.urdf");
    arm_between(urdf, std::nullopt, tip.empty() ? std::nullopt : std::optional(tip));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace demecal

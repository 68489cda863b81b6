// SDFs made up for tests.
#pragma once

#include <optional>
#include <string>

#include "errors/input_error.hpp"
#include "urdf/sdf_file.hpp"
#include "urdf/urdf_arm.hpp"

namespace demecal {

inline std::string sdf_xml(const std::string& inside, const std::string& version = "1.9") {
  return "<sdf version=\"" + version + "\">\n<model name=\"made up\">\n" + inside + "</model>\n</sdf>\n";
}

inline std::string sdf_link(const std::string& name, const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}

/// A joint one line long.
inline std::string sdf_joint(const std::string& name, const std::string& type, const std::string& parent,
                             const std::string& child, const std::string& inside = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent>" + parent + "</parent><child>" + child +
         "</child>" + inside + "</joint>\n";
}

inline std::string sdf_axis(const std::string& xyz = "<xyz>0 0 1</xyz>", const std::string& lower = "-2",
                            const std::string& upper = "2") {
  return "<axis>" + xyz + "<limit><lower>" + lower + "</lower><upper>" + upper + "</upper></limit></axis>";
}

/// base (line 3) - j1 (6) - a (4) - j2 (7) - b (5), then `more` (8), in the model's frame at 0, 0.5 and 0.9 m.
inline std::string small_sdf(const std::string& more = "", const std::string& version = "1.9") {
  return sdf_xml(sdf_link("base") + sdf_link("a", "<pose>0 0 0.5 0 0 0</pose>") +
                     sdf_link("b", "<pose>0.4 0 0.5 0 0 0</pose>") +
                     sdf_joint("j1", "revolute", "base", "a", sdf_axis()) +
                     sdf_joint("j2", "revolute", "a", "b", sdf_axis("<xyz>0 1 0</xyz>")) + more,
                 version);
}

/// What refuses it; "accepted" where nothing does.
inline std::string sdf_complaint(const std::string& text, const std::string& tip = "") {
  try {
    const UrdfFile sdf = parse_urdf_or_sdf(text, "arm.sdf");
    arm_between(sdf, std::nullopt, tip.empty() ? std::nullopt : std::optional(tip));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace demecal

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "urdf/xml.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "data/text.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline urdf {
namespace {

constexpr double kSame = 1e-12;  // m or rad, far below what any arm repeats

struct ByteChange {
  std::size_t begin, end;
  std::string text;
};

/// Three numbers to 1e-12.
std::string three_numbers(const Eigen::Vector3d& values) {
  std::string text;
  for (const double value : values) {
    const double rounded = std::round(value / kSame) * kSame;
    text += (text.empty() ? "" : " ") + number_text(rounded == 0.0 ? 0.0 : rounded);
  }
  return text;
}

std::string attribute_text(const char* name, const Eigen::Vector3d& values) {
  return std::string(name) + "=\"" + three_numbers(values) + '"';
}

/// Whether the places are turned alike: near a pitch of 90 deg by whichever roll and yaw.
bool turned_alike(const Origin& one, const Origin& other) {
  return (pose_of(one).linear() - pose_of(other).linear()).cwiseAbs().maxCoeff() <= kSame;
}

void replace_attribute(const XmlElement& origin, const char* name, const Eigen::Vector3d& values,
                       std::vector<ByteChange>& replacements) {
  if (const XmlAttribute* written = origin.attribute(name)) {
    replacements.push_back({written->begin, written->end, three_numbers(values)});
  } else {
    const std::size_t end = origin.begin + 1 + origin.name.size();
    replacements.push_back({end, end, ' ' + attribute_text(name, values)});
  }
}

void replace_origin(const NewOrigin& change, std::vector<ByteChange>& replacements) {
  const Origin &old_origin = change.joint->origin, &origin = change.origin;
  const bool moved = (origin.xyz_m - old_origin.xyz_m).cwiseAbs().maxCoeff() > kSame;
  const bool turned = !turned_alike(origin, old_origin);
  if (const XmlElement* written = change.joint->element.child("origin")) {
    if (moved) replace_attribute(*written, "xyz", origin.xyz_m, replacements);
    if (turned) replace_attribute(*written, "rpy", origin.rpy_rad, replacements);
    return;
  }
  if (!moved && !turned) return;
  const std::size_t at = change.joint->element.tag_end;
  replacements.push_back(
      {at, at, "<origin " + attribute_text("xyz", origin.xyz_m) + ' ' + attribute_text("rpy", origin.rpy_rad) + "/>"});
}

std::string xml_escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    switch (c) {
      case '&':
        all += "&amp;";
        break;
      case '<':
        all += "&lt;";
        break;
      case '"':
        all += "&quot;";
        break;
      default:
        all += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return all;
}

/// One joint of a URDF without bodies.
std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const Eigen::Isometry3d& place, const std::string& rest) {
  const Origin origin = origin_of(place);
  return "  <joint name=\"" + xml_escaped(name) + "\" type=\"" + type + "\">\n    <origin " +
         attribute_text("xyz", origin.xyz_m) + ' ' + attribute_text("rpy", origin.rpy_rad) + "/>\n    <parent link=\"" +
         parent + "\"/>\n    <child link=\"" + child + "\"/>\n" + rest + "  </joint>\n";
}

std::string urdf_type(const Joint& joint) {
  return !is_revolute(joint) ? "prismatic" : joint.endless ? "continuous" : "revolute";
}

std::string motion_text(const Joint& joint) {
  std::string text = "    <axis xyz=\"0 0 1\"/>\n";
  if (joint.endless) return text;
  return text + "    <limit lower=\"" + number_text(joint.lower) + "\" upper=\"" + number_text(joint.upper) +
         "\" effort=\"0\" velocity=\"0\"/>\n";
}

}  // namespace

std::string with_origins(const std::string& text, const std::vector<NewOrigin>& origins) {
  std::vector<ByteChange> replacements;
  for (const NewOrigin& origin : origins) replace_origin(origin, replacements);
  std::ranges::sort(replacements, std::ranges::greater{}, &ByteChange::begin);
  std::string changed = text;
  for (const ByteChange& replacement : replacements)
    changed.replace(replacement.begin, replacement.end - replacement.begin, replacement.text);
  return changed;
}

std::string plain_urdf(const Robot& robot, const Chain& chain) {
  std::ostringstream links, joints;
  links << "<?xml version=\"1.0\"?>\n<robot name=\"" << xml_escaped(robot.name) << "\">\n  <link name=\"base\"/>\n";
  Eigen::Isometry3d before = chain.base;  // of the joint's axis, in the link before
  std::string parent = "base";
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const Joint& row = chain.joints[i];
    Eigen::Isometry3d after = Eigen::Isometry3d::Identity();
    bool behind_axis = false;
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      behind_axis = behind_axis || transform.parameter == LinkParameter::theta;
      advance(behind_axis ? after : before, transform, row.parameter(transform.parameter));
    }
    const std::string number = std::to_string(i + 1);
    const bool named = robot.drawing && !robot.drawing->joints[i].name.empty();
    links << "  <link name=\"link_" << number << "\"/>\n";
    joints << joint_text(named ? robot.drawing->joints[i].name : "joint_" + number, urdf_type(row), parent,
                         "link_" + number, before, motion_text(row));
    before = after;
    parent = "link_" + number;
  }
  links << "  <link name=\"flange\"/>\n";
  joints << joint_text("flange_joint", "fixed", parent, "flange", before * chain.flange, "");
  return links.str() + joints.str() + "</robot>\n";
}

}  // namespace demecal::inline urdf

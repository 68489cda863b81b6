#include "urdf/urdf_file.hpp"

#include <utility>

#include "data/link_inertia.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "urdf/xml_values.hpp"

namespace demecal::inline urdf {
namespace {

/// Nothing where a URDF has no such type.
std::optional<UrdfType> urdf_type_named(const std::string& name) {
  const auto type = type_named(name);
  return type && *type <= kLastUrdfType ? type : std::nullopt;
}

UrdfJoint read_joint(const XmlValues& values, const XmlElement& element) {
  UrdfJoint joint;
  joint.name = values.text(element, "name");
  joint.line = element.line;
  const std::string& type = values.text(element, "type");
  const auto known = urdf_type_named(type);
  if (!known)
    values.fail(element, type, "is no type of a joint: revolute, continuous, prismatic, fixed, floating or planar");
  joint.type = *known;
  for (auto [key, link] : {std::pair{"parent", &joint.parent}, std::pair{"child", &joint.child}}) {
    const XmlElement* end = element.child(key);
    if (end == nullptr) values.fail(element, joint.name, "is a joint without <" + std::string(key) + ">");
    *link = values.text(*end, "link");
  }
  joint.origin = values.origin(element.child("origin"));
  joint.written_rpy = joint.origin.rpy_rad;
  joint.axis = values.vector_or(element.child("axis"), "xyz", Eigen::Vector3d::UnitX());
  joint.lower = values.number_or(element.child("limit"), "lower", 0.0);
  joint.upper = values.number_or(element.child("limit"), "upper", 0.0);
  if (const XmlElement* mimic = element.child("mimic")) joint.mimics = values.text(*mimic, "joint");
  joint.element = element;
  return joint;
}

/// In the axes of the link whose <inertial> it is; nothing where not all three moments stand there.
std::optional<Eigen::Matrix3d> read_inertia(const XmlValues& values, const XmlElement& inertial) {
  const XmlElement* inertia = inertial.child("inertia");
  for (const char* moment : {"ixx", "iyy", "izz"}) {
    if (inertia == nullptr || inertia->attribute(moment) == nullptr) return std::nullopt;
  }
  const auto number = [&](const char* key) { return values.number_or(inertia, key, 0.0); };
  const Eigen::Matrix3d own =
      symmetric_matrix({number("ixx"), number("ixy"), number("ixz"), number("iyy"), number("iyz"), number("izz")});
  return turned_inertia(own, values.origin(inertial.child("origin")));
}

UrdfLink read_link(const XmlValues& values, const XmlElement& element) {
  UrdfLink link{.name = values.text(element, "name"), .mass = std::nullopt, .line = element.line};
  const XmlElement* inertial = element.child("inertial");
  const XmlElement* mass = inertial == nullptr ? nullptr : inertial->child("mass");
  if (mass == nullptr) return link;
  link.mass = LinkMass{values.number_or(mass, "value", 0.0), values.origin(inertial->child("origin")).xyz_m};
  if (link.mass->mass_kg < 0.0) values.fail(*mass, number_text(link.mass->mass_kg), "must not be negative: a mass");
  link.inertia_kgm2 = read_inertia(values, *inertial);
  return link;
}

}  // namespace

UrdfFile parse_urdf(const XmlElement& root, const std::string& file) {
  const XmlValues values(file);
  if (root.name == "sdf") values.fail(root, "<sdf>", "is an SDF; a URDF is expected, whose first element is <robot>");
  if (root.name != "robot") values.fail(root, "<" + root.name + ">", "is the first element; that of a URDF is <robot>");
  values.refuse_xacro(root);
  UrdfFile urdf{.file = file, .robot = root.attribute("name") ? root.attribute("name")->value : ""};
  for (const XmlElement& child : root.children) {
    if (child.name == "link") urdf.links.push_back(read_link(values, child));
    if (child.name == "joint") urdf.joints.push_back(read_joint(values, child));
  }
  check_tree(urdf);
  if (urdf.links.empty()) values.fail(root, "<robot>", "has no links");
  return urdf;
}

UrdfFile parse_urdf(const std::string& text, const std::string& file) {
  return parse_urdf(parse_xml(text, file), file);
}

}  // namespace demecal::inline urdf

#include "urdf/urdf_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline urdf {
namespace {

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const XmlElement& element, const std::string& value, const std::string& rule) const {
    throw InputError({file_, element.line}, value, rule);
  }

  const std::string& text(const XmlElement& element, std::string_view key) const {
    const XmlAttribute* found = element.attribute(key);
    if (found == nullptr || found->value.empty())
      fail(element, "<" + element.name + ">", "must state its " + std::string(key));
    return found->value;
  }

  double number(const XmlElement& element, const XmlAttribute& attribute) const {
    const auto parsed = parse_number(trimmed(attribute.value));
    if (!parsed) fail(element, attribute.value, "must be a number: " + attribute.name + " of <" + element.name + ">");
    return *parsed;
  }

  double number_or(const XmlElement* element, std::string_view key, double otherwise) const {
    const XmlAttribute* found = element == nullptr ? nullptr : element->attribute(key);
    return found == nullptr ? otherwise : number(*element, *found);
  }

  Eigen::Vector3d vector_or(const XmlElement* element, std::string_view key, const Eigen::Vector3d& otherwise) const {
    const XmlAttribute* found = element == nullptr ? nullptr : element->attribute(key);
    if (found == nullptr) return otherwise;
    Eigen::Vector3d vector;
    int count = 0;
    std::string_view rest = found->value;
    constexpr std::string_view kSpaces = " \t\r\n";
    for (std::size_t begin = rest.find_first_not_of(kSpaces); begin != std::string_view::npos;
         begin = rest.find_first_not_of(kSpaces)) {
      rest.remove_prefix(begin);
      const std::size_t end = std::min(rest.find_first_of(kSpaces), rest.size());
      const auto parsed = parse_number(rest.substr(0, end));
      if (!parsed || count == 3) {
        count = 4;
        break;
      }
      vector[count++] = *parsed;
      rest.remove_prefix(end);
    }
    if (count != 3)
      fail(*element, found->value, "must be 3 numbers: " + std::string(key) + " of <" + element->name + ">");
    return vector;
  }

  Origin origin(const XmlElement* element) const {
    return {vector_or(element, "xyz", Eigen::Vector3d::Zero()), vector_or(element, "rpy", Eigen::Vector3d::Zero())};
  }

 private:
  static std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpaces = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(kSpaces);
    return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
  }

  std::string file_;
};

constexpr std::array<std::pair<std::string_view, UrdfType>, 6> kTypes{{{"revolute", UrdfType::revolute},
                                                                       {"continuous", UrdfType::continuous},
                                                                       {"prismatic", UrdfType::prismatic},
                                                                       {"fixed", UrdfType::fixed},
                                                                       {"floating", UrdfType::floating},
                                                                       {"planar", UrdfType::planar}}};

UrdfJoint read_joint(const Reader& reader, const XmlElement& element) {
  UrdfJoint joint;
  joint.name = reader.text(element, "name");
  joint.line = element.line;
  const std::string& type = reader.text(element, "type");
  const auto* const known = std::ranges::find(kTypes, type, &std::pair<std::string_view, UrdfType>::first);
  if (known == kTypes.end())
    reader.fail(element, type, "is no type of a joint: revolute, continuous, prismatic, fixed, floating or planar");
  joint.type = known->second;
  for (auto [key, link] : {std::pair{"parent", &joint.parent}, std::pair{"child", &joint.child}}) {
    const XmlElement* end = element.child(key);
    if (end == nullptr) reader.fail(element, joint.name, "is a joint without <" + std::string(key) + ">");
    *link = reader.text(*end, "link");
  }
  joint.origin = reader.origin(element.child("origin"));
  joint.axis = reader.vector_or(element.child("axis"), "xyz", Eigen::Vector3d::UnitX());
  joint.lower = reader.number_or(element.child("limit"), "lower", 0.0);
  joint.upper = reader.number_or(element.child("limit"), "upper", 0.0);
  if (const XmlElement* mimic = element.child("mimic")) joint.mimics = reader.text(*mimic, "joint");
  joint.element = element;
  return joint;
}

UrdfLink read_link(const Reader& reader, const XmlElement& element) {
  UrdfLink link{reader.text(element, "name"), std::nullopt, element.line};
  const XmlElement* inertial = element.child("inertial");
  const XmlElement* mass = inertial == nullptr ? nullptr : inertial->child("mass");
  if (mass == nullptr) return link;
  link.mass = LinkMass{reader.number_or(mass, "value", 0.0), reader.origin(inertial->child("origin")).xyz_m};
  if (link.mass->mass_kg < 0.0) reader.fail(*mass, number_text(link.mass->mass_kg), "must not be negative: a mass");
  return link;
}

/// Xacro has to be expanded before. Attributes count where links and joints are stated: plugins may hold anything.
void refuse_xacro(const Reader& reader, const XmlElement& element, bool stated) {
  const auto refuse = [&](const std::string& value) {
    reader.fail(element, value, "is xacro that is not expanded; run `xacro FILE.xacro > FILE.urdf` and import that");
  };
  if (element.name.starts_with("xacro:")) refuse("<" + element.name + ">");
  for (const XmlAttribute& attribute : element.attributes) {
    if (!stated) break;
    if (attribute.value.find("${") != std::string::npos || attribute.value.find("$(") != std::string::npos)
      refuse(attribute.value);
  }
  for (const XmlElement& child : element.children)
    refuse_xacro(reader, child, stated || child.name == "link" || child.name == "joint");
}

void check_names(const Reader& reader, const UrdfFile& urdf, const XmlElement& root) {
  std::set<std::string> links, joints, children;
  for (const UrdfLink& link : urdf.links) {
    if (!links.insert(link.name).second) throw InputError({urdf.file, link.line}, link.name, "is a link given twice");
  }
  for (const UrdfJoint& joint : urdf.joints) {
    if (!joints.insert(joint.name).second) reader.fail(joint.element, joint.name, "is a joint given twice");
    for (const std::string& end : {joint.parent, joint.child}) {
      if (links.contains(end)) continue;
      const std::vector<std::string> known(links.begin(), links.end());
      reader.fail(joint.element, end,
                  "is no link of this file: joint " + joint.name + " (nearest is " + nearest_name(end, known) + ")");
    }
    if (!children.insert(joint.child).second)
      reader.fail(joint.element, joint.child, "is the child of a second joint, " + joint.name + ": links make no tree");
  }
  if (urdf.links.empty()) reader.fail(root, "<robot>", "has no links");
}

/// No way from child to parent ends where it began.
void check_tree(const Reader& reader, const UrdfFile& urdf) {
  for (const UrdfJoint& joint : urdf.joints) {
    const UrdfJoint* at = &joint;
    for (std::size_t steps = 0; at != nullptr; at = urdf.joint_to(at->parent)) {
      if (++steps > urdf.joints.size())
        reader.fail(joint.element, joint.name, "is part of a ring of joints: links make no tree");
    }
  }
}

}  // namespace

const UrdfJoint* UrdfFile::joint_to(const std::string& link) const {
  const auto found = std::ranges::find(joints, link, &UrdfJoint::child);
  return found == joints.end() ? nullptr : &*found;
}

std::vector<const UrdfJoint*> UrdfFile::joints_from(const std::string& link) const {
  std::vector<const UrdfJoint*> all;
  for (const UrdfJoint& joint : joints) {
    if (joint.parent == link) all.push_back(&joint);
  }
  return all;
}

const UrdfLink& UrdfFile::link(const std::string& name) const {
  const auto found = std::ranges::find(links, name, &UrdfLink::name);
  DEMECAL_CHECK(found != links.end(), "link " << name);
  return *found;
}

UrdfFile parse_urdf(const std::string& text, const std::string& file) {
  const XmlElement root = parse_xml(text, file);
  const Reader reader(file);
  if (root.name == "sdf") reader.fail(root, "<sdf>", "is an SDF; a URDF is expected, whose first element is <robot>");
  if (root.name != "robot") reader.fail(root, "<" + root.name + ">", "is the first element; that of a URDF is <robot>");
  refuse_xacro(reader, root, false);
  UrdfFile urdf{file, root.attribute("name") ? root.attribute("name")->value : "", {}, {}};
  for (const XmlElement& child : root.children) {
    if (child.name == "link") urdf.links.push_back(read_link(reader, child));
    if (child.name == "joint") urdf.joints.push_back(read_joint(reader, child));
  }
  check_names(reader, urdf, root);
  check_tree(reader, urdf);
  return urdf;
}

}  // namespace demecal::inline urdf

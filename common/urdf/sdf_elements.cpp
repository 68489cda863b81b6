#include "urdf/sdf_elements.hpp"

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/link_inertia.hpp"
#include "data/text.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/sdf_frames.hpp"

namespace demecal::inline urdf {
namespace {

constexpr int kAxesInModel = 4;  ///< version 1.4: axes are in the model's frame if nothing else is said

/// The text of a child element; nothing where it is not there.
std::optional<std::string> child_text(const XmlValues& values, const XmlElement& element, const char* name) {
  const XmlElement* child = element.child(name);
  return child == nullptr ? std::nullopt : std::optional(values.content(*child));
}

/// Infinite where there is no limit.
double limit_of(const XmlValues& values, const XmlElement* limits, const char* name, double none) {
  const XmlElement* limit = limits == nullptr ? nullptr : limits->child(name);
  if (limit == nullptr) return none;
  std::string_view text = without_blanks(limit->text);
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (const std::string word = lower_case(text); word == "inf" || word == "infinity") return none;
  return values.numbers(*limit, 1).front();
}

void read_limits(const XmlValues& values, const XmlElement& axis, WrittenJoint& written) {
  constexpr double kNone = 1e16;
  UrdfJoint& joint = written.joint;
  const XmlElement* limits = axis.child("limit");
  joint.lower = limit_of(values, limits, "lower", -kNone);
  joint.upper = limit_of(values, limits, "upper", kNone);
  const bool below = std::abs(joint.lower) < kNone, above = std::abs(joint.upper) < kNone;
  if (below && above && joint.lower == joint.upper && joint.type != UrdfType::continuous) written.held = joint.lower;
  if (below && above) return;
  if (joint.type == UrdfType::revolute && !below && !above) joint.type = UrdfType::continuous;
  joint.lower = joint.upper = 0.0;
}

bool states_true(const XmlValues& values, const XmlElement& element, const char* name, bool otherwise) {
  const auto text = child_text(values, element, name);
  return text ? *text == "1" || lower_case(*text) == "true" : otherwise;
}

void read_joint_axis(const XmlValues& values, const XmlElement& element, int minor, WrittenJoint& written) {
  const XmlElement* axis = element.child("axis");
  const UrdfType type = written.joint.type;
  if (axis == nullptr || type == UrdfType::fixed || type > UrdfType::planar) return;
  read_limits(values, *axis, written);
  written.axis = Eigen::Vector3d::UnitZ();
  if (const XmlElement* xyz = axis->child("xyz")) {
    written.axis = Eigen::Vector3d(values.numbers(*xyz, 3).data());
    const XmlAttribute* frame = xyz->attribute("expressed_in");
    if (frame != nullptr && !frame->value.empty()) written.axis_in = frame->value;
  }
  if (minor < kFirstWithFrames && states_true(values, *axis, "use_parent_model_frame", minor == kAxesInModel))
    written.axis_in = kModelFrame;
  if (const XmlElement* mimic = axis->child("mimic")) written.joint.mimics = values.text(*mimic, "joint");
}

UrdfType sdf_type(const XmlValues& values, const XmlElement& element) {
  const std::string& name = values.text(element, "type");
  const auto type = type_named(lower_case(name));
  if (!type || *type == UrdfType::floating || *type == UrdfType::planar) {
    values.fail(element, name,
                "is no type of a joint: revolute, continuous, prismatic, fixed, ball, universal, screw, revolute2 or "
                "gearbox");
  }
  return *type;
}

/// In the axes of the link; nothing where not all three moments stand there.
std::optional<Eigen::Matrix3d> read_sdf_inertia(const XmlValues& values, const XmlElement& inertial,
                                                const Origin& place) {
  const XmlElement* inertia = inertial.child("inertia");
  for (const char* moment : {"ixx", "iyy", "izz"}) {
    if (inertia == nullptr || inertia->child(moment) == nullptr) return std::nullopt;
  }
  const auto number = [&](const char* key) {
    const XmlElement* one = inertia->child(key);
    return one == nullptr ? 0.0 : values.numbers(*one, 1).front();
  };
  const Eigen::Matrix3d own =
      symmetric_matrix({number("ixx"), number("ixy"), number("ixz"), number("iyy"), number("iyz"), number("izz")});
  return turned_inertia(own, place);
}

}  // namespace

WrittenJoint read_sdf_joint(const XmlValues& values, const XmlElement& element, int minor) {
  WrittenJoint written;
  UrdfJoint& joint = written.joint;
  joint.name = values.text(element, "name");
  joint.line = element.line;
  joint.type = sdf_type(values, element);
  for (auto [key, end] : {std::pair{"parent", &joint.parent}, std::pair{"child", &joint.child}}) {
    const auto stated = child_text(values, element, key);
    if (!stated) values.fail(element, joint.name, "is a joint without <" + std::string(key) + ">");
    *end = *stated;
  }
  if (joint.child == kWorldFrame) values.fail(element, joint.name, "is a joint whose child is the world");
  // Links and joints may have the same name in old versions, which never name a joint's frame.
  written.frame = minor >= kFirstWithFrames ? joint.name : joint.name + " (joint)";
  written.axis_in = written.frame;
  read_joint_axis(values, element, minor, written);
  return written;
}

UrdfLink read_sdf_link(const XmlValues& values, const XmlElement& element) {
  UrdfLink link{.name = values.text(element, "name"), .mass = std::nullopt, .line = element.line};
  if (link.name == kWorldFrame) values.fail(element, link.name, "is the name of the world, not of a link; rename it");
  const XmlElement* inertial = element.child("inertial");
  const XmlElement* mass = inertial == nullptr ? nullptr : inertial->child("mass");
  const XmlAttribute* computed = inertial == nullptr ? nullptr : inertial->attribute("auto");
  if (mass == nullptr || (computed != nullptr && lower_case(computed->value) == "true")) return link;
  const SdfPose place = read_pose(values, *inertial);
  if (!place.relative_to.empty() && place.relative_to != link.name)
    values.fail(*inertial, place.relative_to, "is the frame of an inertial's pose, which must be its link's");
  link.mass = LinkMass{values.numbers(*mass, 1).front(), place.origin.xyz_m};
  if (link.mass->mass_kg < 0.0) values.fail(*mass, number_text(link.mass->mass_kg), "must not be negative: a mass");
  link.inertia_kgm2 = read_sdf_inertia(values, *inertial, place.origin);
  return link;
}

}  // namespace demecal::inline urdf
